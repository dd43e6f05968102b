#include "estimate/held_out.h"

#include <algorithm>

#include "core/random.h"

namespace asdfvk {
namespace {

/// Inclusion probabilities. A probability is proportional to the indicator times the represented count, and at most 1.
class InclusionProbabilities {
 public:
  /// The sum of the probabilities is `count`. Precondition: `count` is below the number of candidates.
  InclusionProbabilities(std::span<const uint32_t> candidates, std::span<const double> indicator, uint64_t count,
                         std::span<const uint32_t> representedCounts)
      : indicator_(indicator), representedCounts_(representedCounts) {
    for (bool grows = true; grows;) {  // Repeated until no further probability reaches 1.
      double sum = 0, remaining = static_cast<double>(count);
      for (const uint32_t face : candidates)
        if (of(face) < 1)
          sum += densityOf(face);
        else
          remaining -= 1;
      grows = remaining / sum > scale_;
      if (grows) scale_ = remaining / sum;
    }
  }
  [[nodiscard]] double of(uint32_t face) const { return std::min(1.0, scale_ * densityOf(face)); }
  [[nodiscard]] double representedCount(uint32_t face) const {
    return representedCounts_.empty() ? 1 : representedCounts_[face];
  }

 private:
  [[nodiscard]] double densityOf(uint32_t face) const { return indicator_[face] * representedCount(face); }

  std::span<const double> indicator_;
  std::span<const uint32_t> representedCounts_;
  double scale_ = 0;
};

std::vector<uint32_t> samplePivotally(std::span<const uint32_t> candidates, const InclusionProbabilities& probabilities,
                                      Random random) {
  std::vector<uint32_t> sample;
  uint32_t holder = 0;
  double held = 0;  // Inclusion probability of `holder`, given the decisions on all earlier faces. Of two faces, one is
                    // decided and the other becomes `holder`.
  for (const uint32_t face : candidates) {
    const double own = probabilities.of(face), sum = held + own, number = random.real();
    if (sum < 1) {  // `holder` or `face` receives the probability of both; the other is not sampled.
      if (number * sum >= held) holder = face;
      held = sum;
    } else {  // `holder` or `face` is sampled; the other keeps the rest of the probability.
      const bool takesHolder = number * (2 - sum) < 1 - own;
      sample.push_back(takesHolder ? holder : face);
      if (takesHolder) holder = face;
      held = sum - 1;
    }
  }
  if (random.real() < held) sample.push_back(holder);
  std::sort(sample.begin(), sample.end());
  return sample;
}

}  // namespace

void HeldOutFaces::append(const HeldOutFaces& further) {
  faces.insert(faces.end(), further.faces.begin(), further.faces.end());
  weights.insert(weights.end(), further.weights.begin(), further.weights.end());
}

HeldOutFaces sampleHeldOut(std::span<const uint32_t> candidates, std::span<const double> indicator, uint64_t count,
                           uint64_t randomSeed, std::span<const uint32_t> representedCounts) {
  if (count >= candidates.size())
    return {{candidates.begin(), candidates.end()}, std::vector<double>(candidates.size(), 0.0)};
  const InclusionProbabilities probabilities(candidates, indicator, count, representedCounts);
  const double candidatesPerFace = static_cast<double>(candidates.size()) / static_cast<double>(count);
  HeldOutFaces heldOut;
  heldOut.faces = samplePivotally(candidates, probabilities, Random(randomSeed));
  for (const uint32_t face : heldOut.faces)
    heldOut.weights.push_back((probabilities.representedCount(face) / probabilities.of(face) - 1) / candidatesPerFace);
  return heldOut;
}

}  // namespace asdfvk
