#include "pipeline/interpolation.h"

#include <fmt/format.h>

#include "core/error.h"
#include "mesh/curvature.h"
#include "poisson/arc_weights.h"
#include "poisson/poisson_system.h"

namespace asdfvk {
namespace {

// The term -k curv of the ASDF paper, section 4.1; empty where k is 0.
std::vector<double> guidanceByCurvature(const Mesh& mesh, double guidance) {
  if (guidance == 0) return {};
  std::vector<double> divergence = faceCurvature(mesh);
  for (double& entry : divergence) entry *= -guidance;
  return divergence;
}

}  // namespace

SolverReport interpolate(const Mesh& mesh, const PreparedMesh& prepared, const Options& options,
                         ComputeBackend& backend, std::span<double> values, const RunControl& control,
                         std::vector<std::string>& warnings) {
  const PoissonSystem system =
      buildPoissonSystem(prepared.graph, arcWeights(ArcWeightKind::Distance, prepared.graph, prepared.geometry), values,
                         guidanceByCurvature(mesh, options.guidance));
  if (system.unknownCount() == 0) return {.name = "none"};
  std::vector<double> solution(system.unknownCount());
  const auto solveWith = [&](SolverChoice choice) {
    return backend.solver(choice).solve(system, options.solverOptions, solution, control);
  };
  SolverReport report;
  try {
    report = solveWith(options.solver);
  } catch (const Error& error) {
    if (options.solver != SolverChoice::Auto || error.kind() != ErrorKind::Device) throw;
    warnings.push_back(fmt::format("the CPU solved the equation, because on the device: {}", error.what()));
    report = solveWith(SolverChoice::Eigen);
  }
  for (size_t i = 0; i < solution.size(); ++i) values[system.faces[i]] = solution[i];
  return report;
}

}  // namespace asdfvk
