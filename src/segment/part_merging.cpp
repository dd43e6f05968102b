#include "segment/part_merging.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace asdfvk {
namespace {

constexpr double kMinCost = 1e-3;
constexpr double kKernelWidth = 0.7, kMinKernelWidth = 0.02, kKernelReach = 4;
constexpr uint32_t kNoBorder = 0xffffffff;

/// Angle between the mean normals of two patches in radians; negative if the border is concave.
double bendOf(const PatchData::Patch& p, const PatchData::Patch& q) {
  if (p.normal == Vec3d{} || q.normal == Vec3d{}) return 0;
  const double angle = std::atan2(length(cross(p.normal, q.normal)), dot(p.normal, q.normal));
  return dot(q.centre - p.centre, q.normal - p.normal) < 0 ? -angle : angle;
}

/// Weight of a pair of patches. The weight decreases with the ratio of the distance of the patches to their values.
double kernelOf(const PatchData::Patch& p, const PatchData::Patch& q) {
  const double width = kKernelWidth * std::exp((p.logValue + q.logValue) / 2) + kMinKernelWidth;
  const Vec3d between = p.centre - q.centre;
  const double squared = dot(between, between) / (width * width);
  return squared > kKernelReach * kKernelReach ? 0 : std::exp(-squared);
}

}  // namespace

PartMerging::PartMerging(const PatchData& data, const SightMatrix& sight, const MergeWeights& weights)
    : weights_(weights),
      pairs_(data.patches.size() * data.patches.size()),
      regionOf_(data.patches.size()),
      regionCount_(static_cast<uint32_t>(data.patches.size())) {
  ASDFVK_CHECK_OP(sight.size(), ==, regionCount_);
  for (uint32_t i = 0; i < regionCount_; ++i) {
    const PatchData::Patch& patch = data.patches[i];
    regionOf_[i] = i;
    regions_.push_back({patch.area, patch.area * patch.logValue, true, {}});
  }
  for (uint32_t i = 0; i < regionCount_; ++i)
    for (uint32_t j = i + 1; j < regionCount_; ++j) {
      const double area = data.patches[i].area * data.patches[j].area;
      const double near = area * kernelOf(data.patches[i], data.patches[j]);
      const double seen = double{sight.at(i, j)};
      pairSums(i, j) =
          pairSums(j, i) = {static_cast<float>(seen * area), static_cast<float>(seen * near), static_cast<float>(near)};
    }
  for (const PatchData::Border& border : data.borders) {
    const PatchData::Patch &p = data.patches[border.a], &q = data.patches[border.b];
    const auto index = static_cast<uint32_t>(borders_.size());
    for (const uint32_t region : {border.a, border.b}) regions_[region].borders.push_back(index);
    borders_.push_back({border.a, border.b, border.length, border.concave - border.convex, border.length * bendOf(p, q),
                        border.length * std::abs(p.logValue - q.logValue),
                        border.length * (p.logValue + q.logValue) / 2});
    borders_.back().cost = costOf(borders_.back());
  }
}

double PartMerging::costOf(const Border& border) const {
  const MergeWeights& w = weights_;
  const Region &p = regions_[border.a], &q = regions_[border.b];
  if (!(border.length > 0) || !(p.area > 0) || !(q.area > 0)) return 0;
  const PairSums& pair = pairSums(border.a, border.b);
  const double sight = double{pair.seen} / (p.area * q.area);
  const double localSight = pair.near > 0 ? double{pair.nearSeen} / double{pair.near} : 0;
  const double logP = p.logSum / p.area, logQ = q.logSum / q.area;
  const double step = std::min(w.stepLimit, std::abs(logP - logQ));
  const double borderStep = std::min(w.stepLimit, border.step / border.length);
  const double neck = std::clamp(std::min(logP, logQ) - border.mean / border.length, 0.0, 1.0);
  const double crease = std::clamp(border.crease / border.length, 0.0, w.angleLimit);
  const double concaveBend = std::clamp(-border.bend / border.length, 0.0, w.angleLimit);
  const double convexBend = std::clamp(border.bend / border.length, 0.0, w.angleLimit);
  const double sum = w.localSight * (1 - localSight) + w.sight * (1 - sight) + w.step * step +
                     w.borderStep * borderStep + w.concave * crease + w.bend * concaveBend - w.convex * convexBend +
                     w.neck * neck;
  const double area = std::min(p.area, q.area);
  return std::max(kMinCost, sum) * std::pow(area, w.areaExponent) *
         std::pow(border.length / std::sqrt(area), w.borderExponent);
}

