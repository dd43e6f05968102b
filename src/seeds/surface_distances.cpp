#include "seeds/surface_distances.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
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

constexpr auto kNearestOnTop = [](const auto& a, const auto& b) { return a.distance > b.distance; };

}  // namespace

std::vector<float> arcLengths(const DualGraph& graph, const FaceGeometry& geometry) {
  ASDFVK_CHECK_OP(geometry.areas.size(), ==, graph.faceCount());
  std::vector<float> lengths(graph.neighbours.size());
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, graph.faceCount(), 4096), [&](const auto& range) {
    for (uint32_t face = range.begin(); face != range.end(); ++face)
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc)
        lengths[arc] = limitedLength(lengthAcross(signedDihedralAngle(geometry, face, graph.neighbours[arc])));
  });
  return lengths;
}

SurfaceDistances::SurfaceDistances(const DualGraph& graph, std::span<const float> arcLengths)
    : graph_(graph), arcLengths_(arcLengths), distances_(graph.faceCount(), kUnreached) {
  ASDFVK_CHECK_OP(arcLengths.size(), ==, graph.neighbours.size());
}

// A pushed face is popped soon, and its arcs are at a random place in memory.
void SurfaceDistances::prefetchArcs(uint32_t face) const {
  const uint32_t arc = graph_.offsets[face];
  if (arc == graph_.neighbours.size()) return;
  __builtin_prefetch(&graph_.neighbours[arc]);
  __builtin_prefetch(&arcLengths_[arc]);
}

void SurfaceDistances::push(Entry entry) {
  heap_.push_back(entry);
  std::push_heap(heap_.begin(), heap_.end(), kNearestOnTop);
}

SurfaceDistances::Entry SurfaceDistances::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), kNearestOnTop);
  const Entry entry = heap_.back();
  heap_.pop_back();
  return entry;
}

void SurfaceDistances::add(std::span<const uint32_t> seeds, float limit) {
  for (uint32_t seed : seeds) {
    distances_[seed] = 0;
    prefetchArcs(seed);
    push({0, seed});
  }
  while (!heap_.empty()) {
    const Entry entry = pop();
    if (entry.distance > distances_[entry.face]) continue;
    for (uint32_t arc = graph_.offsets[entry.face]; arc < graph_.offsets[entry.face + 1]; ++arc) {
      const float distance = entry.distance + arcLengths_[arc];
      float& stored = distances_[graph_.neighbours[arc]];
      if (distance >= stored || distance >= limit) continue;
      stored = distance;
      prefetchArcs(graph_.neighbours[arc]);
      push({distance, graph_.neighbours[arc]});
    }
  }
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
