#include "stage_measurement.h"

#include "process/temporary_folder.h"

namespace asdfvk::bench {
namespace {

double secondsOf(const FileRun& run, TimeSpan span) {
  const StageSeconds& seconds = run.report.stageSeconds;
  if (span == TimeSpan::Total) return run.totalSeconds;
  return seconds[Stage::Sample] + seconds[Stage::Trace] + seconds[Stage::Predict] + seconds[Stage::Solve];
}

template <typename Quantity>
std::vector<double> samplesOf(const StageRow& row, const Quantity& quantity) {
  std::vector<double> samples;
  for (const FileRun& run : row.runs) samples.push_back(quantity(run));
  return samples;
}

std::vector<double> samplesOf(const StageRow& row, double ProcessUsage::*quantity) {
  std::vector<double> samples;
  for (const ProcessUsage& process : row.processes) samples.push_back(process.*quantity);
  return samples;
}

Options optionsFor(const std::string& seeds) {
  Options options;
  options.seeds = parseSeedCount(seeds);
  return options;
}

/// Runs the program with its default options, which include the error estimate.
ProcessUsage runProcess(const std::filesystem::path& mesh, const StageRow& row, const std::string& device,
                        const std::filesystem::path& output) {
  std::vector<std::string> arguments{mesh, "--seeds", row.seeds, "--backend", row.backend, "-o", output, "--quiet"};
  if (row.backend == "vulkan" && !device.empty()) arguments.insert(arguments.end(), {"--device", device});
  ProcessUsage usage;
  static_cast<void>(outputOf(ASDFVK_PROGRAM, arguments, &usage));
  return usage;
}

}  // namespace

Dispersion StageRow::seconds(Stage stage) const {
  return dispersionOf(samplesOf(*this, [&](const FileRun& run) { return run.report.stageSeconds[stage]; }));
}

Dispersion StageRow::share(Stage stage) const {
  return dispersionOf(
      samplesOf(*this, [&](const FileRun& run) { return run.report.stageSeconds[stage] / run.totalSeconds; }));
}

Dispersion StageRow::process(double ProcessUsage::*quantity) const { return dispersionOf(samplesOf(*this, quantity)); }

Dispersion StageRow::total() const {
  return dispersionOf(samplesOf(*this, [](const FileRun& run) { return run.totalSeconds; }));
}

Dispersion StageRow::raysPerSecond() const {
  return dispersionOf(samplesOf(*this, [](const FileRun& run) { return run.report.raysPerSecond; }));
}

const StageRow* StageMeasurement::find(const std::string& seeds, const std::string& backend) const {
  for (const StageRow& row : rows)
    if (row.seeds == seeds && row.backend == backend) return &row;
  return nullptr;
}

std::optional<Dispersion> StageMeasurement::referenceOverVulkan(const StageRow& row, TimeSpan span) const {
  const StageRow* reference = find(row.seeds, "reference");
  if (row.backend != "vulkan" || reference == nullptr) return {};
  const auto seconds = [&](const FileRun& run) { return secondsOf(run, span); };
  return ratioOf(samplesOf(*reference, seconds), samplesOf(row, seconds));
}

std::optional<Dispersion> StageMeasurement::speedUp(const StageRow& row) const {
  const StageRow* full = find("all", row.backend);
  if (full == nullptr || full == &row) return {};
  const auto seconds = row.runsOnCpu ? &ProcessUsage::cpuSeconds : &ProcessUsage::seconds;
  return ratioOf(samplesOf(*full, seconds), samplesOf(row, seconds));
}

std::optional<Dispersion> StageMeasurement::overFullTrace(const StageRow& row) const {
  const StageRow* full = find("all", row.backend);
  if (full == nullptr || full == &row) return {};
  return ratioOf(samplesOf(row, [](const FileRun& run) { return secondsOf(run, TimeSpan::Interpolation); }),
                 samplesOf(*full, [](const FileRun& run) { return run.report.stageSeconds[Stage::Trace]; }));
}

StageBench::StageBench(StageRequest request) : request_(std::move(request)) {
  // Invalid requests fail here, before the first measurement.
  for (const std::string& seeds : request_.seeds) static_cast<void>(parseSeedCount(seeds));
  for (const std::string& backend : request_.backends)
    sessions_.emplace(backend, std::make_unique<Session>(sessionOptionsOf(backend, request_.device)));
}

StageMeasurement StageBench::measure(const std::string& name, const std::filesystem::path& mesh,
                                     const RunControl& control) {
  const TemporaryFolder folder;
  const std::filesystem::path output = folder.path() / "result.ply";
  StageMeasurement measurement{name};
  for (const std::string& seeds : request_.seeds)
    for (const std::string& backend : request_.backends) measurement.rows.push_back({seeds, backend});
  for (uint32_t round = 0; round <= request_.runCount; ++round)
    for (StageRow& row : measurement.rows) {
      FileRun run = runFile(*sessions_.at(row.backend), mesh, optionsFor(row.seeds), output, control);
      const ProcessUsage process = runProcess(mesh, row, request_.device, output);
      row.runsOnCpu = run.report.runsOnCpu;
      control.checkpoint(0);
      if (round == 0) continue;
      row.runs.push_back(std::move(run));
      row.processes.push_back(process);
    }
  return measurement;
}

}  // namespace asdfvk::bench
