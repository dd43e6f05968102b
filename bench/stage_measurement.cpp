#include "stage_measurement.h"

#include <fmt/format.h>

#include <sstream>

#include "cli/option_values.h"
#include "core/stopwatch.h"
#include "machine.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace asdfvk::bench {
namespace {

double traceAndInterpolation(const FileRun& run) {
  const StageSeconds& seconds = run.report.stageSeconds;
  return seconds.sample + seconds.trace + seconds.predict + seconds.solve;
}

template <typename Quantity>
Spread spreadOfRuns(const StageRow& row, const Quantity& quantity) {
  std::vector<double> samples;
  for (const FileRun& run : row.runs) samples.push_back(quantity(run));
  return spreadOf(std::move(samples));
}

template <typename Upper, typename Lower>
Spread ratioByRound(const StageRow& above, const Upper& upper, const StageRow& below, const Lower& lower) {
  std::vector<double> ratios;
  for (size_t i = 0; i < above.runs.size(); ++i) ratios.push_back(upper(above.runs[i]) / lower(below.runs[i]));
  return spreadOf(std::move(ratios));
}

Options optionsFor(const std::string& seeds) {
  Options options;
  options.seeds = parseSeedCount(seeds);
  return options;
}

ColdRun runCold(const std::string& mesh, const StageRow& row, const std::string& device) {
  std::vector<std::string> arguments{"--cold", "--seeds", row.seeds, "--backends", row.backend};
  if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
  arguments.insert(arguments.end(), {"--", mesh});
  std::istringstream text(outputOf(kThisProgram, arguments));
  ColdRun run;
  text >> run.seconds >> run.peakBytes;
  return run;
}

}  // namespace

Spread StageRow::stage(double StageSeconds::*member) const {
  return spreadOfRuns(*this, [&](const FileRun& run) { return run.report.stageSeconds.*member; });
}
Spread StageRow::total() const {
  return spreadOfRuns(*this, [](const FileRun& run) { return run.totalSeconds; });
}
Spread StageRow::raysPerSecond() const {
  return spreadOfRuns(*this, [](const FileRun& run) { return run.report.raysPerSecond; });
}

const StageRow* StageMeasurement::find(const std::string& seeds, const std::string& backend) const {
  for (const StageRow& row : rows)
    if (row.seeds == seeds && row.backend == backend) return &row;
  return nullptr;
}

std::optional<Spread> referenceOverVulkan(const StageMeasurement& measurement, const StageRow& row, Share share) {
  const StageRow* reference = measurement.find(row.seeds, "reference");
  if (row.backend != "vulkan" || reference == nullptr) return std::nullopt;
  const auto seconds = [&](const FileRun& run) {
    return share == Share::Total ? run.totalSeconds : traceAndInterpolation(run);
  };
  return ratioByRound(*reference, seconds, row, seconds);
}

std::optional<Spread> overFullTrace(const StageMeasurement& measurement, const StageRow& row) {
  const StageRow* full = measurement.find("all", row.backend);
  if (full == nullptr || full == &row) return std::nullopt;
  return ratioByRound(row, traceAndInterpolation, *full,
                      [](const FileRun& run) { return run.report.stageSeconds.trace; });
}

StageBench::StageBench(StageRequest request) : request_(std::move(request)) {
  for (const std::string& seeds : request_.seeds) static_cast<void>(parseSeedCount(seeds));  // Refused before any work.
  for (const std::string& backend : request_.backends)
    sessions_.emplace(backend, std::make_unique<Session>(sessionOptionsOf(backend, request_.device)));
}

StageMeasurement StageBench::measure(const std::string& name, const std::filesystem::path& mesh,
                                     const RunControl& control) {
  const TemporaryFolder folder;
  const std::filesystem::path output = folder.path() / "result.ply";
  StageMeasurement measurement{name, {}};
  for (const std::string& seeds : request_.seeds)
    for (const std::string& backend : request_.backends) measurement.rows.push_back({seeds, backend, false, {}, {}});
  for (uint32_t round = 0; round <= request_.runCount; ++round)
    for (StageRow& row : measurement.rows) {
      FileRun run = runFile(*sessions_.at(row.backend), mesh, optionsFor(row.seeds), output, control);
      if (round > 0) row.runs.push_back(std::move(run));
    }
  for (StageRow& row : measurement.rows) {
    row.perCore = row.runs.front().report.runsOnCpu;
    row.cold = runCold(mesh.string(), row, request_.device);
    control.checkpoint(0);
  }
  return measurement;
}

std::string coldRunText(const std::string& mesh, const std::string& seeds, const std::string& backend,
                        const std::string& device, const RunControl& control) {
  const TemporaryFolder folder;
  const Stopwatch watch;
  Session session(sessionOptionsOf(backend, device));
  static_cast<void>(runFile(session, mesh, optionsFor(seeds), folder.path() / "result.ply", control));
  return fmt::format("{} {}\n", watch.seconds(), peakMemoryBytes());
}

}  // namespace asdfvk::bench
