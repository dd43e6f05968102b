#pragma once

#include <cstdint>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "mesh/point_fans.h"
#include "trace/solids.h"

namespace asdfvk {

/// A line of connected edges at which opposing walls meet; or a tip, which is a point at which opposing walls without a
/// common edge meet.
struct SharpLine {
  double cosine = -1;  ///< Cosine of the least inner angle between the walls.
  double length = 0;   ///< Sum of the lengths of all edges; 0 for a tip.
  uint64_t edgeCount = 0;
  Vec3d place;  ///< The middle of the edge with the least angle, or the tip.
  uint32_t face = 0;
};

struct SharpEdges {
  std::vector<SharpLine> lines;  ///< By ascending angle.
  /// #F. Bit k: the face is sharp at its corner k. Bit 3 + k: the face is sharp along the edge that begins at corner k.
  std::vector<uint8_t> faceBits;

  [[nodiscard]] bool hasCorner(uint32_t face, size_t k) const { return (faceBits[face] >> k & 1) != 0; }
  [[nodiscard]] bool hasEdge(uint32_t face, size_t k) const { return (faceBits[face] >> (3 + k) & 1) != 0; }
};

/// Two faces of one body with a common point meet sharply under two conditions. The cosine of the angle between their
/// normals is at most maxCosine. The diameter of leastTouchingBall() with minDepth is at most kSharpDepths * minDepth.
/// solids: the bodies, or null if all faces may bound one body. In a fan of more than kMaxComparedFaces faces, each
/// face is compared with at most kMaxComparedFaces other faces, and with the faces that share an edge with it.
[[nodiscard]] SharpEdges findSharpEdges(const TriangleMesh& mesh, const FaceGeometry& geometry, const PointFans& fans,
                                        double maxCosine, double minDepth, const Solids* solids = nullptr);

inline constexpr size_t kMaxComparedFaces = 256;
inline constexpr double kSharpDepths = 2;

}  // namespace asdfvk
