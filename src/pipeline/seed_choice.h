#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "mesh/arc_angles.h"
#include "mesh/face_domain.h"
#include "seeds/samplers.h"
#include "trace/seeds.h"

namespace asdfvk {

/// Number of seeds of the first round among the faces that can cast rays; at least one if there is such a face. Throws
/// Error{OptionOutOfRange}.
[[nodiscard]] uint64_t resolveSeedCount(const Options& options, uint64_t traceableFaceCount);

/// The seeds of the sampler, and held-out faces. Held-out faces are sampled at random among the other faces: at these,
/// the error of an interpolation without them is measured without bias. Nodes of a domain.
struct SeedChoice {
  std::vector<uint32_t> sampled, heldOut;  ///< Ascending and disjoint.
};

/// Numbers of further seeds of each kind, for a computation that estimates the error.
struct SeedShares {
  uint64_t sampled = 0, heldOut = 0;
  uint64_t extreme = 0;  ///< See extremeSeeds().
};

/// earlierHeldOutCount: number of held-out faces of earlier rounds. predicts: whether a prediction will be available
/// for extreme seeds.
[[nodiscard]] SeedShares shareSeeds(uint64_t count, uint64_t earlierHeldOutCount, bool predicts);

/// Selects further seeds: by the sampler, and held-out faces with equal probability among the other faces. The number
/// of held-out faces is 0 if a prediction is available (see sampleHeldOut()). earlier: all earlier seeds. density: #N,
/// for the second half of the seeds of an adaptive sampler (Sampler::refine); otherwise empty. Throws Error{Cancelled}.
[[nodiscard]] SeedChoice chooseSeeds(const FaceDomain& domain, ArcAngles& arcAngles, const Options& options,
                                     const SeedShares& shares, const Seeds& earlier,
                                     std::span<const double> density = {}, const RunControl& stopOnly = {});

/// The `count` candidates with the greatest predictions that are not seeds yet, ascending. Samplers often miss the few
/// faces with the maximum of the function, and errors are relative to its range. prediction, isSeed: #N.
[[nodiscard]] std::vector<uint32_t> extremeSeeds(std::span<const uint32_t> traceable,
                                                 std::span<const double> prediction, std::span<const uint8_t> isSeed,
                                                 uint64_t count);

}  // namespace asdfvk
