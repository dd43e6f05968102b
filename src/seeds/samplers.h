#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "mesh/arc_angles.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

/// Samplers: selection of seeds, the faces that cast rays. A new sampler requires a file with its function. This header
/// needs the declaration of the function and a row of kSamplers; SamplerChoice and kSamplerNames name the sampler.
namespace asdfvk {

/// The faces to select from. The members must outlive this object.
struct SeedDomain {
  const DualGraph& graph;
  const FaceGeometry& geometry;
  ArcAngles& arcAngles;
  std::span<const uint32_t> candidates;  ///< Faces that can cast rays, ascending, each once.
  RunControl stopOnly = {};              ///< Ends samplers that measure distances, by Error{Cancelled}.
};

/// The candidates that are not in `existing` (any order), ascending. Throws CheckFailure for an existing face that is
/// not in the graph.
[[nodiscard]] std::vector<uint32_t> remainingCandidates(const SeedDomain& domain, std::span<const uint32_t> existing);

/// Selects exactly `count` of the candidates that are not in `existing`, or all of them if there are fewer. existing:
/// faces selected before, in any order. Returns the new seeds, ascending. The result depends on the input and
/// randomSeed only, not on the number of threads. A connected component may remain without a seed.
using SampleSeeds = std::vector<uint32_t>(const SeedDomain& domain, uint64_t count, std::span<const uint32_t> existing,
                                          uint64_t randomSeed);

/// Like SampleSeeds, with more seeds where the density is higher. density: #F, positive and finite, in any unit.
using SampleSeedsByDensity = std::vector<uint32_t>(const SeedDomain& domain, std::span<const double> density,
                                                   uint64_t count, std::span<const uint32_t> existing,
                                                   uint64_t randomSeed);

/// ASDF paper, section 4.2: every n-th face of a random permutation of the candidates. In the paper n is an integer;
/// here seed i is entry floor(i * size / count) of the permutation, so that every count is possible.
[[nodiscard]] SampleSeeds randomSeeds;

/// Poisson-disk sampling of the dual graph in the distances of arcLengths(), see throwDarts(). The radius of
/// the disks decreases from 1.25 times an estimate of the radius that gives `count` seeds.
///
/// There is a radius r with two properties. No new seed is nearer than r to another seed. In each component that has a
/// seed, every candidate is within (1 + 1/64) r of a seed. Therefore the covering radius is at most 2 (1 + 1/64) times
/// the smallest possible one for this number of seeds (Gonzalez, see farthestPointSeeds()).
[[nodiscard]] SampleSeeds blueNoiseSeeds;

/// Blue noise with arcs stretched by the square root of the density, so that the spacing is proportional to
/// density^-1/2. On smooth meshes, if at most a tenth of the faces are seeds, the number of seeds per face is
/// proportional to the density within 10 to 20 %. With more seeds, all faces of the dense parts are seeds.
[[nodiscard]] SampleSeedsByDensity weightedBlueNoiseSeeds;

/// Farthest-point sampling (Gonzalez, "Clustering to minimize the maximum intercluster distance", 1985) in the
/// distances of arcLengths(). Within a tolerance of 1/64, each seed is the candidate that is farthest from all earlier
/// seeds. The tolerance allows a search in constant time (see throwDarts()). The covering radius is at most 2 (1 +
/// 1/64) times the smallest possible one. A component without a seed is infinitely far away. The first seed and the
/// choice between equal distances are random. Takes about log(count) times as long as blue noise.
[[nodiscard]] SampleSeeds farthestPointSeeds;

/// Normal-space sampling (Rusinkiewicz and Levoy, "Efficient variants of the ICP algorithm", 2001; future work of the
/// ASDF paper). Bins of normals with enough candidates have the same number of seeds, existing seeds included. The
/// choice within a bin is random. Interpolation from these seeds has larger errors than from a random selection.
[[nodiscard]] SampleSeeds normalSpaceSeeds;

struct Sampler {
  SamplerChoice choice;
  SampleSeeds* sample;
  /// Null except for adaptive samplers. In an adaptive sampler, `sample` selects half of the seeds and `refine` selects
  /// the other half. The second half is denser where the prediction from the first half has a large error indicator.
  SampleSeedsByDensity* refine = nullptr;
  /// Whether all sets of candidates are equally likely. If true, any of the seeds can be held out without bias.
  bool isUniform = false;
};

inline constexpr auto kSamplers = std::to_array<Sampler>({
    {.choice = SamplerChoice::Random, .sample = randomSeeds, .isUniform = true},
    {.choice = SamplerChoice::BlueNoise, .sample = blueNoiseSeeds},
    {.choice = SamplerChoice::FarthestPoint, .sample = farthestPointSeeds},
    {.choice = SamplerChoice::NormalSpace, .sample = normalSpaceSeeds},
    {.choice = SamplerChoice::Adaptive, .sample = blueNoiseSeeds, .refine = weightedBlueNoiseSeeds},
});

[[nodiscard]] const Sampler& samplerOf(SamplerChoice choice);

}  // namespace asdfvk
