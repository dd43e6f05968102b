#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bvh/normal_bounds.h"
#include "core/parallel.h"
#include "trace/ball_shrinker.h"
#include "trace/chunks.h"
#include "trace/seed_order.h"
#include "trace/triangle_planes.h"

namespace asdfvk {
namespace {

/// Added to the radius for the distances to boxes, which are computed in float32: covers their rounding at coordinates
/// up to 8 and squared radii up to 64. Diameters are computed in double.
constexpr double kBallBoxMargin = 0x1p-19;
/// Every box is near to larger balls.
constexpr double kMaxBoxedDiameter = 8;

constexpr size_t kFirstChunkFaceCount = 1024, kGrain = 64;

/// What the walks of all faces share.
struct WallScene {
  TraceScene scene;
  OpposingWalls walls;
  std::vector<NormalBounds> normalBounds;
  std::vector<TrianglePlane> planes;
};

/// One traversal of the hierarchy with the balls at one point of a face, or at all of its points.
class BallWalk {
 public:
  /// points: the point, or the corners of the face.
  BallWalk(const WallScene& scene, uint32_t face, std::span<const Vec3d> points, InscribedBall& found)
      : scene_(scene),
        found_(found),
        face_{{}, scene.scene.geometry.normals[face]},
        pointCount_(points.size()),
        axis_(-face_.normal),
        ownFace_(scene.scene.representatives[face]),
        normalTest_(face_.normal, scene.walls.cosine) {
    std::copy(points.begin(), points.end(), face_.corners.begin());
    for (const Vec3d& point : points) bounds_.add(point);
    update();
  }

  void run() {
    const std::span<const BvhNode> nodes = scene_.scene.bvh.nodes;
    if (nodes.empty()) return;
    std::array<uint32_t, kMaxBvhDepth + 1> stack;
    size_t stackSize = 0;
    stack[stackSize++] = 0;
    while (stackSize > 0) {
      const BvhNode& node = nodes[stack[--stackSize]];
      if (!reaches(squaredDistance(node))) continue;  // The balls may have shrunk since the node was pushed.
      if (node.isLeaf()) {
        testLeaf(node);
        continue;
      }
      uint32_t nearer = node.first, farther = node.first + 1;
      float nearDistance = distanceIfOpposing(nearer), farDistance = distanceIfOpposing(farther);
      if (farDistance < nearDistance) {
        std::swap(nearer, farther);
        std::swap(nearDistance, farDistance);
      }
      if (reaches(farDistance)) stack[stackSize++] = farther;
      if (reaches(nearDistance)) stack[stackSize++] = nearer;
    }
  }

 private:
  /// The box of the centres of the balls, and their radius.
  void update() {
    const double diameter = std::min(found_.ball.diameter, kMaxBoxedDiameter);
    const Vec3d shift = 0.5 * diameter * axis_;
    low_ = Vec3f(bounds_.min + shift);
    high_ = Vec3f(bounds_.max + shift);
    const double radius = 0.5 * diameter + kBallBoxMargin;
    squaredRadius_ = found_.ball.diameter < kMaxBoxedDiameter ? static_cast<float>(radius * radius)
                                                              : std::numeric_limits<float>::max();
  }

  [[nodiscard]] bool reaches(float squaredDistance) const { return squaredDistance < squaredRadius_; }

  /// From the box of the centres to another box.
  [[nodiscard]] float squaredDistance(const BvhNode& box) const {
    const auto gap = [](float low, float high, float centreLow, float centreHigh) {
      return std::max(std::max(low - centreHigh, centreLow - high), 0.0f);
    };
    const float x = gap(box.min.x, box.max.x, low_.x, high_.x), y = gap(box.min.y, box.max.y, low_.y, high_.y),
                z = gap(box.min.z, box.max.z, low_.z, high_.z);
    return x * x + y * y + z * z;
  }

  /// Infinite where no face below the node is an opposing wall.
  [[nodiscard]] float distanceIfOpposing(uint32_t node) const {
    return normalTest_.mayHold(scene_.normalBounds[node]) ? squaredDistance(scene_.scene.bvh.nodes[node])
                                                          : std::numeric_limits<float>::infinity();
  }

