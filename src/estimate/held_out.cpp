#include "estimate/held_out.h"

#include <algorithm>

#include "core/random.h"

namespace asdfvk {
namespace {

/// The probabilities with which faces are chosen: in proportion to their density as far as that stays below 1.
class Chances {
 public:
  /// They add up to `count`, which is below the number of candidates.
  Chances(std::span<const uint32_t> candidates, std::span<const double> density, uint64_t count) : density_(density) {
    for (bool grows = true; grows;) {  // Until no more of them are certain.
      double sum = 0, left = static_cast<double>(count);
      for (const uint32_t face : candidates)
        if (of(face) < 1)
          sum += density[face];
        else
          left -= 1;
      grows = left / sum > scale_;
      if (grows) scale_ = left / sum;
    }
  }
  [[nodiscard]] double of(uint32_t face) const { return std::min(1.0, scale_ * density_[face]); }

 private:
  std::span<const double> density_;
  double scale_ = 0;
};

std::vector<uint32_t> choosePivotally(std::span<const uint32_t> candidates, const Chances& chances, Random random) {
  std::vector<uint32_t> chosen;
  uint32_t holder = 0;
  double held = 0;  // The holder's probability of being chosen, all before it being decided.
  for (const uint32_t face : candidates) {
    const double own = chances.of(face), sum = held + own, number = random.real();
    if (sum < 1) {  // One of both takes the other's chances.
      if (number * sum >= held) holder = face;
      held = sum;
    } else {  // One of both is chosen, the other keeps what is left.
      const bool choosesHolder = number * (2 - sum) < 1 - own;
      chosen.push_back(choosesHolder ? holder : face);
      if (choosesHolder) holder = face;
      held = sum - 1;
    }
  }
  if (random.real() < held) chosen.push_back(holder);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

void Probes::append(const Probes& further) {
  faces.insert(faces.end(), further.faces.begin(), further.faces.end());
  weights.insert(weights.end(), further.weights.begin(), further.weights.end());
}

Probes chooseProbes(std::span<const uint32_t> candidates, std::span<const double> density, uint64_t count,
                    uint64_t randomSeed) {
  if (count >= candidates.size())
    return {{candidates.begin(), candidates.end()}, std::vector<double>(candidates.size(), 0.0)};
  const Chances chances(candidates, density, count);
  const double facesPerProbe = static_cast<double>(candidates.size()) / static_cast<double>(count);
  Probes probes;
  probes.faces = choosePivotally(candidates, chances, Random(randomSeed));
  for (const uint32_t face : probes.faces) probes.weights.push_back((1 / chances.of(face) - 1) / facesPerProbe);
  return probes;
}

}  // namespace asdfvk
