#include "segment/part_consensus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr double kMinPatchArea = 1e-12;  // Not 0, so that patches of zero area have a stability too.

/// For each pair of patches, the share of thresholds at which the division separates them.
std::vector<float> separationOf(const Division& division, double threshold) {
  PartMerging merging = *division.merging;
  merging.mergeToCount(1);
  const size_t count = division.data.patches.size();
  std::vector<float> separated(count * count, 1.0f);
  for (size_t patch = 0; patch < count; ++patch) separated[patch * count + patch] = 0;
  std::vector<std::vector<uint32_t>> members(count);
  for (uint32_t patch = 0; patch < count; ++patch) members[patch] = {patch};
  double share = 0;  // A merge of less cost than an earlier merge needs the threshold of the earlier merge.
  for (const auto& [kept, removed, cost] : merging.merges()) {
    share = std::max(share, std::clamp((std::log(cost / threshold) + 1) / 2, 0.0, 1.0));
    for (const uint32_t i : members[kept])
      for (const uint32_t j : members[removed])
        separated[i * count + j] = separated[j * count + i] = static_cast<float>(share);
    members[kept].insert(members[kept].end(), members[removed].begin(), members[removed].end());
    members[removed].clear();
  }
  return separated;
}

struct Overlap {
  uint32_t patch;
  float share;  ///< Share of the area of the base patch.
};

/// For each patch of `base`, the patches of `other` that overlap it.
std::vector<std::vector<Overlap>> overlapsOf(const PartSurface& surface, const Division& base, const Division& other) {
  std::vector<std::vector<Overlap>> overlaps(base.data.patches.size());
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const uint32_t from = base.patches.patchOf[face], to = other.patches.patchOf[face];
    if (from == kNoPatch || to == kNoPatch) continue;
    std::vector<Overlap>& list = overlaps[from];
    auto found = std::find_if(list.begin(), list.end(), [&](const Overlap& overlap) { return overlap.patch == to; });
    if (found == list.end()) found = list.insert(list.end(), {to, 0});
    found->share += std::max(surface.areas[face], static_cast<float>(kMinPatchArea));
  }
  for (std::vector<Overlap>& list : overlaps) {
    float sum = 0;
    for (const Overlap& overlap : list) sum += overlap.share;
    for (Overlap& overlap : list) overlap.share /= sum;
  }
  return overlaps;
}

/// The separation of `other` for pairs of patches of `base`.
std::vector<float> separationInBase(const PartSurface& surface, const Division& base, const Division& other,
                                    double threshold) {
  const std::vector<float> separated = separationOf(other, threshold);
  const std::vector<std::vector<Overlap>> overlaps = overlapsOf(surface, base, other);
  const size_t count = overlaps.size(), otherCount = other.data.patches.size();
  std::vector<float> rows(count * otherCount, 0), result(count * count, 0);
  for (size_t i = 0; i < count; ++i)
    for (const auto& [patch, share] : overlaps[i])
      for (size_t j = 0; j < otherCount; ++j) rows[j * count + i] += share * separated[patch * otherCount + j];
  for (size_t j = 0; j < count; ++j)
    for (const auto& [patch, share] : overlaps[j])
      for (size_t i = 0; i < count; ++i) result[j * count + i] += share * rows[patch * count + i];
  return result;
}

}  // namespace

