// Prints the time of each stage of a computation, including reading and writing. Runs backends and shares of seeds in
// turns.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "generate/creatures.h"
#include "generate/generated_shape.h"
#include "process/temporary_folder.h"
#include "stage_measurement.h"
#include "support/process.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes;
  StageRequest request{{"all", "10%", "1%"}, {"cpu", "vulkan"}, {}, 5};
  uint64_t generatedFaceCount = 100'000;
  bool isJson = false;
};

std::vector<Stage> allStages() {
  std::vector<Stage> stages;
  for (size_t i = 0; i < kStageCount; ++i) stages.push_back(static_cast<Stage>(i));
  return stages;
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = fmt::format("| {:<5} | {:<9} |", cells[0], cells[1]);
  for (size_t i = 2; i < cells.size(); ++i) text += fmt::format(" {:>12} |", cells[i]);
  return text + "\n";
}

std::string megaRays(const Dispersion& rays, double divisor) {
  return toText({rays.median / (1e6 * divisor), rays.deviation / (1e6 * divisor), 0, 0}, 2);
}

std::string heading(const StageMeasurement& measurement, const Machine& machine) {
  const StageRow& first = measurement.rows.front();
  const Report& report = first.runs.front().report;
  std::string text = fmt::format("{}: {} faces ({} triangles, {} vertices), {} rounds on {}\n", measurement.mesh,
                                 groupDigits(report.faceCount), groupDigits(report.triangleCount),
                                 groupDigits(report.vertexCount), first.runs.size(), toText(machine));
  for (const StageRow& row : measurement.rows)
    if (row.seeds == first.seeds) text += fmt::format("{}: {}\n", row.backend, row.runs.front().report.device);
  return text +
         "seconds: median ± median absolute deviation; process: asdf-vk from file to file, with opening the device "
         "and\n"
         "compiling kernels; peak MiB: peak resident memory of that process\n\n";
}

std::string ratiosText(const StageMeasurement& measurement) {
  std::string text;
  for (const StageRow& row : measurement.rows)
    if (const auto total = measurement.referenceOverVulkan(row, TimeSpan::Total))
      text += fmt::format("seeds {}: reference / vulkan: trace and interpolation {}, total {}\n", row.seeds,
                          toText(measurement.referenceOverVulkan(row, TimeSpan::Interpolation), 2), toText(*total, 2));
  for (const StageRow& row : measurement.rows)
    if (const auto ratio = measurement.overFullTrace(row))
      text += fmt::format("seeds {}, {}: trace and interpolation / trace of all faces {}\n", row.seeds, row.backend,
                          toText(*ratio, 3));
  return text.empty() ? text : "\n" + text;
}

/// The first line of the output: how many times faster the computation is with interpolation.
std::string speedUpsText(const StageMeasurement& measurement) {
  std::string text;
  for (const StageRow& row : measurement.rows)
    if (const auto ratio = measurement.speedUp(row))
      text += fmt::format("{} of the faces on {}: {} times as fast as all faces, whole process, by {}\n", row.seeds,
                          row.backend, toText(*ratio, 2), row.runsOnCpu ? "CPU time" : "time");
  return text.empty() ? text : text + "\n";
}

std::string toTable(const StageMeasurement& measurement, const Machine& machine) {
  std::vector<std::string> titles{"seeds", "backend"};
  for (const Stage stage : allStages()) titles.emplace_back(nameOf(stage));
  titles.insert(titles.end(), {"total", "Mrays/s", "per core", "process", "process CPU", "peak MiB"});
  std::string text = heading(measurement, machine) + speedUpsText(measurement) + line(titles) + "|-------|-----------|";
  for (size_t i = 2; i < titles.size(); ++i) text += "-------------:|";
  text += "\n";
  for (const StageRow& row : measurement.rows) {
    std::vector<std::string> cells{row.seeds, row.backend};
    for (const Stage stage : allStages()) cells.push_back(toText(row.seconds(stage), 3));
    cells.push_back(toText(row.total(), 3));
    cells.push_back(megaRays(row.raysPerSecond(), 1));
    cells.push_back(row.runsOnCpu ? megaRays(row.raysPerSecond(), machine.threads) : "-");
    cells.push_back(toText(row.process(&ProcessUsage::seconds), 3));
    cells.push_back(toText(row.process(&ProcessUsage::cpuSeconds), 3));
    cells.push_back(fmt::format("{:.0f}", row.process(&ProcessUsage::peakBytes).median / (1 << 20)));
    text += line(cells);
    std::vector<std::string> shares{"", "share"};
    for (const Stage stage : allStages()) shares.push_back(fmt::format("{:.1f} %", 100 * row.share(stage).median));
    shares.resize(cells.size());
    text += line(shares);
  }
  return text + ratiosText(measurement) + "\n";
}

