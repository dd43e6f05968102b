#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/seed_domain.h"

namespace asdfvk {

/// The directions in bins of about the same size: a grid of kBinsPerSide^2 on each side of a cube, of 10 degrees each
/// along its middle lines. The axes are in the middle of a bin, so that rounding does not scatter an axis-aligned wall.
inline constexpr uint32_t kBinsPerSide = 9;
inline constexpr uint32_t kNormalBinCount = 6 * kBinsPerSide * kBinsPerSide;
/// normal: unit. Below kNormalBinCount.
[[nodiscard]] uint32_t normalBinOf(const Vec3d& normal);

/// Normal-space seeds (Rusinkiewicz and Levoy, "Efficient variants of the ICP algorithm", 2001; the ASDF paper's future
/// work): as many from each bin of normals, existing ones counted, as long as the bin has candidates; random within a
/// bin. Not uniform on the surface, and worse for interpolating than a random choice.
/// existing: faces already chosen, in any order. Exactly `count` seeds or all candidates that are left, ascending.
[[nodiscard]] std::vector<uint32_t> normalSpaceSeeds(const SeedDomain& domain, uint64_t count,
                                                     std::span<const uint32_t> existing, uint64_t randomSeed);

}  // namespace asdfvk
