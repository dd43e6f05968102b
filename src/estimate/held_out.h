#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Faces chosen at random, so that what is interpolated without them can be judged at them without bias.
struct Probes {
  std::vector<uint32_t> faces;
  /// For how many of the faces that were not chosen each stands, over the mean number of faces per probe: the less, the
  /// likelier it was to be chosen.
  std::vector<double> weights;

  void append(const Probes& further);
};

/// Of the random numbers that choose probes: keeps them independent of those that place seeds and of earlier rounds'.
[[nodiscard]] constexpr uint64_t probeSeed(uint64_t randomSeed, uint64_t earlierProbeCount) {
  return (randomSeed ^ 0x7072'6f62'6500'0000u) + earlierProbeCount;
}

/// As many of the candidates (or all of them), each with a probability in proportion to its density, as far as that
/// stays below 1: by the ordered pivotal method (Deville and Tille 1998, "Unequal probability sampling without
/// replacement through a splitting method"; Chauvet 2012), in which neighbours in the list compete, so that probes are
/// spread over it. density: #F, above 0. Returns faces ascending, if the candidates are.
[[nodiscard]] Probes chooseProbes(std::span<const uint32_t> candidates, std::span<const double> density, uint64_t count,
                                  uint64_t randomSeed);

}  // namespace asdfvk
