#include "pipeline/probe_choice.h"

#include <algorithm>

#include "core/random.h"

namespace asdfvk {
namespace {

/// In proportion to the densities as far as that stays below 1. Their sum is `count`, which is below their number.
std::vector<double> inclusionProbabilities(std::span<const double> densities, uint64_t count) {
  std::vector<double> probabilities(densities.size(), 0.0);
  for (bool isDone = false; !isDone;) {
    isDone = true;
    double sum = 0, left = static_cast<double>(count);
    for (size_t i = 0; i < densities.size(); ++i) {
      if (probabilities[i] < 1)
        sum += densities[i];
      else
        left -= 1;
    }
    for (size_t i = 0; i < densities.size(); ++i) {
      if (probabilities[i] == 1) continue;
      probabilities[i] = std::min(1.0, left * densities[i] / sum);
      if (probabilities[i] == 1) isDone = false;
    }
  }
  return probabilities;
}

/// Indices of the chosen.
std::vector<size_t> choosePivotally(std::span<const double> probabilities, Random random) {
  std::vector<size_t> chosen;
  size_t holder = 0;
  double held = 0;  // The holder's probability of being chosen, all before it being decided.
  for (size_t i = 0; i < probabilities.size(); ++i) {
    const double own = probabilities[i], sum = held + own, number = random.real();
    if (sum < 1) {  // One of both takes the other's chances.
      if (number * sum >= held) holder = i;
      held = sum;
    } else {  // One of both is chosen, the other keeps what is left.
      const bool choosesHolder = number * (2 - sum) < 1 - own;
      chosen.push_back(choosesHolder ? holder : i);
      if (choosesHolder) holder = i;
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
  std::vector<double> densities;
  for (const uint32_t face : candidates) densities.push_back(density[face]);
  const std::vector<double> probabilities = inclusionProbabilities(densities, count);
  const double facesPerProbe = static_cast<double>(candidates.size()) / static_cast<double>(count);
  Probes probes;
  for (const size_t i : choosePivotally(probabilities, Random(randomSeed))) {
    probes.faces.push_back(candidates[i]);
    probes.weights.push_back((1 / probabilities[i] - 1) / facesPerProbe);
  }
  return probes;
}

}  // namespace asdfvk
