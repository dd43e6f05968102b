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

constexpr size_t kFirstChunkBallCount = 1024, kGrain = 64;

/// One traversal of the hierarchy with a shrinking ball.
class BallWalk {
 public:
  BallWalk(const TraceScene& scene, std::span<const NormalBounds> normalBounds, std::span<const TrianglePlane> planes,
           const OpposingWalls& walls, InscribedBall& ball)
      : scene_(scene),
        normalBounds_(normalBounds),
        planes_(planes),
        walls_(walls),
        ball_(ball),
        origin_(scene.originOf(ball.face)),
        axis_(-scene.geometry.normals[ball.face]),
        ownFace_(scene.representatives[ball.face]),
        normalTest_(-axis_, walls.cosine) {
    update();
  }

  void run() {
    const std::span<const BvhNode> nodes = scene_.bvh.nodes;
    if (nodes.empty()) return;
    std::array<uint32_t, kMaxBvhDepth + 1> stack;
    size_t stackSize = 0;
    stack[stackSize++] = 0;
    while (stackSize > 0) {
      const BvhNode& node = nodes[stack[--stackSize]];
      if (!reaches(squaredDistance(node))) continue;  // The ball may have shrunk since the node was pushed.
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
  void update() {
    centre_ = Vec3f(origin_ + 0.5 * ball_.diameter * axis_);
    const double radius = 0.5 * ball_.diameter + kBallBoxMargin;
    squaredRadius_ = static_cast<float>(radius * radius);
  }

  [[nodiscard]] bool reaches(float squaredDistance) const { return squaredDistance < squaredRadius_; }

  /// From the centre of the ball to the box.
  [[nodiscard]] float squaredDistance(const BvhNode& box) const {
    const auto gap = [&](float low, float high, float centre) {
      return std::max(std::max(low - centre, centre - high), 0.0f);
    };
    const float x = gap(box.min.x, box.max.x, centre_.x), y = gap(box.min.y, box.max.y, centre_.y),
                z = gap(box.min.z, box.max.z, centre_.z);
    return x * x + y * y + z * z;
  }

  /// Infinity where no face below the node is an opposing wall.
  [[nodiscard]] float distanceIfOpposing(uint32_t node) const {
    return normalTest_.mayHold(normalBounds_[node]) ? squaredDistance(scene_.bvh.nodes[node])
                                                    : std::numeric_limits<float>::infinity();
  }

  void testLeaf(const BvhNode& leaf) {
    for (uint32_t primitive = leaf.first; primitive < leaf.first + leaf.triangleCount; ++primitive) {
      const TrianglePlane& plane = planes_[primitive];
      if (!walls_.contain(-axis_, plane.normal)) continue;
      if (planeDiameter(axis_, plane.normal, plane.offset - dot(plane.normal, origin_)) >= ball_.diameter) continue;
      const uint32_t face = scene_.bvh.primitiveFaces[primitive];
      if (face == ownFace_) continue;
      const double diameter = touchingDiameter(scene_, ball_.face, face, ball_.diameter);
      if (!(diameter < ball_.diameter)) continue;
      ball_.diameter = diameter;
      ball_.wall = face;
      update();
    }
  }

  const TraceScene& scene_;
  std::span<const NormalBounds> normalBounds_;
  std::span<const TrianglePlane> planes_;
  const OpposingWalls& walls_;
  InscribedBall& ball_;
  Vec3d origin_, axis_;
  uint32_t ownFace_;
  NormalBoundsTest normalTest_;
  Vec3f centre_;
  float squaredRadius_ = 0;
};

class ReferenceBallShrinker final : public BallShrinker {
 public:
  ReferenceBallShrinker(const TraceScene& scene, const OpposingWalls& walls)
      : scene_(scene),
        walls_(walls),
        order_(scene),
        normalBounds_(normalBoundsOf(scene.bvh, scene.geometry)),
        planes_(trianglePlanes(scene)) {}

  uint64_t shrink(std::span<InscribedBall> balls, const RunControl& control) override {
    std::vector<uint32_t> faces(balls.size());
    std::transform(balls.begin(), balls.end(), faces.begin(), [](const InscribedBall& ball) { return ball.face; });
    const std::vector<uint32_t> order = order_.of(faces);
    forEachChunk(balls.size(), ChunkSize(kFirstChunkBallCount, balls.size()), control, [&](size_t begin, size_t end) {
      forEachRange(end - begin, kGrain, [&](size_t first, size_t last) {
        for (size_t i = begin + first; i < begin + last; ++i)
          BallWalk(scene_, normalBounds_, planes_, walls_, balls[order[i]]).run();
      });
    });
    return 0;
  }

 private:
  TraceScene scene_;
  OpposingWalls walls_;
  SeedOrder order_;
  std::vector<NormalBounds> normalBounds_;
  std::vector<TrianglePlane> planes_;
};

}  // namespace

double touchingDiameter(const TraceScene& scene, uint32_t face, uint32_t wall, double limit) {
  const Vec3d origin = scene.originOf(face);
  const Face& corners = scene.mesh.faces[wall];
  const auto corner = [&](size_t k) {
    return scene.bvh.normalization.toNormalized(scene.mesh.vertices[corners[k]]) - origin;
  };
  return leastDiameter(-scene.geometry.normals[face], {corner(0), corner(1), corner(2), scene.geometry.normals[wall]},
                       limit);
}

std::unique_ptr<BallShrinker> makeReferenceBallShrinker(const TraceScene& scene, const OpposingWalls& walls) {
  return std::make_unique<ReferenceBallShrinker>(scene, walls);
}

}  // namespace asdfvk
