// The Poisson solvers side by side on the same seeds: iterations, residual, time.
#include <fmt/format.h>

#include <array>
#include <functional>

#include "bench_program.h"
#include "cli/option_values.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "core/text.h"
#include "eigen_rivals.h"
#include "file_run.h"
#include "generate/creatures.h"
#include "io/mesh_reader.h"
#include "machine.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "poisson/arc_weights.h"
#include "poisson/poisson_system.h"
#include "spread.h"
#include "work_watch.h"

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
  bool comparesBare = false;
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

/// A solver on the bare system, whose set-up, factors included, is timed with it.
struct BareContender {
  std::string name;
  std::function<uint32_t(std::span<double> solution)> solve;
  uint32_t iterationCount = 0;
  double relativeResidual = 0;
  std::vector<double> seconds, threadSeconds, ratios;  ///< Ratios to the thread seconds of the first in the same round.
};

/// Without guidance and prediction, so from the mean of the seeds' values on.
void compareBare(Session& session, const Mesh& mesh, const std::string& seeds, const Arguments& arguments,
                 const RunControl& control) {
  Options options;
  options.seeds = parseSeedCount(seeds);
  options.estimatesError = false;
  Mesh copy = mesh;
  const Result result = session.compute(copy, options, control);
  if (result.sdf.size() != mesh.faces.size()) return;  // Polygons: the values are not those of the triangles.
  std::vector<double> values(result.sdf.size(), kNoValue);
  for (size_t face = 0; face < values.size(); ++face)
    if (result.isSeed[face]) values[face] = result.sdf[face];
  const DualGraph graph = buildDualGraph(mesh);
  const PoissonSystem system =
      buildPoissonSystem(graph, arcWeights(ArcWeightKind::Feature, graph, computeFaceGeometry(mesh)), values, {});
  const bench::EigenMatrix matrix = bench::eigenMatrix(system);
  std::vector<BareContender> contenders;
  const auto addOurs = [&](const std::string& name, std::unique_ptr<PoissonSolver> (*make)()) {
    contenders.push_back({name, [&, make](std::span<double> solution) {
                            const SolverOptions solverOptions{.tolerance = arguments.tolerance};
                            return make()->solve(system, solverOptions, solution, control).iterations;
                          }});
  };
  addOurs("eigen", makeEigenSolver);
  addOurs("cpu", makeCpuCgSolver);
  for (const bench::EigenRival& rival : bench::eigenRivals())
    contenders.push_back({rival.name, [&, rival](std::span<double> solution) {
                            return rival.solve(matrix, system, arguments.tolerance, solution);
                          }});
  std::vector<double> solution(system.unknownCount());
  for (uint32_t round = 0; round <= arguments.runCount; ++round)
    for (BareContender& contender : contenders) {
      control.checkpoint(0);
      const bench::WorkWatch clock(bench::Workers::Others), threads(bench::Workers::Processors);
      contender.iterationCount = contender.solve(solution);
      const double seconds = clock.seconds(), threadSeconds = threads.seconds();
      contender.relativeResidual = relativeResidual(system, solution);
      if (round == 0) continue;
      contender.seconds.push_back(seconds);
      contender.threadSeconds.push_back(threadSeconds);
      contender.ratios.push_back(threadSeconds / contenders[0].threadSeconds.back());
    }
  std::string text = fmt::format(
      "the equation alone, harmonic, {} unknowns, built and solved; a matrix for Eigen is there before\n\n"
      "| solver | iterations | residual | seconds | seconds of all threads | over eigen |\n"
      "|--------|-----------:|---------:|--------:|-----------------------:|-----------:|\n",
      groupDigits(system.unknownCount()));
  for (const BareContender& contender : contenders)
    text +=
        fmt::format("| {} | {} | {:.2e} | {} | {} | {} |\n", contender.name, contender.iterationCount,
                    contender.relativeResidual, toText(bench::spreadOf(contender.seconds), 4),
                    toText(bench::spreadOf(contender.threadSeconds), 4), toText(bench::spreadOf(contender.ratios), 2));
  writeStandardOutput(text + "\n");
}

void run(const Arguments& arguments, const RunControl& control) {
  Session session(bench::sessionOptionsOf("vulkan", arguments.device));
  const auto compareAll = [&](const std::string& name, Mesh mesh) {
    for (const std::string& seeds : arguments.seeds) {
      compare(session, name, mesh, seeds, arguments, control);
      if (arguments.comparesBare) compareBare(session, mesh, seeds, arguments, control);
    }
  };
  for (const std::string& mesh : arguments.meshes) compareAll(mesh, readMesh(mesh));
  if (arguments.meshes.empty()) compareAll("generated animal", makeAnimal(arguments.generatedFaceCount).mesh);
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-solvers", "Times the Poisson solvers turn by turn on the same seeds.");
  Arguments arguments;
  program.addMeshesOr(arguments.meshes, "an animal is generated");
  program.add("--faces", arguments.generatedFaceCount, "Faces of the generated animal", {kMinFaceCount, kMaxFaceCount});
  program.add("--runs", arguments.runCount, "Counted rounds, after one that warms up", {1, 1000});
  program.add("--seeds", arguments.seeds, "Shares or counts");
  program.add("--tolerance", arguments.tolerance, "Relative residual");
  program.add("--bare", arguments.comparesBare, "Also on the equation alone, beside Eigen's own solvers");
  program.add("--device", arguments.device, "As asdf-vk takes it");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
