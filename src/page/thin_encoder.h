#pragma once

#include <nlohmann/json_fwd.hpp>

#include "asdf_vk/session.h"
#include "core/box3.h"
#include "page/page_arrays.h"

namespace asdfvk {

/// Encodes the thin surface as a mesh with the field "region", in steps of the grid of `box`, which is that of the
/// mesh: a thin face and the face of the mesh have the same coordinates. Equal corners become one vertex. Returns the
/// description, as encodeMesh(). Precondition: there is a triangle.
[[nodiscard]] nlohmann::ordered_json encodeThinSurface(const ThinSurface& surface, const Box3d& box,
                                                       PageArrays& arrays);

}  // namespace asdfvk
