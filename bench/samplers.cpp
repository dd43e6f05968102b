// How long do the samplers take, and how evenly are their seeds distributed? The time of each sampler over that of the
// random permutation, the distance of each seed to the nearest other seed, and of each face to the nearest seed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "asdf_vk/files.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "generate/shapes.h"
#include "seeds/samplers.h"
#include "seeds/surface_distances.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

/// Distances in one metric. The only seed of a component has no nearest other seed and is skipped.
struct Evenness {
  double nearestMin = 0, nearestMean = 0, nearestDeviation = 0;  ///< From a seed to the nearest other seed.
  double coverRms = 0, coverMax = 0;                             ///< From a face to the nearest seed.
};

Evenness evennessOf(const DualGraph& graph, std::span<const float> lengths, const std::vector<uint32_t>& seeds) {
  std::vector<uint8_t> isSeed(graph.faceCount(), 0);
  for (uint32_t face : seeds) isSeed[face] = 1;
  constexpr size_t kSampleCount = 20'000;
  std::vector<double> nearest;
  SurfaceBall ball(graph, lengths);
  for (size_t i = 0; i < std::min(kSampleCount, seeds.size()); ++i) {
    ball.startAt(seeds[i * seeds.size() / std::min(kSampleCount, seeds.size())]);
    SurfaceBall::Member member;
    bool isFirst = true;
    while (ball.next(member) && (isFirst || !isSeed[member.face])) isFirst = false;
    if (isSeed[member.face] && member.distance > 0) nearest.push_back(member.distance);
  }
  Evenness evenness;
  if (!nearest.empty()) {
    const double count = static_cast<double>(nearest.size());
    evenness.nearestMin = *std::min_element(nearest.begin(), nearest.end());
    evenness.nearestMean = std::accumulate(nearest.begin(), nearest.end(), 0.0) / count;
    double squares = 0;
    for (double distance : nearest) squares += std::pow(distance - evenness.nearestMean, 2);
    evenness.nearestDeviation = std::sqrt(squares / count);
  }
  SurfaceDistances distances(graph, lengths);
  distances.add(seeds, SurfaceDistances::kUnreached);
  double squares = 0, reached = 0;
  for (uint32_t face = 0; face < graph.faceCount(); ++face) {
    if (distances.at(face) == SurfaceDistances::kUnreached) continue;
    squares += std::pow(double{distances.at(face)}, 2);
    evenness.coverMax = std::max(evenness.coverMax, double{distances.at(face)});
    ++reached;
  }
  evenness.coverRms = reached > 0 ? std::sqrt(squares / reached) : 0;
  return evenness;
}

void measure(const std::string& name, const Mesh& mesh, double percent, uint32_t roundCount) {
  const DualGraph graph = buildDualGraph(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<uint32_t> candidates;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (!geometry.isDegenerate(face)) candidates.push_back(face);
  const SeedDomain domain{graph, geometry, candidates};
  const auto count = static_cast<uint64_t>(percent / 100 * static_cast<double>(candidates.size()));
  std::string text = fmt::format(
      "{}: {} faces, {} seeds; distances in the metric of the samplers, and in hops where stated\n\n"
      "| sampler | ms | / random | to nearest other seed: min | mean | deviation | in hops: min | mean "
      "| face to nearest seed: rms | max |\n"
      "|---------|---:|---------:|---------------------------:|-----:|----------:|-------------:|-----:"
      "|--------------------------:|----:|\n",
      name, groupDigits(mesh.faceCount()), groupDigits(count));
  const std::vector<float> lengths = arcLengths(graph, geometry), hops(lengths.size(), 1.0f);
  std::vector<double> randomMilliseconds;
  for (const Sampler& sampler : kSamplers) {
    if (sampler.refine != nullptr) continue;  // Needs error indicators.
    std::vector<double> milliseconds;
    std::vector<uint32_t> seeds;
    for (uint32_t round = 0; round < roundCount; ++round) {
      const Stopwatch watch;
      seeds = sampler.sample(domain, count, {}, round + 1);
      milliseconds.push_back(1e3 * watch.seconds());
    }
    if (sampler.name == std::string_view("random")) randomMilliseconds = milliseconds;
    const Evenness evenness = evennessOf(graph, lengths, seeds), inHops = evennessOf(graph, hops, seeds);
    text += fmt::format("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} | {:.1f} |\n",
                        sampler.name, toText(dispersionOf(milliseconds), 1),
                        dispersionOf(milliseconds).median / dispersionOf(randomMilliseconds).median,
                        evenness.nearestMin, evenness.nearestMean, evenness.nearestDeviation, inHops.nearestMin,
                        inHops.nearestMean, evenness.coverRms, evenness.coverMax);
  }
  writeOutput(text + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-samplers", "Time and evenness of the seed samplers.");
  std::vector<std::string> meshes;
  uint64_t faceCount = 200'000;
  double percent = 10;
  uint32_t roundCount = 3;
  program.addOptionalMeshes(meshes, "a generated animal");
  program.add("--faces", faceCount, "Faces of the generated animal");
  program.add("--seeds", percent, "Share of the faces that become seeds, in percent", {0, 100});
  program.add("--runs", roundCount, "Random seeds; the time is the median over them", {1, 1000});
  return program.run(argc, argv, [&](const RunControl&) {
    if (meshes.empty()) measure("generated animal", generateShape("animal", faceCount).mesh, percent, roundCount);
    for (const std::string& mesh : meshes) measure(mesh, readMesh(mesh), percent, roundCount);
  });
}
