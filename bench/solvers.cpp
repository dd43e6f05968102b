// How many iterations and seconds do the Poisson solvers need on the same seeds, and which residual do they reach?
#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <functional>

#include "asdf_vk/files.h"
#include "core/text.h"
#include "generate/creatures.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "poisson/poisson_solver.h"
#include "poisson/poisson_system.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes, seeds{"10%"};
  std::string device;
  uint64_t generatedFaceCount = 100'000;
  uint32_t runCount = 5;
  double tolerance = SolverOptions{}.tolerance;
  bool solvesSystem = false;
};

struct SolverTimes {
  const char* name;
  SolverReport report = {};
  std::vector<double> seconds = {};
};

/// Times the solve stage of whole computations.
void compareSolvers(Session& session, const std::string& name, const Mesh& mesh, const std::string& seeds,
                    const Arguments& arguments, const RunControl& control) {
  std::array<SolverTimes, 4> rows{{{"eigen"}, {"cpu"}, {"cg"}, {"jacobi"}}};
  Options options;
  options.seeds = parseSeedCount(seeds);
  options.solverOptions.tolerance = arguments.tolerance;
  std::string device;
  for (uint32_t round = 0; round <= arguments.runCount; ++round)
    for (SolverTimes& row : rows) {
      options.solver = row.name;
      const Report report = session.compute(mesh, options, control).report;
      device = report.device;
      row.report = report.solver;
      if (round > 0) row.seconds.push_back(report.stageSeconds[Stage::Solve]);  // Round 0 is the warm-up.
    }
  std::string text = fmt::format(
      "{}: {} faces, seeds {}, tolerance {:g}, {} rounds on {}; {}\n"
      "solve stage with system and transfers; seconds: median ± median absolute deviation\n\n"
      "| solver | iterations | residual | converged | seconds | / eigen |\n"
      "|--------|-----------:|---------:|-----------|--------:|--------:|\n",
      name, groupDigits(mesh.inputFaceCount()), seeds, arguments.tolerance, arguments.runCount, toText(thisMachine()),
      device);
  for (const SolverTimes& row : rows)
    text += fmt::format("| {:<6} | {:>10} | {:.2e} | {:<9} | {} | {} |\n", row.name, row.report.iterations,
                        row.report.relativeResidual, row.report.converged ? "yes" : "no",
                        toText(dispersionOf(row.seconds), 3), toText(ratioOf(row.seconds, rows[0].seconds), 2));
  writeOutput(text + "\n");
}

using EigenMatrix = Eigen::SparseMatrix<double>;
using EigenVector = Eigen::VectorXd;

