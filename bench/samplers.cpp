// Time and evenness of the samplers: the time over that of the random sampler, the distance of each seed to the nearest
// other seed, and of each face to the nearest seed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench_program.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "generate/shapes.h"
#include "io/mesh_reader.h"
#include "seeds/samplers.h"
#include "seeds/surface_distances.h"
#include "spread.h"

namespace {

using namespace asdfvk;

/// For one set of arc lengths. Excludes seeds that are the only one of their component.
struct Evenness {
  double nearestMin = 0, nearestMean = 0, nearestDeviation = 0;  ///< From a seed to the nearest other.
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

void compare(const std::string& name, const Mesh& mesh, double percent, uint32_t roundCount) {
  const DualGraph graph = buildDualGraph(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<uint32_t> candidates;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (!geometry.isDegenerate(face)) candidates.push_back(face);
  const SeedDomain domain{graph, geometry, candidates};
  const auto count = static_cast<uint64_t>(percent / 100 * static_cast<double>(candidates.size()));
  std::string text = fmt::format(
      "{}: {} faces, {} seeds; distances along arcs and, for the nearest seed, in hops\n\n"
      "| sampler | ms | of random | nearest other seed: least | mean | deviation | in hops: least | mean "
      "| face to its seed: rms | max |\n"
      "|---------|---:|----------:|--------------------------:|-----:|----------:|---------------:|-----:"
      "|----------------------:|----:|\n",
      name, groupDigits(mesh.faceCount()), groupDigits(count));
  const std::vector<float> lengths = arcLengths(graph, geometry);
  const std::vector<float> hops(lengths.size(), 1.0f);
  double randomMedian = 0;  // Of the first sampler.
  for (const Sampler& sampler : kSamplers) {
    if (sampler.refine) continue;  // Its first pass is another sampler.
    std::vector<double> milliseconds;
    std::vector<uint32_t> seeds;
    for (uint32_t round = 0; round < roundCount; ++round) {
      const Stopwatch watch;
      seeds = sampler.sample(domain, count, {}, round + 1);
      milliseconds.push_back(1e3 * watch.seconds());
    }
    const bench::Spread time = bench::spreadOf(milliseconds);
    if (randomMedian == 0) randomMedian = time.median;
    const Evenness inLengths = evennessOf(graph, lengths, seeds), inHops = evennessOf(graph, hops, seeds);
    text += fmt::format("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} | {:.1f} |\n",
                        sampler.name, toText(time, 1), time.median / randomMedian, inLengths.nearestMin,
                        inLengths.nearestMean, inLengths.nearestDeviation, inHops.nearestMin, inHops.nearestMean,
                        inLengths.coverRms, inLengths.coverMax);
  }
  writeStandardOutput(text + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-samplers", "Time and evenness of the seed samplers.");
  std::vector<std::string> meshes;
  uint64_t faceCount = 200'000;
  double percent = 10;
  uint32_t roundCount = 3;
  program.addMeshesOr(meshes, "an animal is generated");
  program.add("--faces", faceCount, "Faces of the generated animal");
  program.add("--seeds", percent, "Share of the faces that become seeds, in percent", {0, 100});
  program.add("--runs", roundCount, "Random seeds; the time is their median", {1, 1000});
  return program.run(argc, argv, [&](const RunControl&) {
    if (meshes.empty()) compare("generated animal", generateShape("animal", faceCount).mesh, percent, roundCount);
    for (const std::string& mesh : meshes) compare(mesh, readMesh(mesh), percent, roundCount);
  });
}