  /// Of the balls that touch the plane of a wall: those that touch the wall are at least as large.
  [[nodiscard]] double leastByPlane(const TrianglePlane& plane) const {
    double least = std::numeric_limits<double>::infinity();
    bool isAbove = false, isBelow = false;
    for (size_t k = 0; k < pointCount_; ++k) {
      const double offset = plane.offset - dot(plane.normal, face_.corners[k]);
      (offset < 0 ? isBelow : isAbove) = true;
      least = std::min(least, planeDiameter(axis_, plane.normal, offset));
    }
    return isAbove && isBelow ? 0 : least;
  }

  void testLeaf(const BvhNode& leaf) {
    for (uint32_t primitive = leaf.first; primitive < leaf.first + leaf.triangleCount; ++primitive) {
      const TrianglePlane& plane = scene_.planes[primitive];
      if (!scene_.walls.contain(face_.normal, plane.normal)) continue;
      if (leastByPlane(plane) >= found_.ball.diameter) continue;
      const uint32_t wall = scene_.scene.bvh.primitiveFaces[primitive];
      if (wall == ownFace_) continue;
      const PlaneTriangle triangle = triangleOf(scene_.scene, wall);
      const TouchingBall ball =
          pointCount_ == 1
              ? leastTouchingBall(face_.corners[0], face_.normal, triangle, kMinWallDepth, found_.ball.diameter)
              : leastTouchingBall(face_, triangle, kMinWallDepth, found_.ball.diameter);
      if (!(ball.diameter < found_.ball.diameter)) continue;
      found_ = {ball, wall};
      update();
    }
  }

  const WallScene& scene_;
  InscribedBall& found_;
  PlaneTriangle face_;
  size_t pointCount_;
  Vec3d axis_;
  uint32_t ownFace_;
  NormalBoundsTest normalTest_;
  Box3d bounds_;
  Vec3f low_, high_;
  float squaredRadius_ = 0;
};

class ReferenceBallShrinker final : public BallShrinker {
 public:
  ReferenceBallShrinker(const TraceScene& scene, const OpposingWalls& walls)
      : order_(scene), scene_{scene, walls, normalBoundsOf(scene.bvh, scene.geometry), trianglePlanes(scene)} {}

  uint64_t shrink(std::span<FaceBalls> faces, const RunControl& control) override {
    std::vector<uint32_t> indices(faces.size());
    std::transform(faces.begin(), faces.end(), indices.begin(), [](const FaceBalls& balls) { return balls.face; });
    const std::vector<uint32_t> order = order_.of(indices);
    forEachChunk(faces.size(), ChunkSize(kFirstChunkFaceCount, faces.size()), control, [&](size_t begin, size_t end) {
      forEachRange(end - begin, kGrain, [&](size_t first, size_t last) {
        for (size_t i = begin + first; i < begin + last; ++i) shrinkOne(faces[order[i]]);
      });
    });
    return 0;
  }

 private:
  void shrinkOne(FaceBalls& balls) const {
    const Vec3d barycentre = scene_.scene.originOf(balls.face);
    BallWalk(scene_, balls.face, {&barycentre, 1}, balls.atBarycentre).run();
    if (balls.atBarycentre.ball.diameter < balls.least.ball.diameter) balls.least = balls.atBarycentre;
    BallWalk(scene_, balls.face, triangleOf(scene_.scene, balls.face).corners, balls.least).run();
  }

  SeedOrder order_;
  WallScene scene_;
};

}  // namespace

PlaneTriangle triangleOf(const TraceScene& scene, uint32_t face) {
  const Face& corners = scene.mesh.faces[face];
  const auto corner = [&](size_t k) { return scene.bvh.normalization.toNormalized(scene.mesh.vertices[corners[k]]); };
  return {{corner(0), corner(1), corner(2)}, scene.geometry.normals[face]};
}

std::unique_ptr<BallShrinker> makeReferenceBallShrinker(const TraceScene& scene, const OpposingWalls& walls) {
  return std::make_unique<ReferenceBallShrinker>(scene, walls);
}

}  // namespace asdfvk
