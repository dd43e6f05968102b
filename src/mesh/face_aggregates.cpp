#include "mesh/face_aggregates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/bucket_sort.h"
#include "core/check.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/prefetch.h"

namespace asdfvk {
namespace {

constexpr double kMaxAngleDegrees = 10;  // Between the normals of a face and of the centre of its aggregate.
constexpr double kBentAngleDegrees = 5;  // At this angle between two faces the weight of an arc is 1/2.
// Two sweeps with this relaxation are as accurate as four Jacobi iterations (bench/experiments.md).
constexpr int kSweepCount = 2;
constexpr double kRelaxation = 1.2;
constexpr size_t kSweepBlockSize = 4096;  // A sweep reads the new values of faces of the same block only.
constexpr size_t kPrefetchDistance = 16;  // Unit: faces.
constexpr uint32_t kNoAggregate = 0xffffffff;

double inRadians(double degrees) { return degrees * (std::numbers::pi / 180); }

/// A range of consecutive faces, and the aggregates of these faces.
struct Block {
  uint32_t begin = 0, end = 0;
  std::vector<uint32_t> centres;     ///< One per aggregate.
  std::vector<uint32_t> memberEnds;  ///< One per aggregate: the end of its faces in `members`.
};

/// Builds the aggregates of a block one after another, in the order of the faces.
class AggregateGrower {
 public:
  /// aggregateOf: #F. For each face of the block, receives the index of its aggregate in the block. members: #F.
  /// Receives the faces of each aggregate; the first of them is the centre.
  AggregateGrower(const DualGraph& graph, const FaceGeometry& geometry, const AggregateLimits& limits, Block& block,
                  std::span<uint32_t> aggregateOf, std::span<uint32_t> members)
      : graph_(graph),
        geometry_(geometry),
        limits_(limits),
        block_(block),
        aggregateOf_(aggregateOf),
        members_(members),
        memberEnd_(block.begin) {}

  void growAll() {
    std::ranges::fill(aggregateOf_.subspan(block_.begin, block_.end - block_.begin), kNoAggregate);
    for (uint32_t face = block_.begin; face < block_.end; ++face)
      if (aggregateOf_[face] == kNoAggregate) grow(face);
  }

 private:
  void grow(uint32_t centre) {
    maxLength_ = limits_.lengths[limits_.componentOf[centre]];
    uint32_t next = memberEnd_;
    add(centre);
    for (uint32_t arc = 0; maxLength_ > 0 && arc < limits_.arcCount; ++arc)
      for (const uint32_t end = memberEnd_; next < end; ++next)
        for (const uint32_t neighbour : graph_.neighboursOf(members_[next]))
          if (isFree(neighbour) && isWithinLimits(centre, neighbour)) add(neighbour);
    block_.centres.push_back(centre);
    block_.memberEnds.push_back(memberEnd_);
  }
  void add(uint32_t face) {
    aggregateOf_[face] = static_cast<uint32_t>(block_.centres.size());
    members_[memberEnd_++] = face;
  }
  [[nodiscard]] bool isFree(uint32_t face) const {
    return face >= block_.begin && face < block_.end && aggregateOf_[face] == kNoAggregate;
  }
  [[nodiscard]] bool isWithinLimits(uint32_t centre, uint32_t face) const {
    const Vec3d between = (geometry_.barycentres[face] - geometry_.barycentres[centre]) / maxLength_;
    return dot(geometry_.normals[face], geometry_.normals[centre]) >= minCosine_ && dot(between, between) <= 1;
  }

