#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/field.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Fields per vertex from fields per input face, with the same names and in the same order. vertexOf: the vertex
/// that replaces each vertex in the faces, #V; empty if none is replaced. areas: #F. Each triangle at
/// a vertex counts by its area, with the entry of its input face:
/// - real numbers: the mean over the faces with a value, for each component. NaN without such a face. If all faces with
///   a value have zero area, the value of the last one.
/// - uint32 labels: the label with the largest area; of equal areas, the lowest label. kNoSegment without a labelled
///   face.
/// - uint8 flags: 1 if a face at the vertex has the flag.
/// Bits do not depend on the number of threads. Throws Error{MeshTooLarge} beyond 2^32 - 1 corners.
[[nodiscard]] std::vector<Field> vertexFieldsOf(const TriangleMesh& mesh, std::span<const uint32_t> vertexOf,
                                                std::span<const double> areas, std::span<const Field> faceFields);

}  // namespace asdfvk
