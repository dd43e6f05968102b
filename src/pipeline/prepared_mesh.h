#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "core/unset_vector.h"
#include "mesh/components.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "pipeline/stage_clock.h"

namespace asdfvk {

/// Data of a mesh that is independent of rays, seeds and devices.
struct PreparedMesh {
  Mesh storage;       ///< Arrays of `mesh` that differ from the caller's: converted, triangulated, welded or reversed.
  TriangleMesh mesh;  ///< Views of `storage` and of the arrays of the caller.
  FaceGeometry geometry;
  UnsetVector<uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  /// #V: the vertex that replaces each vertex in `mesh` (closed_surface.h). Empty if no vertex was welded.
  std::vector<uint32_t> vertexOf;
  bool hasTJunctions = false;  ///< See SurfaceEdges::hasTJunctions.
  DualGraph graph;
  std::array<EdgesOfKind, kEdgeKindCount> openEdges;  ///< EdgeSurvey::edges
  Components components;
  std::vector<uint32_t> invertedComponents;  ///< Inverted components that were left unchanged. Ascending.
  std::vector<uint64_t> reversedFaces;       ///< Input faces, ascending.
  MeshDefects defects;
  std::string unit;                     ///< Mesh::unit.
  double chordError = 0;                ///< Mesh::chordError.
  uint32_t statedPartCount = 0;         ///< Mesh::statedPartCount.
  uint32_t negativeVolumeCount = 0;     ///< Mesh::negativeVolumeCount.
  double float32Step = 0;               ///< float32StepOf() of the mesh or of the parts of its file.
  std::span<const NamedFaces> objects;  ///< Mesh::objects of the caller.
  std::vector<Warning> warnings;
  std::vector<uint32_t> traceableFaces;  ///< Faces that are not degenerate: they can cast rays. Ascending.
};

/// The triangles of a caller. storage: receives the arrays that differ from the caller's. The arrays of the caller and
/// `storage` must outlive the result. Throws Error{EmptyMesh}, Error{ArraySize}, Error{IndexOutOfRange},
/// Error{MeshTooLarge}.
[[nodiscard]] TriangleMesh trianglesOf(const MeshView& view, Mesh& storage);

/// Copies the arrays that `mesh` views to `storage`, so that faces can be reversed. Does not change `mesh`.
void ownArrays(PreparedMesh& prepared);

/// The arrays of the caller must outlive the result. Faces are reversed according to `orientation`, in arrays of the
/// result. Throws the errors of trianglesOf(), Error{FarFromOrigin} and, between its steps, Error{Cancelled}.
[[nodiscard]] PreparedMesh prepareMesh(const MeshView& mesh, Orientation orientation, StageClock& clock,
                                       const RunControl& control);

/// Prepares a mesh without measuring times. Cannot be cancelled.
[[nodiscard]] PreparedMesh prepareMesh(const MeshView& mesh, Orientation orientation);

}  // namespace asdfvk
