#pragma once

#include <cstdint>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "mesh/point_fans.h"
#include "trace/solids.h"

namespace asdfvk {

/// Edges at which opposing walls meet, connected over their points; or a tip, which is one point at which opposing
/// walls meet without an edge.
struct SharpLine {
  double cosine = -1;  ///< Cosine of the least inner angle between the walls.
  double length = 0;   ///< Sum of the lengths of all edges; 0 for a tip.
  uint64_t edgeCount = 0;
  Vec3d place;  ///< The middle of the edge with the least angle, or the tip.
  uint32_t face = 0;
};

struct SharpEdges {
  std::vector<SharpLine> lines;  ///< By ascending angle.
  /// #F. Bit k: the face is sharp at its corner k. Bit 3 + k: it is sharp along the edge from corner k to the next
  /// corner.
  std::vector<uint8_t> faceBits;

  [[nodiscard]] bool hasCorner(uint32_t face, size_t k) const { return (faceBits[face] >> k & 1) != 0; }
  [[nodiscard]] bool hasEdge(uint32_t face, size_t k) const { return (faceBits[face] >> (3 + k) & 1) != 0; }
};

/// Two faces of one body that share a point meet sharply under two conditions. The cosine of the angle between their
/// normals is at most maxCosine. Their leastTouchingBall() with minDepth has a diameter of at most kSharpDepths *
/// minDepth. solids: the bodies, or null if all faces may bound one body. In a fan of more than kMaxComparedFaces
/// faces, each face is compared with at most kMaxComparedFaces others and with the faces that share an edge with it.
[[nodiscard]] SharpEdges findSharpEdges(const TriangleMesh& mesh, const FaceGeometry& geometry, const PointFans& fans,
                                        double maxCosine, double minDepth, const Solids* solids = nullptr);

inline constexpr size_t kMaxComparedFaces = 256;
inline constexpr double kSharpDepths = 2;

}  // namespace asdfvk
