#include "seeds/normal_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"
#include "core/random.h"
#include "seeds/samplers.h"

namespace asdfvk {
namespace {

constexpr uint16_t kNoBin = std::numeric_limits<uint16_t>::max();

using BinCounts = std::array<uint64_t, kNormalBinCount>;

// Equal steps of the angle divide the sphere more evenly than equal steps on the cube.
uint32_t stepOf(double tangent) {
  const double share = 0.5 + std::atan(tangent) * (2 / std::numbers::pi);
  return std::min(kBinsPerSide - 1, static_cast<uint32_t>(std::max(0.0, share * kBinsPerSide)));
}

// The largest level to which `count` new faces can fill all bins. A bin with too few candidates is filled to its last
// candidate.
uint64_t levelOf(const BinCounts& chosen, const BinCounts& available, uint64_t count) {
  const auto neededFor = [&](uint64_t level) {
    uint64_t needed = 0;
    for (uint32_t bin = 0; bin < kNormalBinCount; ++bin)
      needed += std::min(available[bin], level - std::min(level, chosen[bin]));
    return needed;
  };
  uint64_t low = 0, high = uint64_t{1} << 33;  // Bisection. `high` exceeds any number of faces.
  while (high - low > 1) {
    const uint64_t middle = low + (high - low) / 2;
    (neededFor(middle) <= count ? low : high) = middle;
  }
  return low;
}

}  // namespace

uint32_t normalBinOf(const Vec3d& normal) {
  size_t axis = 0;
  for (size_t other : {1, 2})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  const double along = std::abs(normal[axis]);
  const uint32_t u = stepOf(normal[(axis + 1) % 3] / along), v = stepOf(normal[(axis + 2) % 3] / along);
  const uint32_t side = 2 * static_cast<uint32_t>(axis) + (normal[axis] < 0 ? 1 : 0);
  return (side * kBinsPerSide + u) * kBinsPerSide + v;
}

std::vector<uint32_t> normalSpaceSeeds(const SeedDomain& domain, uint64_t count, std::span<const uint32_t> existing,
                                       uint64_t randomSeed) {
  std::vector<uint32_t> waiting = remainingCandidates(domain, existing);
  if (count >= waiting.size()) return waiting;
  std::vector<uint16_t> binOf(domain.graph.faceCount(), kNoBin);
  forEachInParallel(domain.graph.faceCount(), [&](uint32_t face) {
    if (!domain.geometry.isDegenerate(face))
      binOf[face] = static_cast<uint16_t>(normalBinOf(domain.geometry.normals[face]));
  });
  BinCounts chosen{}, available{};
  for (uint32_t face : existing)
    if (binOf[face] != kNoBin) ++chosen[binOf[face]];
  for (uint32_t face : waiting) {
    ASDFVK_CHECK_OP(binOf[face], !=, kNoBin);
    ++available[binOf[face]];
  }

  const uint64_t level = levelOf(chosen, available, count);
  BinCounts toTake{};
  std::vector<uint32_t> unfilledBins;
  uint64_t taken = 0;
  for (uint32_t bin = 0; bin < kNormalBinCount; ++bin) {
    toTake[bin] = std::min(available[bin], level - std::min(level, chosen[bin]));
    taken += toTake[bin];
    if (toTake[bin] < available[bin] && chosen[bin] <= level) unfilledBins.push_back(bin);
  }
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(unfilledBins));
  for (uint64_t i = 0; taken < count; ++i, ++taken) ++toTake[unfilledBins[i]];

  random.shuffle(std::span<uint32_t>(waiting));
  std::vector<uint32_t> seeds;
  seeds.reserve(static_cast<size_t>(count));
  for (uint32_t face : waiting)
    if (uint64_t& left = toTake[binOf[face]]; left > 0) {
      --left;
      seeds.push_back(face);
    }
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

}  // namespace asdfvk