uint32_t PartMerging::cheaperOf(uint32_t cheapest, uint32_t border) const {
  if (!borders_[border].isAlive) return cheapest;
  return cheapest == kNoBorder || borders_[border].cost < borders_[cheapest].cost ? border : cheapest;
}

uint32_t PartMerging::cheapestBorder() const {
  uint32_t cheapest = kNoBorder;
  for (uint32_t border = 0; border < borders_.size(); ++border) cheapest = cheaperOf(cheapest, border);
  return cheapest;
}

std::optional<double> PartMerging::nextCost() const {
  const uint32_t border = cheapestBorder();
  return border == kNoBorder ? std::nullopt : std::optional(borders_[border].cost);
}

void PartMerging::merge(uint32_t border) {
  const uint32_t a = borders_[border].a, b = borders_[border].b;
  merges_.push_back({a, b, borders_[border].cost});
  borders_[border].isAlive = false;
  Region &kept = regions_[a], &removed = regions_[b];
  kept.area += removed.area;
  kept.logSum += removed.logSum;
  removed.isAlive = false;
  --regionCount_;
  for (uint32_t& region : regionOf_)
    if (region == b) region = a;
  for (uint32_t other = 0; other < regions_.size(); ++other) {
    PairSums& sums = pairSums(a, other);
    const PairSums& further = pairSums(b, other);
    sums.seen += further.seen;
    sums.nearSeen += further.nearSeen;
    sums.near += further.near;
    pairSums(other, a) = sums;
  }
  for (const uint32_t index : removed.borders) {
    Border& moved = borders_[index];
    if (!moved.isAlive) continue;
    const uint32_t other = moved.other(b);
    const auto found = std::find_if(kept.borders.begin(), kept.borders.end(), [&](uint32_t candidate) {
      return borders_[candidate].isAlive && borders_[candidate].other(a) == other;
    });
    if (found == kept.borders.end()) {
      moved.a = a;
      moved.b = other;
      kept.borders.push_back(index);
      continue;
    }
    Border& sum = borders_[*found];
    sum.length += moved.length;
    sum.crease += moved.crease;
    sum.bend += moved.bend;
    sum.step += moved.step;
    sum.mean += moved.mean;
    moved.isAlive = false;
  }
  std::erase_if(kept.borders, [&](uint32_t index) { return !borders_[index].isAlive; });
  for (const uint32_t index : kept.borders) borders_[index].cost = costOf(borders_[index]);
}

void PartMerging::mergeUpTo(double threshold) {
  for (uint32_t border = cheapestBorder(); border != kNoBorder && borders_[border].cost <= threshold;
       border = cheapestBorder())
    merge(border);
}

void PartMerging::mergeToCount(uint32_t count) {
  while (regionCount_ > count) {
    const uint32_t border = cheapestBorder();
    if (border == kNoBorder) return;
    merge(border);
  }
}

std::vector<uint32_t> PartMerging::regionOfPatches() const {
  std::vector<uint32_t> numbers(regions_.size(), kNoBorder), result(regionOf_.size());
  uint32_t count = 0;
  for (size_t patch = 0; patch < result.size(); ++patch) {
    uint32_t& number = numbers[regionOf_[patch]];
    if (number == kNoBorder) number = count++;
    result[patch] = number;
  }
  return result;
}

}  // namespace asdfvk
