#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Random sample of faces for the unbiased measurement of the error of an interpolation that does not use them.
struct HeldOutFaces {
  std::vector<uint32_t> faces;
  /// Sampling weight c / p - 1, divided by the number of candidates per held-out face: the number of interpolated faces
  /// that the face stands for. p: inclusion probability; c: number of faces that the face represents.
  std::vector<double> weights;

  void append(const HeldOutFaces& further);
};

/// Random seed of held-out faces, independent of the seeds of samplers and of earlier rounds.
[[nodiscard]] constexpr uint64_t heldOutSeed(uint64_t randomSeed, uint64_t earlierHeldOutCount) {
  return (randomSeed ^ 0x7072'6f62'6500'0000u) + earlierHeldOutCount;
}

/// Samples `count` of the candidates, or all if there are fewer. The inclusion probability of a face is proportional to
/// its error indicator, times the number of faces that it represents, but at most 1. Ordered pivotal method (Deville
/// and Tille 1998, "Unequal probability sampling without replacement through a splitting method"; Chauvet 2012).
/// Neighbours in the list exclude each other, so that the sample is spread over the list. indicator: #F, above 0.
/// representedCounts: #F, or empty for 1. Returns ascending faces if the candidates are ascending.
[[nodiscard]] HeldOutFaces sampleHeldOut(std::span<const uint32_t> candidates, std::span<const double> indicator,
                                         uint64_t count, uint64_t randomSeed,
                                         std::span<const uint32_t> representedCounts = {});

}  // namespace asdfvk
