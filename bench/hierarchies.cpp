// How long the hierarchy and its layouts take beside Embree's scene, turn by turn in one run, and how good they are:
// cost by the surface-area heuristic, and what the rays of cones meet.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <thread>

#include "bare_embree.h"
#include "bench_program.h"
#include "bvh/bvh_statistics.h"
#include "bvh/device_bvh.h"
#include "cli/terminal.h"
#include "io/mesh_reader.h"
#include "machine.h"
#include "pipeline/prepared_mesh.h"
#include "seeds/samplers.h"
#include "spread.h"
#include "trace/seed_order.h"
#include "walk_counts.h"
#include "work_watch.h"

namespace {

using namespace asdfvk;

struct Arguments {
  std::vector<std::string> meshes;
  uint32_t roundCount = 9;
  uint32_t threadCount = std::max(1u, std::thread::hardware_concurrency());
  size_t walkedSeedCount = 4000;
};

struct Timed {
  std::string name;
  std::function<void()> run;
  std::vector<double> seconds, overEmbree;
};

std::string timesText(const TraceScene& scene, const Cone& cone, const Arguments& arguments) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, arguments.threadCount);
  std::vector<Timed> rows;
  const auto build = [&] { return buildBvh(scene.mesh, scene.geometry, scene.representatives); };
  const auto encode = [&](const Bvh& bvh, BvhLayout layout) {
    static_cast<void>(encodeDeviceBvh(bvh, scene.mesh, scene.geometry, layout));
  };
  rows.push_back({"build", [&] { static_cast<void>(build()); }, {}, {}});
  rows.push_back({"binary layout", [&] { encode(scene.bvh, BvhLayout::Binary); }, {}, {}});
  rows.push_back({"wide layout", [&] { encode(scene.bvh, BvhLayout::Wide); }, {}, {}});
  rows.push_back({"build and wide layout", [&] { encode(build(), BvhLayout::Wide); }, {}, {}});
  // Embree, too, is given the mesh as it is, and for comparison in the order that our hierarchy has brought it into.
  const std::vector<uint32_t>& inOrder = scene.bvh.slotFaces;
  std::vector<uint32_t> inFileOrder = inOrder;
  std::sort(inFileOrder.begin(), inFileOrder.end());
  const auto commit = [&](const std::vector<uint32_t>& faces) {
    return bench::makeBareEmbree(scene, faces, cone, bench::BareMode::Fastest) != nullptr;
  };
  const bool hasEmbree = commit(inOrder);
  if (hasEmbree) {
    rows.push_back({"Embree's scene, in order", [&] { static_cast<void>(commit(inOrder)); }, {}, {}});
    rows.push_back({"Embree's scene", [&] { static_cast<void>(commit(inFileOrder)); }, {}, {}});
  }
  const bench::Workers workers = arguments.threadCount == 1 ? bench::Workers::Processors : bench::Workers::Others;
  for (uint32_t round = 0; round <= arguments.roundCount; ++round) {
    for (Timed& row : rows) {
      const bench::WorkWatch watch(workers);
      row.run();
      const double seconds = watch.seconds();
      if (round > 0) row.seconds.push_back(seconds);
    }
    if (round == 0 || !hasEmbree) continue;
    for (Timed& row : rows) row.overEmbree.push_back(row.seconds.back() / rows.back().seconds.back());
  }
  std::string text = fmt::format("\n| {:24} | {:>12} | {:>14} |\n|:---|---:|---:|\n",
                                 "on " + std::to_string(arguments.threadCount) + " thread(s)", "ms", "/ Embree");
  for (Timed& row : rows) {
    for (double& s : row.seconds) s *= 1e3;
    text += fmt::format("| {:24} | {:>12} | {:>14} |\n", row.name, bench::toText(bench::spreadOf(row.seconds), 1),
                        hasEmbree ? bench::toText(bench::spreadOf(row.overEmbree), 2) : "-");
  }
  return text;
}

// Groups of neighbours, evenly taken.
std::vector<uint32_t> someGroups(const std::vector<uint32_t>& seeds, size_t seedCount) {
  const size_t groupCount = std::min(seedCount, seeds.size()) / bench::kNeighbourCount;
  std::vector<uint32_t> some;
  for (size_t group = 0; group < groupCount; ++group) {
    const auto begin =
        seeds.begin() + static_cast<std::ptrdiff_t>((seeds.size() - bench::kNeighbourCount) * group / groupCount);
    some.insert(some.end(), begin, begin + bench::kNeighbourCount);
  }
  return some;
}

std::string walksText(const TraceScene& scene, const Cone& cone, const std::vector<uint32_t>& castable,
                      const Arguments& arguments) {
  std::string text = fmt::format(
      "\n| {:6} | {:>5} | {:>7} | {:>9} | {:>7} | {:>9} | {:>7} | {:>9} |\n|:---|---:|---:|---:|---:|---:|---:|---:|\n",
      "layout", "seeds", "nodes", "MB", "nodes / ray", "triangles / ray", "nodes in step", "triangles in step");
  for (const BvhLayout layout : {BvhLayout::Binary, BvhLayout::Wide}) {
    const DeviceBvh bvh = encodeDeviceBvh(scene.bvh, scene.mesh, scene.geometry, layout);
    for (const uint32_t percent : {100u, 10u}) {
      const std::vector<uint32_t> chosen = randomPermutationSeeds(castable, castable.size() * percent / 100, 1);
      std::vector<uint32_t> seeds;
      for (const uint32_t i : SeedOrder(scene).of(chosen)) seeds.push_back(chosen[i]);
      const bench::WalkCounts counts =
          bench::countWalks(bvh, scene, cone, someGroups(seeds, arguments.walkedSeedCount));
      text += fmt::format("| {:6} | {:>3} % | {:>7} | {:>9.2f} | {:>7.2f} | {:>9.2f} | {:>7.2f} | {:>9.2f} |\n",
                          layout == BvhLayout::Binary ? "binary" : "wide", percent,
                          bvh.nodes.size() + bvh.wideNodes.size(), bvh.nodeBytes().size() * 1e-6, counts.nodes,
                          counts.triangles, counts.sharedNodes, counts.sharedTriangles);
    }
  }
  return text;
}

void measure(const std::string& path, const Arguments& arguments) {
  Mesh mesh = readMesh(path);
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  const Cone cone = makeCone({});
  const BvhStatistics statistics = computeBvhStatistics(bvh);
  writeStandardOutput(fmt::format("\n{}: {} faces on {}\nSAH cost {:.2f}, {} nodes, {} leaves, depth {}\n", path,
                                  mesh.faceCount(), bench::toText(bench::thisMachine()), statistics.sahCost,
                                  statistics.nodeCount, statistics.leafCount, statistics.depth));
  if (arguments.walkedSeedCount > 0) writeStandardOutput(walksText(scene, cone, prepared.castableFaces, arguments));
  if (arguments.roundCount > 0) writeStandardOutput(timesText(scene, cone, arguments));
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-hierarchies",
                              "Times the hierarchy beside Embree's, and counts what rays meet in it.");
  Arguments arguments;
  program.addMeshes(arguments.meshes);
  program.add("--rounds", arguments.roundCount, "Counted rounds, after one that warms up; 0: none");
  program.add("--threads", arguments.threadCount, "Threads", {1, 1000});
  program.add("--walks", arguments.walkedSeedCount, "Seeds whose rays are counted; 0: none");
  return program.run(argc, argv, [&](const RunControl&) {
    for (const std::string& mesh : arguments.meshes) measure(mesh, arguments);
  });
}
