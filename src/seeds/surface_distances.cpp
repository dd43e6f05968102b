#include "seeds/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "mesh/arc_values.h"
#include "mesh/curvature.h"

namespace asdfvk {
namespace {

// NaN, from coordinates whose squares overflow, becomes the maximum.
float limitedLength(double length) {
  return std::max(kMinArcLength, length < kMaxArcLength ? static_cast<float>(length) : kMaxArcLength);
}

double lengthAcross(double signedAngleRadians) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double scale = (signedAngleRadians > 0 ? kConcaveAngleDegrees : kConvexAngleDegrees) * kRadians;
  const double bend = signedAngleRadians / scale;
  return std::sqrt(1 + bend * bend);
}

}  // namespace

std::vector<float> arcLengths(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.areas.size(), ==, graph.faceCount());
  std::vector<float> lengths(graph.neighbours.size());
  setForEachPair(graph, std::span(lengths), [&](uint32_t face, uint32_t neighbour) {
    return limitedLength(lengthAcross(signedDihedralAngle(geometry, face, neighbour)));
  });
  return lengths;
}

SurfaceDistances::SurfaceDistances(const DualGraph& graph, std::span<const float> arcLengths)
    : graph_(graph), arcLengths_(arcLengths), distances_(graph.faceCount(), kUnreached) {
  ASDFVK_CHECK_OP(arcLengths.size(), ==, graph.neighbours.size());
}

void SurfaceDistances::add(std::span<const uint32_t> seeds, float limit) {
  struct Labels {
    const DualGraph& graph;
    std::span<const float> arcLengths;
    std::span<float> distances;
    [[nodiscard]] float at(uint32_t face) const { return distances[face]; }
    [[nodiscard]] static uint32_t faceOf(uint32_t node) { return node; }
    bool lower(uint32_t face, float distance, uint32_t& node) const {
      if (distance >= distances[face]) return false;
      node = face;
      distances[face] = distance;
      __builtin_prefetch(graph.neighbours.data() + graph.offsets[face]);
      __builtin_prefetch(arcLengths.data() + graph.offsets[face]);
      return true;
    }
  };
  for (uint32_t seed : seeds) {
    distances_[seed] = 0;
    pending_.push_back({0, seed, seed});
  }
  correctLabels(graph_, arcLengths_, limit, pending_, Labels{graph_, arcLengths_, distances_});
}

void SurfaceDistances::clear() { std::fill(distances_.begin(), distances_.end(), kUnreached); }

SurfaceBall::SurfaceBall(const DualGraph& graph, std::span<const float> arcLengths)
    : graph_(graph), arcLengths_(arcLengths), distances_(graph.faceCount(), SurfaceDistances::kUnreached) {
  ASDFVK_CHECK_OP(arcLengths.size(), ==, graph.neighbours.size());
}

void SurfaceBall::startAt(uint32_t centre) {
  for (uint32_t face : touched_) distances_[face] = SurfaceDistances::kUnreached;
  touched_.assign(1, centre);
  heap_.assign(1, {0, centre});
  distances_[centre] = 0;
}

bool SurfaceBall::next(Member& member) {
  do {
    if (heap_.empty()) return false;
    std::pop_heap(heap_.begin(), heap_.end(), kNearestOnTop);
    member = heap_.back();
    heap_.pop_back();
  } while (member.distance > distances_[member.face]);
  for (uint32_t arc = graph_.offsets[member.face]; arc < graph_.offsets[member.face + 1]; ++arc) {
    const uint32_t face = graph_.neighbours[arc];
    const float distance = member.distance + arcLengths_[arc];
    if (distance >= distances_[face]) continue;
    if (distances_[face] == SurfaceDistances::kUnreached) touched_.push_back(face);
    distances_[face] = distance;
    heap_.push_back({distance, face});
    std::push_heap(heap_.begin(), heap_.end(), kNearestOnTop);
  }
  return true;
}

}  // namespace asdfvk
