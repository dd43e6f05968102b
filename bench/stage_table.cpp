#include "stage_table.h"
#include "core/text.h"

#include <fmt/format.h>

#include "cli/report_text.h"

namespace asdfvk::bench {
namespace {

std::string line(const std::vector<std::string>& cells) {
  std::string text = fmt::format("| {:<5} | {:<9} |", cells[0], cells[1]);
  for (size_t i = 2; i < cells.size(); ++i) text += fmt::format(" {:>12} |", cells[i]);
  return text + "\n";
}

std::string megaRays(const Spread& rays, double divisor) {
  const double scale = 1e6 * divisor;
  return toText({rays.median / scale, rays.deviation / scale, rays.min / scale, rays.max / scale}, 2);
}

std::string rowText(const StageRow& row, unsigned threads) {
  std::vector<std::string> cells{row.seeds, row.backend};
  for (const auto& [name, member] : kStages) cells.push_back(toText(row.stage(member), 3));
  cells.push_back(toText(row.total(), 3));
  cells.push_back(megaRays(row.raysPerSecond(), 1));
  cells.push_back(row.perCore ? megaRays(row.raysPerSecond(), threads) : "-");
  cells.push_back(fmt::format("{:.3f}", row.cold.seconds));
  cells.push_back(fmt::format("{:.0f}", row.cold.peakBytes / (1 << 20)));
  return line(cells);
}

std::string heading(const StageMeasurement& measurement, const Machine& machine) {
  const Report& report = measurement.rows.front().runs.front().report;
  std::string text =
      fmt::format("{}: {} faces ({} triangles, {} vertices), {} rounds on {}\n", measurement.mesh,
                  groupDigits(report.faceCount), groupDigits(report.triangleCount), groupDigits(report.vertexCount),
                  measurement.rows.front().runs.size(), toText(machine));
  for (const StageRow& row : measurement.rows)
    if (row.seeds == measurement.rows.front().seeds)
      text += fmt::format("{}: {}\n", row.backend, row.runs.front().report.device);
  return text +
         "seconds, median ± median absolute deviation; 'cold' is one run in a fresh process, device and kernels\n"
         "included, 'peak MiB' is that process's VmHWM\n\n";
}

std::string ratios(const StageMeasurement& measurement) {
  std::string text;
  for (const StageRow& row : measurement.rows) {
    const auto compute = referenceOverVulkan(measurement, row, Share::TraceAndInterpolation);
    const auto total = referenceOverVulkan(measurement, row, Share::Total);
    if (compute && total)
      text += fmt::format("seeds {}: reference / vulkan: trace and interpolation {}, total {}\n", row.seeds,
                          toText(*compute, 2), toText(*total, 2));
  }
  for (const StageRow& row : measurement.rows)
    if (const auto share = overFullTrace(measurement, row))
      text += fmt::format("seeds {}, {}: trace and interpolation / trace of all {}\n", row.seeds, row.backend,
                          toText(*share, 3));
  return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string stageTable(const StageMeasurement& measurement, const Machine& machine) {
  std::vector<std::string> titles{"seeds", "backend"};
  for (const auto& [name, member] : kStages) titles.emplace_back(name);
  titles.insert(titles.end(), {"total", "Mrays/s", "per core", "cold", "peak MiB"});
  std::string text = heading(measurement, machine) + line(titles) + "|-------|-----------|";
  for (size_t i = 2; i < titles.size(); ++i) text += "-------------:|";
  text += "\n";
  for (const StageRow& row : measurement.rows) text += rowText(row, machine.threads);
  return text + ratios(measurement) + "\n";
}

}  // namespace asdfvk::bench
