#include "seeds/surface_ball.h"

#include <algorithm>
#include <limits>

#include "core/check.h"

namespace asdfvk {
namespace {

constexpr float kUntouched = std::numeric_limits<float>::infinity();

constexpr auto kNearestOnTop = [](const SurfaceBall::Member& a, const SurfaceBall::Member& b) {
  return a.distance > b.distance;
};

}  // namespace

SurfaceBall::SurfaceBall(const DualGraph& graph, std::span<const float> arcLengths)
    : graph_(graph), arcLengths_(arcLengths), distances_(graph.faceCount(), kUntouched) {
  ASDFVK_CHECK_OP(arcLengths.size(), ==, graph.neighbours.size());
}

void SurfaceBall::startAt(uint32_t centre) {
  for (uint32_t face : touched_) distances_[face] = kUntouched;
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
    if (distances_[face] == kUntouched) touched_.push_back(face);
    distances_[face] = distance;
    heap_.push_back({distance, face});
    std::push_heap(heap_.begin(), heap_.end(), kNearestOnTop);
  }
  return true;
}

}  // namespace asdfvk