PartConsensus::PartConsensus(const PartSurface& surface, std::span<const Division> divisions, double threshold) {
  const Division& base = divisions.back();
  const size_t count = base.data.patches.size();
  std::vector<std::vector<float>> separations(divisions.size());
  forEachTask(divisions.size(),
              [&](size_t i) { separations[i] = separationInBase(surface, base, divisions[i], threshold); });
  for (const PatchData::Patch& patch : base.data.patches) areas_.push_back(std::max(patch.area, kMinPatchArea));
  separated_.resize(count * count);
  for (size_t i = 0; i < count; ++i)
    for (size_t j = 0; j < i; ++j) {
      double sum = 0;
      for (const std::vector<float>& separation : separations)
        sum += double{separation[i * count + j]} + double{separation[j * count + i]};
      separated_[i * count + j] = separated_[j * count + i] =
          static_cast<float>(sum / static_cast<double>(2 * divisions.size()) * areas_[i] * areas_[j]);
    }
  for (const PatchData::Border& border : base.data.borders) borders_.push_back({border.a, border.b});
  for (uint32_t patch = 0; patch < count; ++patch) regionOf_.push_back(patch);
  regionCount_ = static_cast<uint32_t>(count);
}

double PartConsensus::stabilityOf(const Border& border) const {
  const auto [a, b] = border;
  return double{separated_[size_t{a} * areas_.size() + b]} / (areas_[a] * areas_[b]);
}

double PartConsensus::stability(uint32_t patchOfOne, uint32_t patchOfOther) const {
  return std::clamp(stabilityOf({regionOf_[patchOfOne], regionOf_[patchOfOther]}), 0.0, 1.0);
}

const PartConsensus::Border* PartConsensus::weakestBorder(uint32_t region) const {
  const Border* weakest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Border& border : borders_) {
    if (region != kNoRegion && border.a != region && border.b != region) continue;
    if (const double stability = stabilityOf(border); stability < least) {
      least = stability;
      weakest = &border;
    }
  }
  return weakest;
}

void PartConsensus::merge(Border border) {
  const uint32_t kept = border.a, removed = border.b;
  const size_t count = areas_.size();
  for (size_t other = 0; other < count; ++other) {
    separated_[kept * count + other] += separated_[removed * count + other];
    separated_[other * count + kept] = separated_[kept * count + other];
  }
  areas_[kept] += std::exchange(areas_[removed], 0.0);
  std::replace(regionOf_.begin(), regionOf_.end(), removed, kept);
  std::vector<uint8_t> isNeighbour(count, 0);
  std::erase_if(borders_, [&](Border& moved) {
    if (moved.a == removed) moved.a = kept;
    if (moved.b == removed) moved.b = kept;
    if (moved.a != kept && moved.b != kept) return false;
    const uint32_t other = moved.a == kept ? moved.b : moved.a;
    return other == kept || std::exchange(isNeighbour[other], 1) != 0;
  });
  --regionCount_;
}

void PartConsensus::mergeUpTo(double stability) {
  for (const Border* border = weakestBorder(kNoRegion); border != nullptr && stabilityOf(*border) <= stability;
       border = weakestBorder(kNoRegion))
    merge(*border);
}

void PartConsensus::mergeToCount(uint32_t count) {
  while (regionCount_ > count) {
    const Border* const border = weakestBorder(kNoRegion);
    if (border == nullptr) return;
    merge(*border);
  }
}

void PartConsensus::mergeSmallerThan(double area) {
  std::vector<uint8_t> isIsolated(areas_.size(), 0);
  for (;;) {
    uint32_t smallest = kNoRegion;
    for (uint32_t region = 0; region < areas_.size(); ++region)
      if (areas_[region] > 0 && areas_[region] < area && isIsolated[region] == 0 &&
          (smallest == kNoRegion || areas_[region] < areas_[smallest]))
        smallest = region;
    if (smallest == kNoRegion) return;
    if (const Border* const border = weakestBorder(smallest); border != nullptr)
      merge(*border);
    else
      isIsolated[smallest] = 1;
  }
}

std::vector<uint32_t> PartConsensus::regionOfPatches() const {
  std::vector<uint32_t> numbers(areas_.size(), kNoRegion), result;
  uint32_t count = 0;
  for (const uint32_t region : regionOf_) {
    if (numbers[region] == kNoRegion) numbers[region] = count++;
    result.push_back(numbers[region]);
  }
  return result;
}

}  // namespace asdfvk
