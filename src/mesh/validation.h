#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/report.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Throws Error{ArraySize} for arrays of a wrong size and offsets that do not ascend, Error{MeshTooLarge} beyond
/// kMaxIndexCount and kMaxTriangleCount, Error{IndexOutOfRange} for faces with an index at or above the vertex count.
void requireValidArrays(const MeshView& view);

/// Number of faces with an index at or above the vertex count. Precondition of all other functions with a TriangleMesh:
/// this number is 0.
[[nodiscard]] uint64_t countFacesWithIndexOutOfRange(const TriangleMesh& mesh);

/// Precondition: all arguments describe the same mesh.
[[nodiscard]] MeshDefects findDefects(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                      std::span<const uint32_t> representatives, const EdgeSurvey& edges);

/// The greatest distance of neighbouring float32 values at the coordinates, if all finite coordinates are float32
/// values, as in binary STL; else 0.
[[nodiscard]] double float32StepOf(std::span<const Vec3d> vertices);

}  // namespace asdfvk
