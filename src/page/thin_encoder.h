#pragma once

#include <nlohmann/json_fwd.hpp>

#include "asdf_vk/session.h"
#include "core/box3.h"
#include "page/page_arrays.h"

namespace asdfvk {

/// Encodes the thin surface as a mesh with the field "region". Equal corners become one vertex. box: the box of the
/// whole mesh, so that thin faces and faces of the mesh are rounded to the same grid. Returns a description like
/// encodeMesh(). Precondition: the surface has a triangle.
[[nodiscard]] nlohmann::ordered_json encodeThinSurface(const ThinSurface& surface, const Box3d& box,
                                                       PageArrays& arrays);

}  // namespace asdfvk
