#include "comparison_report.h"
#include "core/text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cgal_sdf.h"
#include "cli/report_text.h"

namespace asdfvk::bench {
namespace {

using Json = nlohmann::ordered_json;

Spread megaRaysPerSecond(uint64_t rayCount, const Seconds& seconds) {
  std::vector<double> rates;
  for (const double s : seconds) rates.push_back(static_cast<double>(rayCount) / s / 1e6);
  return spreadOf(std::move(rates));
}

/// How much faster than bare Embree at the same rays: its time over that of `name`. None without Embree.
std::optional<Spread> rateOverBareEmbree(const SeedComparison& seeds, const std::string& name) {
  const auto bare = seeds.trace.find(kBareEmbree);
  if (bare == seeds.trace.end()) return {};
  return ratioOf(bare->second, seeds.trace.at(name));
}

std::string cell(const std::optional<Spread>& spread, int decimals) {
  return spread ? toText(*spread, decimals) : std::string("-");
}

std::string traceRow(const std::string& seeds, const std::string& tracer, const std::string& rate,
                     const std::string& overBare) {
  return fmt::format("| {:<5} | {:<13} | {:>12} | {:>13} |\n", seeds, tracer, rate, overBare);
}

std::string wholeRow(const std::string& seeds, const std::string& backend, const std::string& what,
                     const std::string& seconds, const std::string& overCgal) {
  return fmt::format("| {:<5} | {:<7} | {:<24} | {:>13} | {:>12} |\n", seeds, backend, what, seconds, overCgal);
}

std::string cgalLine(const Comparison& comparison) {
  if (!comparison.cgal.empty())
    return fmt::format("CGAL sdf_values, every face, one thread as it is, {} among the rounds: {} s\n",
                       comparison.cgal.size() == 1 ? "once" : fmt::format("{} times", comparison.cgal.size()),
                       toText(spreadOf(comparison.cgal), 2));
  return hasCgal() ? "CGAL: not asked, or the mesh is none that it takes\n"
                   : "CGAL: not built in; scripts/install-packages bench installs it\n";
}

Json jsonOf(const Spread& spread) {
  return {{"median", spread.median}, {"deviation", spread.deviation}, {"min", spread.min}, {"max", spread.max}};
}

Json jsonOf(const std::optional<Spread>& spread) { return spread ? jsonOf(*spread) : Json(nullptr); }

Json jsonOf(const Comparison& comparison, const SeedComparison& seeds) {
  Json json{{"seeds", seeds.seeds}, {"rayCount", seeds.rayCount}};
  for (const auto& [name, times] : seeds.trace) {
    Json& entry = json["tracers"][name];
    entry["traceSeconds"] = jsonOf(spreadOf(times));
    entry["raysOverBareEmbree"] = jsonOf(rateOverBareEmbree(seeds, name));
  }
  for (const auto& [key, times] : seeds.whole) {
    const auto& [backend, what] = key;
    json["whole"].push_back({{"backend", backend},
                             {"what", what},
                             {"seconds", jsonOf(spreadOf(times))},
                             {"cgalOver", jsonOf(cgalOver(comparison, times))}});
  }
  return json;
}

}  // namespace

std::string comparisonTable(const Comparison& comparison, const Machine& machine) {
  std::string text = fmt::format("{}: {} faces, {} rounds on {}\n", comparison.mesh, groupDigits(comparison.faceCount),
                                 comparison.roundCount, toText(machine));
  for (const auto& [name, device] : comparison.devices) text += fmt::format("{}: {}\n", name, device);
  text += "median ± median absolute deviation\n\n";
  text += traceRow("seeds", "tracer", "Mrays/s", "/ bare Embree");
  text += "|-------|---------------|-------------:|--------------:|\n";
  for (const SeedComparison& seeds : comparison.seeds)
    for (const auto& [name, times] : seeds.trace)
      text += traceRow(seeds.seeds, name, toText(megaRaysPerSecond(seeds.rayCount, times), 3),
                       cell(rateOverBareEmbree(seeds, name), 3));
  text += "\n";
  text += wholeRow("seeds", "backend", "what", "s", "CGAL / it");
  text += "|-------|---------|--------------------------|--------------:|-------------:|\n";
  for (const SeedComparison& seeds : comparison.seeds)
    for (const auto& [key, times] : seeds.whole)
      text += wholeRow(seeds.seeds, key.first, key.second, toText(spreadOf(times), 3),
                       cell(cgalOver(comparison, times), 1));
  return text + "\n" + cgalLine(comparison) + "\n";
}

std::string comparisonJson(const Comparison& comparison, const Machine& machine) {
  Json json{{"mesh", comparison.mesh},      {"faceCount", comparison.faceCount},  {"processor", machine.processor},
            {"threads", machine.threads},   {"loadAverage", machine.loadAverage}, {"rounds", comparison.roundCount},
            {"devices", comparison.devices}};
  for (const SeedComparison& seeds : comparison.seeds) json["seeds"].push_back(jsonOf(comparison, seeds));
  json["cgalSeconds"] = comparison.cgal.empty() ? Json(nullptr) : jsonOf(spreadOf(comparison.cgal));
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace asdfvk::bench
