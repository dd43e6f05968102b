#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "asdf_vk/field.h"
#include "core/box3.h"
#include "mesh/mesh.h"
#include "page/page_arrays.h"

namespace asdfvk {

/// The box of the finite vertices of faces; a point where there is none.
[[nodiscard]] Box3d boxOfFaces(const TriangleMesh& mesh);

/// Encodes the triangles of a mesh and its fields per input face, each of one component, into arrays. Returns their
/// description with the keys of docs/page-format.md: faceCount (triangles) to fields. Preconditions: every index of a
/// face is below the vertex count; the fields have an entry per input face. box: the box of the grid of the stored
/// coordinates; it contains the vertices of all faces.
[[nodiscard]] nlohmann::ordered_json encodeMesh(const TriangleMesh& mesh,
                                                std::span<const std::reference_wrapper<const Field>> fields,
                                                PageArrays& arrays, const Box3d& box);

}  // namespace asdfvk
