#pragma once

#include <vector>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// STL has no indices. Its readers weld corners at the same point to one vertex, because without common vertices no
/// face would have a neighbour. Throws the errors of InputFaces::moveTo().
[[nodiscard]] Mesh stlMesh(std::vector<Vec3d>&& vertices, std::vector<Face>&& triangles);

}  // namespace asdfvk