  const DualGraph& graph_;
  const FaceGeometry& geometry_;
  const AggregateLimits limits_;
  const double minCosine_ = cosine(inRadians(kMaxAngleDegrees));
  Block& block_;
  std::span<uint32_t> aggregateOf_, members_;
  uint32_t memberEnd_;
  double maxLength_ = 0;  // Greatest distance of a face from the centre of the current aggregate.
};

/// Divides the faces into blocks. If more than kMaxCrossingShare of the arcs connect two blocks, all faces are one
/// block.
std::vector<Block> blocksOf(const DualGraph& graph) {
  constexpr uint32_t kBlockSize = 1 << 16;
  constexpr double kMaxCrossingShare = 0.02;
  // The arcs of every 61st face are counted. With a power of two instead of 61, these faces would all be at borders of
  // coarser faces if the mesh is subdivided.
  constexpr uint32_t kFacesPerSample = 61;
  const uint32_t faceCount = graph.faceCount();
  uint64_t arcCount = 0, crossingCount = 0;
  for (uint64_t face = 0; face < faceCount; face += kFacesPerSample)
    for (const uint32_t neighbour : graph.neighboursOf(static_cast<uint32_t>(face))) {
      ++arcCount;
      crossingCount += neighbour / kBlockSize != face / kBlockSize ? 1 : 0;
    }
  const bool isOneBlock = static_cast<double>(crossingCount) > kMaxCrossingShare * static_cast<double>(arcCount);
  const uint32_t blockSize = isOneBlock ? faceCount : kBlockSize;
  std::vector<Block> blocks;
  for (uint32_t begin = 0; begin < faceCount; begin = blocks.back().end)
    blocks.push_back({.begin = begin, .end = begin + std::min(blockSize, faceCount - begin)});
  return blocks;
}

/// Sets all members of `aggregates` except `graph`. Returns the faces of each aggregate; the first is the centre.
Buckets<uint32_t> growAggregates(const DualGraph& graph, const FaceGeometry& geometry, const AggregateLimits& limits,
                                 FaceAggregates& aggregates) {
  std::vector<Block> blocks = blocksOf(graph);
  aggregates.aggregateOf.resize(graph.faceCount());
  Buckets<uint32_t> members{{}, UnsetVector<uint32_t>(graph.faceCount())};
  forEachTask(blocks.size(), [&](size_t i) {
    AggregateGrower(graph, geometry, limits, blocks[i], aggregates.aggregateOf, members.entries).growAll();
  });
  std::vector<uint32_t> first(1, 0);  // The first aggregate of each block.
  for (const Block& block : blocks) first.push_back(first.back() + static_cast<uint32_t>(block.centres.size()));
  aggregates.centres.resize(first.back());
  members.offsets.resize(first.back() + size_t{1});
  members.offsets[0] = 0;
  forEachTask(blocks.size(), [&](size_t i) {
    std::ranges::copy(blocks[i].centres, aggregates.centres.begin() + first[i]);
    std::ranges::copy(blocks[i].memberEnds, members.offsets.begin() + first[i] + 1);
    for (uint32_t face = blocks[i].begin; face < blocks[i].end; ++face) aggregates.aggregateOf[face] += first[i];
  });
  aggregates.sizes.resize(first.back());
  forEachInParallel(aggregates.sizes.size(), [&](uint32_t aggregate) {
    aggregates.sizes[aggregate] = static_cast<uint32_t>(members[aggregate].size());
  });
  return members;
}

/// Sets aggregates.graph.
void connect(const DualGraph& graph, const Buckets<uint32_t>& members, FaceAggregates& aggregates) {
  constexpr uint32_t kBlockSize = 4096;
  const auto aggregateCount = static_cast<uint32_t>(aggregates.centres.size());
  std::vector<std::vector<uint32_t>> blocks((aggregateCount + kBlockSize - 1) / kBlockSize);
  UnsetVector<uint32_t>& offsets = aggregates.graph.offsets;
  offsets.resize(aggregateCount + size_t{1});
  offsets[0] = 0;
  forEachTask(blocks.size(), [&](size_t block) {
    std::vector<uint32_t>& rows = blocks[block];
    for (auto aggregate = static_cast<uint32_t>(block) * kBlockSize;
         aggregate < std::min((static_cast<uint32_t>(block) + 1) * kBlockSize, aggregateCount); ++aggregate) {
      const auto begin = static_cast<std::ptrdiff_t>(rows.size());
      for (const uint32_t face : members[aggregate])
        for (const uint32_t neighbour : graph.neighboursOf(face))
          if (aggregates.aggregateOf[neighbour] != aggregate) rows.push_back(aggregates.aggregateOf[neighbour]);
      std::sort(rows.begin() + begin, rows.end());
      rows.erase(std::unique(rows.begin() + begin, rows.end()), rows.end());
      offsets[aggregate + 1] = static_cast<uint32_t>(rows.size() - static_cast<size_t>(begin));
    }
  });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  aggregates.graph.neighbours.resize(offsets.back());
  forEachTask(blocks.size(), [&](size_t block) {
    std::copy(blocks[block].begin(), blocks[block].end(),
              aggregates.graph.neighbours.begin() + offsets[block * kBlockSize]);
  });
}

}  // namespace

FaceAggregates buildFaceAggregates(const DualGraph& graph, const FaceGeometry& geometry,
                                   const AggregateLimits& limits) {
  ASDFVK_CHECK_OP(limits.componentOf.size(), ==, size_t{graph.faceCount()});
  FaceAggregates aggregates;
  connect(graph, growAggregates(graph, geometry, limits, aggregates), aggregates);
  return aggregates;
}

void spreadFromCentres(const DualGraph& graph, const FaceGeometry& geometry, const FaceAggregates& aggregates,
                       std::vector<double>& values) {
  // The square of a small angle is 2 (1 - cosine).
  const double perVersine = 2 / (inRadians(kBentAngleDegrees) * inRadians(kBentAngleDegrees));
  forEachInParallel(values.size(), [&](uint32_t face) {
    if (!aggregates.isCentre(face)) values[face] = values[aggregates.centreOf(face)];
  });
  UnsetVector<double> other(values.size());
  static_assert(kSweepCount % 2 == 0);  // The last sweep writes to `values`.
  const auto relax = [&](uint32_t face, std::span<const double> from, std::span<double> to, size_t begin, size_t end) {
    const double own = from[face];
    double sum = 0, weightSum = 0;  // Differences are summed instead of values, so that equal values remain equal.
    double least = 0, greatest = 0;
    for (const uint32_t neighbour : graph.neighboursOf(face)) {
      const double difference = (neighbour >= begin && neighbour < end ? to : from)[neighbour] - own;
      if (!std::isfinite(difference)) continue;
      const double versine = 1 - dot(geometry.normals[face], geometry.normals[neighbour]);
      const double weight = 1 / (1 + perVersine * versine);
      sum += weight * difference;
      weightSum += weight;
      least = std::min(least, difference);
      greatest = std::max(greatest, difference);
    }
    if (weightSum > 0) to[face] = own + std::clamp(kRelaxation * sum / weightSum, least, greatest);
  };
  std::span<double> from = values, to = other;
  for (int sweep = 0; sweep < kSweepCount; ++sweep, std::swap(from, to))
    forEachTask((values.size() + kSweepBlockSize - 1) / kSweepBlockSize, [&](size_t block) {
      const size_t begin = block * kSweepBlockSize, end = std::min(begin + kSweepBlockSize, values.size());
      std::copy_n(&from[begin], end - begin, &to[begin]);
      for (size_t face = begin; face < end; ++face) {
        if (const size_t later = face + kPrefetchDistance; later < end)
          for (const uint32_t neighbour : graph.neighboursOf(static_cast<uint32_t>(later)))
            prefetchMemory(&geometry.normals[neighbour]);
        if (!aggregates.isCentre(static_cast<uint32_t>(face)) && std::isfinite(from[face]))
          relax(static_cast<uint32_t>(face), from, to, begin, end);
      }
    });
}

}  // namespace asdfvk
