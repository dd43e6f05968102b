// How long do the construction of the hierarchy and its device layouts take compared with Embree's scene, in turns? How
// good are the hierarchies: their cost by the surface-area heuristic, and the nodes and triangles that rays visit.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <thread>

#include "asdf_vk/files.h"
#include "baselines.h"
#include "bvh/device_bvh.h"
#include "seeds/samplers.h"
#include "support/bvh_statistics.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"
#include "trace/seed_order.h"
#include "walk_counts.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes;
  uint32_t roundCount = 9;
  uint32_t threadCount = std::max(1u, std::thread::hardware_concurrency());
  uint64_t walkedSeedCount = 4000;
};

struct Row {
  std::string name;
  std::function<void()> run;
  std::vector<double> milliseconds = {};
};

/// The tasks to time; with Embree, its scene is the last one.
std::vector<Row> makeRows(const TraceScene& scene, const Cone& cone) {
  const auto build = [=] { return buildBvh(scene.mesh, scene.geometry, scene.representatives); };
  const auto encode = [=](const Bvh& bvh, BvhLayout layout) {
    static_cast<void>(encodeDeviceBvh(bvh, scene.mesh, scene.geometry, layout));
  };
  std::vector<Row> rows{{"build", [=] { static_cast<void>(build()); }},
                        {"binary layout", [=] { encode(scene.bvh, BvhLayout::Binary); }},
                        {"wide layout", [=] { encode(scene.bvh, BvhLayout::Wide); }},
                        {"build and wide layout", [=] { encode(build(), BvhLayout::Wide); }}};
  // Embree receives the faces in file order, as our builder does, and in the order of our hierarchy for comparison.
  const std::vector<uint32_t>& hierarchyOrder = scene.bvh.primitiveFaces;
  std::vector<uint32_t> fileOrder = hierarchyOrder;
  std::sort(fileOrder.begin(), fileOrder.end());
  const auto commit = [=, &cone](const std::vector<uint32_t>& faces) {
    return makeEmbreeBaseline(scene, faces, cone, EmbreeMode::Fast) != nullptr;
  };
  if (commit(hierarchyOrder)) {
    rows.push_back({"Embree, hierarchy order", [=, &hierarchyOrder] { static_cast<void>(commit(hierarchyOrder)); }});
    rows.push_back({"Embree, file order", [=] { static_cast<void>(commit(fileOrder)); }});
  }
  return rows;
}

std::string timesText(const TraceScene& scene, const Cone& cone, const Arguments& arguments) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, arguments.threadCount);
  std::vector<Row> rows = makeRows(scene, cone);
  const Clock clock = arguments.threadCount == 1 ? Clock::ProcessCpu : Clock::Wall;
  for (uint32_t round = 0; round <= arguments.roundCount; ++round)
    for (Row& row : rows) {
      const Timer timer(clock);
      row.run();
      if (round > 0) row.milliseconds.push_back(timer.seconds() * 1e3);  // Round 0 is the warm-up.
    }
  std::string text = fmt::format("\n| {:24} | {:>12} | {:>14} |\n|:---|---:|---:|\n",
                                 fmt::format("{} thread(s)", arguments.threadCount), "ms", "/ Embree");
  const bool hasEmbree = rows.back().name.starts_with("Embree");
  for (const Row& row : rows)
    text += fmt::format("| {:24} | {:>12} | {:>14} |\n", row.name, toText(dispersionOf(row.milliseconds), 1),
                        hasEmbree ? toText(ratioOf(row.milliseconds, rows.back().milliseconds), 2) : "-");
  return text;
}

/// About `seedCount` of the seeds: groups of kNeighbourCount consecutive ones, evenly distributed.
std::vector<uint32_t> selectGroups(const std::vector<uint32_t>& seeds, uint64_t seedCount) {
  const size_t groupCount = std::min<size_t>(seedCount, seeds.size()) / kNeighbourCount;
  std::vector<uint32_t> selected;
  for (size_t group = 0; group < groupCount; ++group) {
    const auto begin =
        seeds.begin() + static_cast<std::ptrdiff_t>((seeds.size() - kNeighbourCount) * group / groupCount);
    selected.insert(selected.end(), begin, begin + kNeighbourCount);
  }
  return selected;
}

std::string walksText(const TraceScene& scene, const Cone& cone, const std::vector<uint32_t>& traceable,
                      const Arguments& arguments) {
  std::string text =
      "\nper ray; shared: per step of a subgroup\n"
      "| layout | seeds | nodes   |        MB | nodes   | triangles | shared nodes | shared triangles |\n"
      "|:---|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const BvhLayout layout : {BvhLayout::Binary, BvhLayout::Wide}) {
    const DeviceBvh bvh = encodeDeviceBvh(scene.bvh, scene.mesh, scene.geometry, layout);
    for (const uint32_t percent : {100u, 10u}) {
      const std::vector<uint32_t> chosen = randomPermutationSeeds(traceable, traceable.size() * percent / 100, 1);
      std::vector<uint32_t> seeds;
      for (const uint32_t i : SeedOrder(scene).of(chosen)) seeds.push_back(chosen[i]);
      const WalkCounts counts = countWalks(bvh, scene, cone, selectGroups(seeds, arguments.walkedSeedCount));
      text += fmt::format("| {:6} | {:>3} % | {:>7} | {:>9.2f} | {:>7.2f} | {:>9.2f} | {:>12.2f} | {:>16.2f} |\n",
                          layout == BvhLayout::Binary ? "binary" : "wide", percent,
                          bvh.nodes.size() + bvh.wideNodes.size(), bvh.nodeBytes().size() * 1e-6, counts.nodes,
                          counts.triangles, counts.sharedNodes, counts.sharedTriangles);
    }
  }
  return text;
}

void measure(const std::string& path, const Arguments& arguments) {
  const TraceableMesh mesh(readMesh(path));
  const Cone cone = makeCone({});
  const BvhStatistics statistics = computeBvhStatistics(mesh.bvh);
  writeOutput(fmt::format("\n{}: {} faces on {}\nSAH cost {:.2f}, {} nodes, {} leaves, depth {}\n", path,
                          mesh.mesh.faceCount(), toText(thisMachine()), statistics.sahCost, statistics.nodeCount,
                          statistics.leafCount, statistics.depth));
  if (arguments.walkedSeedCount > 0)
    writeOutput(walksText(mesh.scene(), cone, mesh.prepared.traceableFaces, arguments));
  if (arguments.roundCount > 0) writeOutput(timesText(mesh.scene(), cone, arguments));
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-hierarchies",
                  "Times the hierarchy and Embree's, and counts the nodes and triangles that rays visit.");
  Arguments arguments;
  program.addMeshes(arguments.meshes);
  program.add("--rounds", arguments.roundCount, "Rounds, after one for warm-up; 0: no times");
  program.add("--threads", arguments.threadCount, "Threads", {1, 1000});
  program.add("--walks", arguments.walkedSeedCount, "Seeds whose rays are counted; 0: none");
  return program.run(argc, argv, [&](const RunControl&) {
    for (const std::string& mesh : arguments.meshes) measure(mesh, arguments);
  });
}
