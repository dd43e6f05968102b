#include "estimate/held_out.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"

namespace asdfvk {
namespace {

/// The inclusion probabilities of the candidates (sampleHeldOut()).
class InclusionProbabilities {
 public:
  /// The sum of the probabilities is `count`. Precondition: `count` is below the number of candidates.
  InclusionProbabilities(std::span<const uint32_t> candidates, std::span<const double> indicator, uint64_t count,
                         std::span<const uint32_t> representedCounts)
      : representedCounts_(representedCounts), densities_(candidates.size()) {
    const auto greatest =
        maxInParallel<double>(candidates.size(), [&](uint32_t i) { return indicator[candidates[i]]; });
    forEachInParallel(candidates.size(), [&](size_t i) {
      // Relative to the greatest indicator, so that the power neither overflows nor underflows in any unit of length.
      // By square roots, because std::pow() has different bits on different systems.
      const double relative = indicator[candidates[i]] / greatest;
      densities_[i] = relative * std::sqrt(std::sqrt(std::sqrt(relative))) * representedCountOf(candidates[i]);
    });
    for (bool grows = true; grows;) {  // Repeated until no further probability reaches 1.
      double sum = 0, remaining = static_cast<double>(count);
      for (size_t i = 0; i < densities_.size(); ++i)
        if (of(i) < 1)
          sum += densities_[i];
        else
          remaining -= 1;
      grows = remaining / sum > scale_;
      if (grows) scale_ = remaining / sum;
    }
  }
  [[nodiscard]] size_t size() const { return densities_.size(); }
  [[nodiscard]] double of(size_t candidate) const { return std::min(1.0, scale_ * densities_[candidate]); }
  [[nodiscard]] double representedCountOf(uint32_t face) const {
    return representedCounts_.empty() ? 1 : representedCounts_[face];
  }

 private:
  std::span<const uint32_t> representedCounts_;
  std::vector<double> densities_;
  double scale_ = 0;
};

/// Returns ascending indices of candidates.
std::vector<uint32_t> samplePivotally(const InclusionProbabilities& probabilities, Random random) {
  std::vector<uint32_t> sample;
  uint32_t holder = 0;
  // The inclusion probability of `holder`, the only candidate before `next` that is neither sampled nor rejected yet.
  double held = 0;
  for (uint32_t next = 0; next < probabilities.size(); ++next) {
    const double own = probabilities.of(next), sum = held + own, number = random.real();
    if (sum < 1) {  // One of the two gets the probability of both. The other one is rejected.
      if (number * sum >= held) holder = next;
      held = sum;
    } else {  // One of the two is sampled. The other one keeps the rest of the probability.
      const bool takesHolder = number * (2 - sum) < 1 - own;
      sample.push_back(takesHolder ? holder : next);
      if (takesHolder) holder = next;
      held = sum - 1;
    }
  }
  if (random.real() < held) sample.push_back(holder);
  std::sort(sample.begin(), sample.end());
  return sample;
}

}  // namespace

HeldOutFaces sampleHeldOut(std::span<const uint32_t> candidates, std::span<const double> indicator, uint64_t count,
                           uint64_t randomSeed, std::span<const uint32_t> representedCounts) {
  if (count >= candidates.size())
    return {{candidates.begin(), candidates.end()}, std::vector<double>(candidates.size(), 0.0)};
  const InclusionProbabilities probabilities(candidates, indicator, count, representedCounts);
  const double candidatesPerFace = static_cast<double>(candidates.size()) / static_cast<double>(count);
  HeldOutFaces heldOut;
  for (const uint32_t i : samplePivotally(probabilities, Random(randomSeed))) {
    const uint32_t face = candidates[i];
    heldOut.faces.push_back(face);
    heldOut.weights.push_back((probabilities.representedCountOf(face) / probabilities.of(i) - 1) / candidatesPerFace);
  }
  return heldOut;
}

}  // namespace asdfvk