EigenMatrix toEigen(const PoissonSystem& system) {
  const auto size = static_cast<Eigen::Index>(system.unknownCount());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(system.columns.size() + system.faces.size());
  for (uint32_t row = 0; row < system.unknownCount(); ++row) {
    entries.emplace_back(row, row, system.diagonal[row]);
    for (uint32_t i = system.rowOffsets[row]; i < system.rowOffsets[row + 1]; ++i)
      entries.emplace_back(row, system.columns[i], system.entries[i]);
  }
  EigenMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Starts at the mean of the known values and stops at ||r|| <= tolerance ||b||, which is close to relativeResidual()
/// where weights are alike. Returns the iterations.
template <typename Preconditioner>
uint32_t solveWithEigenCg(const EigenMatrix& matrix, const PoissonSystem& system, double tolerance,
                          std::span<double> solution) {
  Eigen::ConjugateGradient<EigenMatrix, Eigen::Lower | Eigen::Upper, Preconditioner> solver;
  solver.setTolerance(tolerance);
  solver.compute(matrix);
  const Eigen::Map<const EigenVector> b(system.rightHandSide.data(), matrix.rows());
  Eigen::Map<EigenVector>(solution.data(), matrix.rows()) =
      solver.solveWithGuess(b, EigenVector::Constant(matrix.rows(), system.constraintMean));
  return static_cast<uint32_t>(solver.iterations());
}

uint32_t solveWithEigenFactors(const EigenMatrix& matrix, const PoissonSystem& system, std::span<double> solution) {
  const Eigen::SimplicialLDLT<EigenMatrix> factors(matrix);
  const Eigen::Map<const EigenVector> b(system.rightHandSide.data(), matrix.rows());
  Eigen::Map<EigenVector>(solution.data(), matrix.rows()) = factors.solve(b);
  return 0;
}

/// A solver of a given system. Its preparation, such as factors, is timed with it.
struct SystemRow {
  std::string name;
  std::function<uint32_t(std::span<double> solution)> solve;  ///< Returns the iterations.
  uint32_t iterationCount = 0;
  double relativeResidual = 0;
  std::vector<double> seconds = {}, cpuSeconds = {};
};

/// The harmonic system (no guidance, no prediction) of the seeds of a computation.
std::optional<PoissonSystem> harmonicSystem(Session& session, const Mesh& mesh, const std::string& seeds,
                                            const RunControl& control) {
  Options options;
  options.seeds = parseSeedCount(seeds);
  options.estimatesError = false;
  const Result result = session.compute(mesh, options, control);
  if (!mesh.polygons.isEmpty()) return {};  // The values are not those of the triangles.
  std::vector<double> values(mesh.faces.size(), kNoValue);
  for (size_t face = 0; face < values.size(); ++face)
    if (result.seed()[face] != 0) values[face] = result.sdf()[face];
  const DualGraph graph = buildDualGraph(mesh);
  return buildPoissonSystem(graph, arcWeights(ArcWeights::Feature, graph, computeFaceGeometry(mesh)), values, {});
}

/// Times our solvers and Eigen's on the system alone.
void compareOnSystem(const PoissonSystem& system, const Arguments& arguments, const RunControl& control) {
  using IncompleteCholesky = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  const EigenMatrix matrix = toEigen(system);
  const double tolerance = arguments.tolerance;
  const auto ours = [&](SolveSystem& solve) {
    return [&](std::span<double> solution) {
      return solve(system, {.tolerance = tolerance}, solution, control).iterations;
    };
  };
  std::vector<SystemRow> rows{
      {"eigen", ours(solveByEigen)},
      {"cpu", ours(solveByCpuCg)},
      {"Eigen CG, Jacobi",
       [&](auto solution) {
         return solveWithEigenCg<Eigen::DiagonalPreconditioner<double>>(matrix, system, tolerance, solution);
       }},
      {"Eigen CG, incomplete Cholesky",
       [&](auto solution) { return solveWithEigenCg<IncompleteCholesky>(matrix, system, tolerance, solution); }},
      {"Eigen SimplicialLDLT", [&](auto solution) { return solveWithEigenFactors(matrix, system, solution); }}};
  std::vector<double> solution(system.unknownCount());
  for (uint32_t round = 0; round <= arguments.runCount; ++round)
    for (SystemRow& row : rows) {
      control.checkpoint(0);
      const Timer wall(Clock::Wall), cpu(Clock::ProcessCpu);
      row.iterationCount = row.solve(solution);
      const double seconds = wall.seconds(), cpuSeconds = cpu.seconds();
      row.relativeResidual = relativeResidual(system, solution);
      if (round == 0) continue;  // Warm-up.
      row.seconds.push_back(seconds);
      row.cpuSeconds.push_back(cpuSeconds);
    }
  std::string text = fmt::format(
      "harmonic system of {} unknowns; the conversion to Eigen's matrix is not timed\n\n"
      "| solver | iterations | residual | seconds | CPU seconds of all threads | / eigen |\n"
      "|--------|-----------:|---------:|--------:|---------------------------:|--------:|\n",
      groupDigits(system.unknownCount()));
  for (const SystemRow& row : rows)
    text += fmt::format("| {} | {} | {:.2e} | {} | {} | {} |\n", row.name, row.iterationCount, row.relativeResidual,
                        toText(dispersionOf(row.seconds), 4), toText(dispersionOf(row.cpuSeconds), 4),
                        toText(ratioOf(row.cpuSeconds, rows[0].cpuSeconds), 2));
  writeOutput(text + "\n");
}

void run(const Arguments& arguments, const RunControl& control) {
  Session session(sessionOptionsOf("vulkan", arguments.device));
  const auto measure = [&](const std::string& name, const Mesh& mesh) {
    for (const std::string& seeds : arguments.seeds) {
      compareSolvers(session, name, mesh, seeds, arguments, control);
      if (!arguments.solvesSystem) continue;
      if (const auto system = harmonicSystem(session, mesh, seeds, control))
        compareOnSystem(*system, arguments, control);
    }
  };
  for (const std::string& mesh : arguments.meshes) measure(mesh, readMesh(mesh));
  if (arguments.meshes.empty()) measure("generated animal", makeAnimal(arguments.generatedFaceCount).mesh);
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-solvers", "Times the Poisson solvers on the same seeds, in turns.");
  Arguments arguments;
  program.addOptionalMeshes(arguments.meshes, "a generated animal");
  program.add("--faces", arguments.generatedFaceCount, "Faces of the generated animal", {kMinFaceCount, kMaxFaceCount});
  program.add("--runs", arguments.runCount, "Rounds, after one for warm-up", {1, 1000});
  program.add("--seeds", arguments.seeds, "Shares or counts");
  program.add("--tolerance", arguments.tolerance, "Relative residual");
  program.add("--bare", arguments.solvesSystem, "Also compare with Eigen's solvers on the system alone");
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
