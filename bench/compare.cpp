// Compares the speed of the backends with Embree and CGAL. All compute the same mesh and rays, in turns.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "baselines.h"
#include "comparison.h"
#include "core/text.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

Dispersion megaRaysPerSecond(uint64_t rayCount, const Seconds& seconds) {
  std::vector<double> rates;
  for (const double s : seconds) rates.push_back(static_cast<double>(rayCount) / s / 1e6);
  return dispersionOf(std::move(rates));
}

std::string cgalLine(const Comparison& comparison) {
  if (!hasCgal()) return "CGAL: this build has no CGAL; scripts/install-packages bench installs CGAL\n";
  if (comparison.cgal.empty()) return "CGAL: no runs requested, or the mesh is not an orientable 2-manifold\n";
  return fmt::format("CGAL sdf_values, every face, one thread, {} runs: {} s\n", comparison.cgal.size(),
                     toText(dispersionOf(comparison.cgal), 2));
}

std::string toTable(const Comparison& comparison, const Machine& machine) {
  std::string text = fmt::format("{}: {} faces, {} rounds on {}\n", comparison.mesh, groupDigits(comparison.faceCount),
                                 comparison.roundCount, toText(machine));
  for (const auto& [name, device] : comparison.devices) text += fmt::format("{}: {}\n", name, device);
  text += fmt::format(
      "median ± median absolute deviation\n\n"
      "| seeds | tracer         |      Mrays/s | / {} |\n"
      "|-------|----------------|-------------:|---------------:|\n",
      kEmbreeFast.name);
  for (const SeedComparison& seeds : comparison.seeds)
    for (const auto& [name, seconds] : seeds.trace)
      text +=
          fmt::format("| {:<5} | {:<14} | {:>12} | {:>14} |\n", seeds.seeds, name,
                      toText(megaRaysPerSecond(seeds.rayCount, seconds), 3), toText(seeds.speedOverEmbree(name), 3));
  text +=
      "\n| seeds | backend | task                     |       seconds |  CGAL / this |\n"
      "|-------|---------|--------------------------|--------------:|-------------:|\n";
  for (const SeedComparison& seeds : comparison.seeds)
    for (const auto& [key, seconds] : seeds.total)
      text += fmt::format("| {:<5} | {:<7} | {:<24} | {:>13} | {:>12} |\n", seeds.seeds, key.first, key.second,
                          toText(dispersionOf(seconds), 3), toText(comparison.cgalOver(seconds), 1));
  return text + "\n" + cgalLine(comparison) + "\n";
}

std::string toJsonLine(const Comparison& comparison, const Machine& machine) {
  Json json{{"mesh", comparison.mesh},      {"faceCount", comparison.faceCount},  {"processor", machine.processor},
            {"threads", machine.threads},   {"loadAverage", machine.loadAverage}, {"rounds", comparison.roundCount},
            {"devices", comparison.devices}};
  for (const SeedComparison& seeds : comparison.seeds) {
    Json entry{{"seeds", seeds.seeds}, {"rayCount", seeds.rayCount}};
    for (const auto& [name, seconds] : seeds.trace)
      entry["tracers"][name] = {{"traceSeconds", toJson(dispersionOf(seconds))},
                                {"raysOverBareEmbree", toJson(seeds.speedOverEmbree(name))}};
    for (const auto& [key, seconds] : seeds.total)
      entry["whole"].push_back({{"backend", key.first},
                                {"what", key.second},
                                {"seconds", toJson(dispersionOf(seconds))},
                                {"cgalOver", toJson(comparison.cgalOver(seconds))}});
    json["seeds"].push_back(std::move(entry));
  }
  json["cgalSeconds"] = comparison.cgal.empty() ? Json(nullptr) : toJson(dispersionOf(comparison.cgal));
  return oneLine(json);
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-compare", "Compares the backends with Embree and CGAL, in turns.");
  std::vector<std::string> meshes;
  ComparisonRequest request;
  bool isJson = false;
  program.addMeshes(meshes);
  program.add("--runs", request.roundCount, "Rounds, after one for warm-up", {1, 1000});
  program.add("--cgal-runs", request.cgalRunCount, "Runs of CGAL, which is slow; at most one per round; 0: none");
  program.add("--seeds", request.seeds, "Shares, counts or all");
  program.add("--device", request.device, "Vulkan device: index or part of its name");
  program.add("--json", isJson, "One JSON line per mesh instead of tables");
  return program.run(argc, argv, [&](const RunControl& control) {
    for (const std::string& mesh : meshes) {
      const Comparison comparison = compare(mesh, request, control);
      writeOutput(isJson ? toJsonLine(comparison, thisMachine()) : toTable(comparison, thisMachine()));
    }
  });
}
