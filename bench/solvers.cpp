// The Poisson solvers side by side on the same seeds: iterations, residual, time.
#include <fmt/format.h>

#include <array>

#include "bench_program.h"
#include "cli/option_values.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "file_run.h"
#include "generate/creatures.h"
#include "machine.h"
#include "mesh/mesh_reader.h"
#include "spread.h"

namespace {

using namespace asdfvk;

struct Contender {
  SolverChoice choice;
  SolverReport report;
  std::vector<double> seconds, ratios;  ///< Ratios to Eigen's time of the same round.
};

struct Arguments {
  std::vector<std::string> meshes, seeds{"10%"};
  std::string device;
  uint64_t generatedFaceCount = 100'000;
  uint32_t runCount = 5;
  double tolerance = SolverOptions{}.tolerance;
};

void compare(Session& session, const std::string& name, Mesh& mesh, const std::string& seeds,
             const Arguments& arguments, const RunControl& control) {
  std::array<Contender, 4> contenders{{{SolverChoice::Eigen, {}, {}, {}},
                                       {SolverChoice::Cpu, {}, {}, {}},
                                       {SolverChoice::Cg, {}, {}, {}},
                                       {SolverChoice::Jacobi, {}, {}, {}}}};
  Options options;
  options.seeds = parseSeedCount(seeds);
  options.solverOptions.tolerance = arguments.tolerance;
  std::string device;
  for (uint32_t round = 0; round <= arguments.runCount; ++round) {
    for (Contender& contender : contenders) {
      options.solver = contender.choice;
      const Report report = session.compute(mesh, options, control).report;
      device = report.device;
      contender.report = report.solver;
      if (round == 0) continue;
      contender.seconds.push_back(report.stageSeconds.solve);
      contender.ratios.push_back(report.stageSeconds.solve / contenders[0].seconds.back());
    }
  }
  std::string text = fmt::format(
      "{}: {} faces, seeds {}, tolerance {:g}, {} rounds on {}; {}\n"
      "the whole solve stage, system and transfers included; median ± median absolute deviation\n\n"
      "| solver | iterations | residual | converged | seconds | over eigen |\n"
      "|--------|-----------:|---------:|-----------|--------:|-----------:|\n",
      name, groupDigits(mesh.inputFaceCount()), seeds, arguments.tolerance, arguments.runCount,
      toText(bench::thisMachine()), device);
  for (const Contender& contender : contenders)
    text += fmt::format("| {:<6} | {:>10} | {:.2e} | {:<9} | {} | {} |\n", contender.report.name,
                        contender.report.iterations, contender.report.relativeResidual,
                        contender.report.converged ? "yes" : "no", toText(bench::spreadOf(contender.seconds), 3),
                        toText(bench::spreadOf(contender.ratios), 2));
  writeStandardOutput(text + "\n");
}

void run(const Arguments& arguments, const RunControl& control) {
  Session session(bench::sessionOptionsOf("vulkan", arguments.device));
  const auto compareAll = [&](const std::string& name, Mesh mesh) {
    for (const std::string& seeds : arguments.seeds) compare(session, name, mesh, seeds, arguments, control);
  };
  for (const std::string& mesh : arguments.meshes) compareAll(mesh, readMesh(mesh));
  if (arguments.meshes.empty()) compareAll("generated animal", makeAnimal(arguments.generatedFaceCount).mesh);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the Poisson solvers turn by turn on the same seeds.", "asdfvk-bench-solvers");
  Arguments arguments;
  app.add_option("meshes", arguments.meshes, "Meshes; without one an animal is generated")->option_text("MESH...");
  app.add_option("--faces", arguments.generatedFaceCount, "Faces of the generated animal")
      ->check(CLI::Range(kMinFaceCount, kMaxFaceCount))
      ->capture_default_str();
  app.add_option("--runs", arguments.runCount, "Counted rounds, after one that warms up")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  app.add_option("--seeds", arguments.seeds, "Shares or counts")->delimiter(',')->capture_default_str();
  app.add_option("--tolerance", arguments.tolerance, "Relative residual")->capture_default_str();
  app.add_option("--device", arguments.device, "As asdf-vk takes it");
  return bench::runBenchProgram(app, argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
