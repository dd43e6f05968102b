#include "seeds/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

// Limits a length. NaN, which comes from coordinates whose squares overflow, becomes the maximum.
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

/// Number of arcs from the seeds after which SurfaceDistances::add() changes from a queue to a heap.
constexpr int kMaxQueueRounds = 64;

}  // namespace

UnsetVector<float> arcLengths(std::span<const float> arcAngles) {
  UnsetVector<float> lengths(arcAngles.size());
  forEachInParallel(lengths.size(), [&](size_t arc) { lengths[arc] = limitedLength(lengthAcross(arcAngles[arc])); });
  return lengths;
}

SurfaceDistances::SurfaceDistances(const DualGraph& graph, std::span<const float> arcLengths)
    : graph_(graph), arcLengths_(arcLengths), distances_(graph.faceCount(), kUnreached) {
  ASDFVK_CHECK_OP(arcLengths.size(), ==, graph.neighbours.size());
}

template <typename Put>
void SurfaceDistances::visit(const Pending& from, float limit, const Put& put) {
  if (from.distance > distances_[from.face]) return;
  for (uint32_t arc = graph_.offsets[from.face]; arc < graph_.offsets[from.face + 1]; ++arc) {
    const uint32_t face = graph_.neighbours[arc];
    const float distance = from.distance + arcLengths_[arc];
    if (face == from.parent || distance >= limit || distance >= distances_[face]) continue;
    distances_[face] = distance;
    prefetchArcs(face);
    put(Pending{distance, face, from.face});
  }
}

// The order of the visits does not change the distances: addition in float is monotonic, so that each distance becomes
// the least sum over all paths. Near faces are visited in the order of a queue (Moore, "The shortest path through a
// maze", 1959), which is faster than a heap if paths have few arcs. Farther faces are visited in the order of a heap
// (Dijkstra 1959), which bounds the time for any arc lengths.
void SurfaceDistances::add(std::span<const uint32_t> seeds, float limit) {
  for (uint32_t seed : seeds) {
    distances_[seed] = 0;
    pending_.push_back({0, seed, seed});
  }
  size_t next = 0;
  for (int round = 0; round < kMaxQueueRounds && next < pending_.size(); ++round)
    for (const size_t end = pending_.size(); next < end; ++next)
      visit(Pending(pending_[next]), limit, [&](const Pending& to) { pending_.push_back(to); });
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(next));
  std::make_heap(pending_.begin(), pending_.end(), kNearestOnTop);
  while (!pending_.empty()) {
    std::pop_heap(pending_.begin(), pending_.end(), kNearestOnTop);
    const Pending nearest = pending_.back();
    pending_.pop_back();
    visit(nearest, limit, [&](const Pending& to) {
      pending_.push_back(to);
      std::push_heap(pending_.begin(), pending_.end(), kNearestOnTop);
    });
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