Json toJson(const StageMeasurement& measurement, const StageRow& row, const Machine& machine) {
  const Report& report = row.runs.front().report;
  Json stages, shares;
  for (const Stage stage : allStages()) {
    stages[nameOf(stage)] = bench::toJson(row.seconds(stage));
    shares[nameOf(stage)] = bench::toJson(row.share(stage));
  }
  return {{"mesh", measurement.mesh},
          {"faceCount", report.faceCount},
          {"triangleCount", report.triangleCount},
          {"vertexCount", report.vertexCount},
          {"seeds", row.seeds},
          {"seedCount", report.seedCount},
          {"rayCount", report.rayCount},
          {"backend", row.backend},
          {"device", report.device},
          {"processor", machine.processor},
          {"threads", machine.threads},
          {"loadAverage", machine.loadAverage},
          {"runs", row.runs.size()},
          {"stageSeconds", stages},
          {"totalSeconds", bench::toJson(row.total())},
          {"raysPerSecond", bench::toJson(row.raysPerSecond())},
          {"raysPerSecondAndCore", row.runsOnCpu ? Json(row.raysPerSecond().median / machine.threads) : Json(nullptr)},
          {"speedUpOverAllFaces", bench::toJson(measurement.speedUp(row))},
          {"stageShare", shares},
          {"processSeconds", bench::toJson(row.process(&ProcessUsage::seconds))},
          {"processCpuSeconds", bench::toJson(row.process(&ProcessUsage::cpuSeconds))},
          {"peakBytes", bench::toJson(row.process(&ProcessUsage::peakBytes))},
          {"solver", {{"name", report.solver.name}, {"iterations", report.solver.iterations}}},
          {"referenceOverVulkan",
           {{"traceAndInterpolation", bench::toJson(measurement.referenceOverVulkan(row, TimeSpan::Interpolation))},
            {"total", bench::toJson(measurement.referenceOverVulkan(row, TimeSpan::Total))}}},
          {"traceAndInterpolationOverFullTrace", bench::toJson(measurement.overFullTrace(row))}};
}

void run(const Arguments& arguments, const RunControl& control) {
  const StageRequest& request = arguments.request;
  StageBench stages(request);
  const auto measure = [&](const std::string& name, const std::filesystem::path& path) {
    const StageMeasurement measurement = stages.measure(name, path, control);
    const Machine machine = thisMachine();
    if (!arguments.isJson) return writeOutput(toTable(measurement, machine));
    for (const StageRow& row : measurement.rows) writeOutput(oneLine(toJson(measurement, row, machine)));
  };
  for (const std::string& mesh : arguments.meshes) measure(mesh, mesh);
  if (!arguments.meshes.empty()) return;
  const TemporaryFolder folder;
  const std::filesystem::path animal = folder.path() / "animal.ply";
  writeGeneratedPly(animal, makeAnimal(arguments.generatedFaceCount), false);
  measure("generated animal", animal);
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-stages", "Times the stages of a computation for several backends, in turns.");
  Arguments arguments;
  program.addOptionalMeshes(arguments.meshes, "a generated animal");
  program.add("--faces", arguments.generatedFaceCount, "Faces of the generated animal", {kMinFaceCount, kMaxFaceCount});
  program.add("--runs", arguments.request.runCount, "Rounds, after one for warm-up", {1, 1000});
  program.add("--seeds", arguments.request.seeds, "Shares, counts or all");
  program.add("--backends", arguments.request.backends, "Some of reference, vulkan and cpu");
  program.add("--device", arguments.request.device, "Vulkan device: index or part of its name");
  program.add("--json", arguments.isJson, "One JSON line per row instead of a table");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
