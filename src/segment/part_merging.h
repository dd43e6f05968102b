#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/patches.h"

namespace asdfvk {

/// Weights of the cost of merging two regions (docs/segmentation.md has the formula).
struct MergeWeights {
  /// Weights of the shares of blocked lines of sight, between near patches and between all patches.
  double localSight, sight;
  double step, borderStep;  ///< Weights of differences of log values: between the means of the regions, and between
                            ///< patches at the border.
  double concave, bend, convex;  ///< Weights of angles at the border: at concave edges, and between patches that form a
                                 ///< concave or convex bend.
  double neck;  ///< Weight of a neck: log values at the border that are below the means of both regions.
  double stepLimit, angleLimit;  ///< Upper limits of the differences, and of the angles in radians.
  double areaExponent, borderExponent;
  double threshold;  ///< Merging stops if the next cost is above this.
};

inline constexpr MergeWeights kSightWeights{0.3, 0.15, 0.5, 0.15, 3, 0.9, 0.18, 0.4, 2, 0.55, 0.375, -1.85, 0.0335};
inline constexpr MergeWeights kShapeWeights{0, 0, 0.5, 0.2, 4.25, 0.67, 0.15, 0.18, 2.3, 1, 0.38, -1.2, 0.0363};

/// Visibility of pairs of patches: a symmetric matrix of numbers from 0 to 1, initially 1.
class SightMatrix {
 public:
  explicit SightMatrix(uint32_t count) : count_(count), entries_(size_t{count} * count, 1.0f) {}

  [[nodiscard]] uint32_t size() const { return count_; }
  [[nodiscard]] float at(uint32_t i, uint32_t j) const { return entries_[size_t{i} * count_ + j]; }
  void set(uint32_t i, uint32_t j, float sight) {
    entries_[size_t{i} * count_ + j] = entries_[size_t{j} * count_ + i] = sight;
  }

 private:
  uint32_t count_;
  std::vector<float> entries_;
};

/// Regions of patches, which are merged pair by pair, in the order of costs. Copies are independent. Deterministic.
class PartMerging {
 public:
  /// sight: visibility of each pair of patches of `data`.
  PartMerging(const PatchData& data, const SightMatrix& sight, const MergeWeights& weights);

  [[nodiscard]] uint32_t regionCount() const { return regionCount_; }
  /// The cost of the next merge; unset if no two regions are adjacent.
  [[nodiscard]] std::optional<double> nextCost() const;

  void mergeUpTo(double threshold);
  /// Merges until there are at most `count` regions, or until no two regions are adjacent.
  void mergeToCount(uint32_t count);

  /// A merge of two regions, each numbered by one of its patches; `kept` is then the number of the union.
  struct Merge {
    uint32_t kept, removed;
    double cost;
  };
  [[nodiscard]] std::span<const Merge> merges() const { return merges_; }  ///< In their order.
  /// The region of each patch, numbered from 0 by the first patch.
  [[nodiscard]] std::vector<uint32_t> regionOfPatches() const;

 private:
  struct Region {
    double area, logSum;  ///< logSum: area times log value.
    bool isAlive = true;
    std::vector<uint32_t> borders;
  };
  struct Border {
    uint32_t a, b;
    /// Each member except `length` is a sum of products: length times the named quantity. crease: concave minus convex
    /// angles of edges. mean: mean log value of the two patches.
    double length, crease, bend, step, mean;
    double cost = 0;
    bool isAlive = true;

    [[nodiscard]] uint32_t other(uint32_t region) const { return region == a ? b : a; }
  };
  /// Sums over the pairs of patches of two regions. seen: product of the areas, times the visibility. near: product of
  /// the areas, times a weight that decreases with the distance. nearSeen: product of the areas, the visibility and the
  /// same weight.
  struct PairSums {
    float seen = 0, nearSeen = 0, near = 0;
  };

  [[nodiscard]] double costOf(const Border& border) const;
  /// Returns `border` if it is alive and cheaper than `cheapest`, else `cheapest`. cheapest: may be kNoBorder.
  [[nodiscard]] uint32_t cheaperOf(uint32_t cheapest, uint32_t border) const;
  /// The border of least cost. If several borders have the least cost, the first of them.
  [[nodiscard]] uint32_t cheapestBorder() const;
  void merge(uint32_t border);
  [[nodiscard]] PairSums& pairSums(uint32_t i, uint32_t j) { return pairs_[size_t{i} * regions_.size() + j]; }
  [[nodiscard]] const PairSums& pairSums(uint32_t i, uint32_t j) const {
    return pairs_[size_t{i} * regions_.size() + j];
  }

  MergeWeights weights_;
  std::vector<Region> regions_;  ///< One per patch; not alive if merged into another region.
  std::vector<Border> borders_;
  std::vector<PairSums> pairs_;
  std::vector<uint32_t> regionOf_;  ///< One region per patch.
  std::vector<Merge> merges_;
  uint32_t regionCount_;
};

}  // namespace asdfvk
