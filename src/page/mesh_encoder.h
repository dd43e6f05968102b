#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "asdf_vk/field.h"
#include "core/box3.h"
#include "mesh/mesh.h"
#include "page/page_arrays.h"

namespace asdfvk {

/// The bounding box of the finite vertices of faces; the origin if there are none.
[[nodiscard]] Box3d boxOfFaces(const TriangleMesh& mesh);

/// Encodes the triangles and fields of a mesh into arrays. Returns a description with the keys `faceCount` to `fields`
/// of docs/page-format.md. box: a box around the vertices of all faces. Coordinates are stored in a grid of this box.
/// Preconditions: all indices are below the vertex count; fields have one component and an entry per input face.
[[nodiscard]] nlohmann::ordered_json encodeMesh(const TriangleMesh& mesh,
                                                std::span<const std::reference_wrapper<const Field>> fields,
                                                PageArrays& arrays, const Box3d& box);

}  // namespace asdfvk
