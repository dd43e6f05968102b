#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The faces of the mesh that hang together over the dual graph.
struct Component {
  uint32_t firstFace = 0;   ///< Its lowest face.
  uint32_t faceCount = 0;
  bool isClosed = false;    ///< No boundary edge and no non-manifold edge.
  double signedVolume = 0;  ///< In mesh units cubed; negative where faces look inwards. Sound for closed ones only.
};

struct Components {
  std::vector<uint32_t> componentOf;  ///< #F
  std::vector<Component> components;  ///< By lowest face.
};

/// What is wrong with a mesh. Counts of faces are triangles.
struct MeshDefects {
  uint64_t zeroAreaFaceCount = 0;
  uint64_t duplicateFaceCount = 0;  ///< Faces beyond the first of each set with the same three vertices.
  uint64_t nonFiniteVertexCount = 0;
  uint64_t nonFiniteFaceCount = 0;  ///< Faces with a non-finite corner.
  uint64_t indexOutOfRangeFaceCount = 0;
  uint64_t boundaryEdgeCount = 0;
  uint64_t nonManifoldEdgeCount = 0;  ///< Edges of more than two faces.
  uint64_t inconsistentEdgeCount = 0;  ///< Edges whose two faces run through them in the same direction.
  uint64_t unreferencedVertexCount = 0;
  uint64_t shortPolygonCount = 0;  ///< Input faces with fewer than three corners: no triangle, no value.

  /// One sentence per defect found, each with its count; empty for a clean mesh.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

/// Faces with an index at or above the vertex count. When there is any, nothing else can be computed on the mesh.
[[nodiscard]] uint64_t countFacesWithIndexOutOfRange(const Mesh& mesh);

/// Precondition: no index is out of range.
[[nodiscard]] MeshDefects findDefects(const Mesh& mesh, const FaceGeometry& geometry,
                                      std::span<const uint32_t> representatives);
[[nodiscard]] Components findComponents(const Mesh& mesh, const DualGraph& graph);

}  // namespace asdfvk
