// What interpolating costs and what it saves: errors against the shape diameter function traced at all faces, beside
// Table 1 of the ASDF paper (its horse), and time against the full trace.
#include <fmt/format.h>

#include <array>

#include "bench_program.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "file_run.h"
#include "mesh/mesh_reader.h"
#include "share_errors.h"
#include "spread.h"

namespace {

using namespace asdfvk;

/// A row of the paper's table.
struct PaperErrors {
  double percent, average, maximum;
};
constexpr std::array<PaperErrors, 6> kPaper{{{50, .0099, .4022},
                                             {20, .0198, .5054},
                                             {10, .0272, .5292},
                                             {5, .0374, .5538},
                                             {2, .0575, .5374},
                                             {1, .0695, .5813}}};

struct ShareSamples {
  std::vector<double> averages, maxima, timeRatios;
};

double seconds(const Result& result) { return result.report.stageSeconds.trace + result.report.stageSeconds.solve; }

Options optionsFor(double percent, uint64_t randomSeed) {
  Options options;
  options.seeds = {SeedCount::Kind::Share, percent / 100, 0};
  if (percent == 100) options.seeds.kind = SeedCount::Kind::All;
  options.randomSeed = randomSeed;
  return options;
}

std::string row(const PaperErrors& paper, const ShareSamples& samples) {
  const bench::Spread average = bench::spreadOf(samples.averages), maximum = bench::spreadOf(samples.maxima);
  return fmt::format("| {:>3g} % | {:.4f} | {:.4f}..{:.4f} | {:>13.4f} | {:.4f} | {:.4f}..{:.4f} | {:>13.4f} | {} |\n",
                     paper.percent, average.median, average.min, average.max, paper.average, maximum.median,
                     maximum.min, maximum.max, paper.maximum, toText(bench::spreadOf(samples.timeRatios), 3));
}

void compare(Session& session, const std::string& path, uint32_t roundCount, const RunControl& control) {
  Mesh mesh = readMesh(path);
  std::array<ShareSamples, kPaper.size()> samples;
  static_cast<void>(session.compute(mesh, optionsFor(1, 1), control));  // Compiles the kernels.
  Result full;
  for (uint32_t round = 1; round <= roundCount; ++round) {
    full = session.compute(mesh, optionsFor(100, round), control);
    for (size_t i = 0; i < kPaper.size(); ++i) {
      const Result part = session.compute(mesh, optionsFor(kPaper[i].percent, round), control);
      const bench::ShareErrors errors = bench::errorsOverRange(full.sdf, part.sdf);
      samples[i].averages.push_back(errors.average);
      samples[i].maxima.push_back(errors.maximum);
      samples[i].timeRatios.push_back(seconds(part) / full.report.stageSeconds.trace);
    }
  }
  const Report& report = full.report;
  std::string text = fmt::format(
      "{}: {} faces, {} without a value, full values from {:.4g} to {:.4g}, {} random seeds\n{} ({})\n"
      "errors over the range of the full values, median and extremes over the random seeds\n\n"
      "| seeds | average | extremes | paper average | maximum | extremes | paper maximum | trace and solve / full "
      "trace "
      "|\n|------:|--------:|---------:|--------------:|--------:|---------:|--------------:|---------------:|\n",
      path, groupDigits(report.faceCount), report.noValueCount, report.sdf.min, report.sdf.max, roundCount,
      report.device, report.backend);
  for (size_t i = 0; i < kPaper.size(); ++i) text += row(kPaper[i], samples[i]);
  writeStandardOutput(text + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Errors and time of interpolated against fully traced values, beside the paper's Table 1.",
               "asdfvk-bench-interpolation");
  std::vector<std::string> meshes;
  std::string backend = "vulkan", device;
  uint32_t roundCount = 3;
  app.add_option("meshes", meshes, "Meshes")->option_text("MESH...")->required();
  app.add_option("--backend", backend, "vulkan, cpu or reference")->capture_default_str();
  app.add_option("--device", device, "As asdf-vk takes it");
  app.add_option("--runs", roundCount, "Random seeds; the full trace is repeated with each")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  return bench::runBenchProgram(app, argc, argv, [&](const RunControl& control) {
    Session session(bench::sessionOptionsOf(backend, device));
    for (const std::string& mesh : meshes) compare(session, mesh, roundCount, control);
  });
}
