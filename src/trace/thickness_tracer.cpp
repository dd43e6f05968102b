#include "trace/thickness_tracer.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "trace/chunks.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

constexpr double kNoDiameter = std::numeric_limits<double>::infinity();
constexpr uint64_t kFirstChunkFaceCount = 4096;
// Part of the progress in which the first balls are found; they shrink in the rest.
constexpr double kFoundProgress = 0.2;

/// The diameter by the hit of a ray, in normalised units, and the hit face.
struct Candidate {
  double diameter = kNoDiameter;
  uint32_t face = kNoFace;
  size_t ray = 0;
};

/// The first ball of one face.
class FirstBall {
 public:
  FirstBall(const TraceScene& scene, const Cone& cone, const OpposingWalls& walls, uint32_t face,
            std::span<const ConeHit> hits)
      : scene_(scene),
        cone_(cone),
        walls_(walls),
        face_(face),
        hits_(hits),
        normal_(scene.geometry.normals[face]),
        origin_(scene.originOf(face)) {}

  /// The ball, to be shrunk unless its wall is kNoFace; without any valid hit its diameter is infinite.
  [[nodiscard]] InscribedBall find() const {
    Candidate best = leastOf([&](size_t, uint32_t face) { return isOpposing(face); });
    if (best.face == kNoFace) {
      const RayHit axis = nearestHit(scene_.bvh, scene_.mesh, origin_, -normal_, scene_.representatives[face_]);
      if (axis.face == kNoFace || !isOpposing(axis.face)) return unrefined(axis);
      best = {axis.distance, axis.face, 0};
    }
    // In double from the wall: the distance of the hit is a float.
    const double touching = touchingDiameter(scene_, face_, best.face, kNoDiameter);
    return {face_, best.face, touching < kNoDiameter ? touching : best.diameter};
  }

 private:
  [[nodiscard]] bool isOpposing(uint32_t face) const { return walls_.contain(normal_, scene_.geometry.normals[face]); }

  /// accepts(ray, face) reads memory at random places: it is called for hits that would be the least only.
  template <typename Accepts>
  [[nodiscard]] Candidate leastOf(const Accepts& accepts) const {
    Candidate best;
    for (size_t ray = 0; ray < hits_.size(); ++ray) {
      const double diameter = static_cast<double>(hits_[ray].distance) / cone_.directions[ray].z;
      if (hits_[ray].face != kNoFace && diameter < best.diameter && accepts(ray, hits_[ray].face))
        best = {diameter, hits_[ray].face, ray};
    }
    return best;
  }

  [[nodiscard]] InscribedBall unrefined(const RayHit& axis) const {
    const ConeFrame frame = seedConeFrame(scene_, cone_, face_);
    const auto direction = [&](size_t ray) { return frame.toWorld(cone_.directions[ray]); };
    const auto isValid = [&](const Vec3d& along, uint32_t face) {
      return !isFalseHit(cone_, normal_, along, scene_.geometry.normals[face]);
    };
    const Candidate best = leastOf([&](size_t ray, uint32_t face) { return isValid(direction(ray), face); });
    double diameter = best.diameter;
    if (best.face != kNoFace) {
      const double length = lengthInDouble(direction(best.ray), best.face);
      if (length < kNoHit) diameter = length / cone_.directions[best.ray].z;
    }
    if (axis.face != kNoFace && isValid(-normal_, axis.face)) diameter = std::min(diameter, axis.distance);
    return {face_, kNoFace, diameter};
  }

  [[nodiscard]] double lengthInDouble(const Vec3d& direction, uint32_t face) const {
    const auto& [i, j, k] = scene_.mesh.faces[face];
    const auto corner = [&](uint32_t v) { return scene_.bvh.normalization.toNormalized(scene_.mesh.vertices[v]); };
    return rayTriangleDistance(RayFrame(origin_, direction), corner(i), corner(j), corner(k));
  }

  const TraceScene& scene_;
  const Cone& cone_;
  const OpposingWalls& walls_;
  uint32_t face_;
  std::span<const ConeHit> hits_;
  Vec3d normal_, origin_;
};

}  // namespace

ThicknessStatistics measureThickness(const TraceScene& scene, const Cone& cone, const OpposingWalls& walls,
                                     const SeedHits& hits, BallShrinker& shrinker, std::span<double> thickness,
                                     const RunControl& control) {
  ASDFVK_CHECK_OP(thickness.size(), ==, hits.seeds.size());
  std::vector<InscribedBall> balls(hits.seeds.size());
  forEachChunk(balls.size(), ChunkSize(kFirstChunkFaceCount, balls.size()), control.part(0, kFoundProgress),
               [&](size_t begin, size_t end) {
                 forEachInParallel(end - begin, [&](uint32_t offset) {
                   const size_t i = begin + offset;
                   balls[i] = FirstBall(scene, cone, walls, hits.seeds[i], hits.of(i)).find();
                 });
               });
  const auto toLength = [&](const InscribedBall& ball) {
    return ball.diameter < kNoDiameter ? scene.bvh.normalization.toMeshLength(ball.diameter) : kNoValue;
  };
  ThicknessStatistics statistics;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < balls.size(); ++i) {
    if (balls[i].wall != kNoFace) {
      indices.push_back(i);
      continue;
    }
    thickness[i] = toLength(balls[i]);
    statistics.unrefinedCount += balls[i].diameter < kNoDiameter ? 1 : 0;
  }
  for (size_t i = 0; i < indices.size(); ++i) balls[i] = balls[indices[i]];  // indices[i] >= i.
  balls.resize(indices.size());
  statistics.redoneBallCount = shrinker.shrink(balls, control.part(kFoundProgress, 1));
  for (size_t i = 0; i < indices.size(); ++i) thickness[indices[i]] = toLength(balls[i]);
  return statistics;
}

}  // namespace asdfvk
