#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "cone/opposing_walls.h"
#include "cone/touching_ball.h"
#include "core/simd.h"
#include "shared/cone_hit.h"
#include "trace/solids.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A ball that touches a face from inside, in normalised coordinates.
struct InscribedBall {
  TouchingBall ball;
  uint32_t wall = kNoFace;  ///< The face that determines the diameter; kNoFace if there is none.
};

/// A query of WallTree::shrink(): two balls that shrink until no opposing wall is inside. On entry the diameters are
/// upper bounds.
struct BallQuery {
  PlaneTriangle triangle;  ///< A face or a part of it.
  Vec3d point;             ///< A point of the triangle.
  InscribedBall atPoint;   ///< The largest ball at the point.
  InscribedBall least;  ///< Each point of the triangle has such a largest ball. `least` is the smallest of these balls.
  uint32_t body = kNoBody;  ///< Body of the triangle, see Solids::bodyOf.
  /// Walls that are probably near, or kNoFace. They save time, and change no result.
  std::array<uint32_t, 2> hints{kNoFace, kNoFace};
};

/// A face.
struct Wall {
  Vec3f normal;
  float offset = 0;  ///< Offset of the plane along the normal.
  Vec3f min, max, middle;
  std::array<Vec3f, 3> spokes{};  ///< The corners relative to the middle.
  float reach = 0;                ///< Greatest distance from the middle to a corner.
  uint32_t face = kNoFace, body = kNoBody;
};

/// Bounds of the walls below a node of the hierarchy.
struct WallNode {
  Vec3f min, max, normalMin, normalMax;
  Vec3f middle;  ///< Middle of one of the walls.
  /// A mean of the normals. All corners of the walls are in a cylinder. The axis of the cylinder is the line through
  /// `middle` in this direction. Corners are within `radius` of the line, at positions from `lowest` to `highest` along
  /// the line, and at most `reach` from `middle`.
  Vec3f axis{};
  float lowest = 0, highest = 0, radius = 0, reach = 0;
  uint32_t first = 0;      ///< Inner: index of the left child; the right child follows. Leaf: first wall.
  uint32_t wallCount = 0;  ///< 0 for an inner node.
};

/// The faces as walls, and a hierarchy for the search. Neighbouring queries are processed together, one in each lane of
/// a vector: nodes and walls are culled in float32, and walls are measured in double. The method is the shrinking ball
/// of Ma, Bae and Choi 2012, but with one traversal instead of a query per step. One traversal suffices, because a wall
/// that is outside of the balls remains outside when they shrink. The reason: the balls of one diameter at all points
/// of a face fill a convex set, which contains the sets of smaller diameters.
class WallTree {
 public:
  /// solids: null if all faces may bound one body. Throws Error{Cancelled}.
  WallTree(const TraceScene& scene, const OpposingWalls& walls, const Solids* solids = nullptr,
           const RunControl& stopOnly = {});

  /// Shrinks the balls. Consecutive queries should be neighbours in space. The bits of the diameters depend neither on
  /// the order nor on the instruction set. If several walls give equal diameters, the wall with the lowest face index
  /// is taken.
  void shrink(std::span<BallQuery> queries, InstructionSet instructionSet = widestInstructionSet()) const;

  [[nodiscard]] const TraceScene& scene() const { return scene_; }
  [[nodiscard]] uint32_t bodyOf(uint32_t face) const { return walls_[wallOf_[face]].body; }
  [[nodiscard]] const OpposingWalls& opposing() const { return opposing_; }
  [[nodiscard]] std::span<const WallNode> nodes() const { return nodes_; }
  /// The walls in the order of the hierarchy: consecutive walls are neighbours in space. The last walls are copies of
  /// faces of the same body. They are not in the hierarchy, because they bound no other balls.
  [[nodiscard]] std::span<const Wall> walls() const { return walls_; }

 private:
  [[nodiscard]] Wall wallOf(uint32_t face) const;

  TraceScene scene_;
  OpposingWalls opposing_;
  std::vector<WallNode> nodes_;
  std::vector<Wall> walls_;
  std::vector<uint32_t> wallOf_;  ///< #F
};

}  // namespace asdfvk
