#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/edge_survey.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// What is wrong with a mesh. Counts of faces are triangles, also of a mesh of polygons. Edges are those of the
/// triangles with finite corners and three distinct vertices: any other triangle counts as missing, as it does for the
/// rays.
struct MeshDefects {
  uint64_t zeroAreaFaceCount = 0;   ///< With finite corners; see kDegenerateHeightRatio.
  uint64_t duplicateFaceCount = 0;  ///< Beyond the first of each set; see coincidentRepresentatives().
  uint64_t nonFiniteVertexCount = 0;
  uint64_t nonFiniteFaceCount = 0;  ///< Faces with a non-finite corner.
  uint64_t boundaryEdgeCount = 0;
  uint64_t nonManifoldEdgeCount = 0;     ///< Edges of more than two faces.
  uint64_t inconsistentEdgeCount = 0;    ///< Edges whose two faces run through them in the same direction.
  uint64_t unreferencedVertexCount = 0;  ///< In no triangle.
  uint64_t shortPolygonCount = 0;        ///< Input faces with fewer than three corners: no triangle, no value.
  bool isOfPolygons = false;             ///< The mesh's triangles were cut from polygons, and sentences call them so.

  /// One sentence per defect found, each with its count; empty for a clean mesh.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

/// Faces with an index at or above the vertex count. When there is any, nothing else can be computed on the mesh.
[[nodiscard]] uint64_t countFacesWithIndexOutOfRange(const TriangleMesh& mesh);

/// All are of the same mesh.
[[nodiscard]] MeshDefects findDefects(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                      std::span<const uint32_t> representatives, const EdgeSurvey& edges);

}  // namespace asdfvk
