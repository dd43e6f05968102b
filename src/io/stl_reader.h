#pragma once

#include <vector>

#include "asdf_vk/mesh.h"
#include "io/corner_welder.h"

namespace asdfvk {

/// STL has no indices. Corners at the same point become one vertex, because without common vertices no face would have
/// a neighbour.
[[nodiscard]] Mesh weldedStl(CornerWelder& welder, std::vector<Face>&& triangles);

}  // namespace asdfvk
