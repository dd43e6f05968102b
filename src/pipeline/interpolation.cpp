#include "pipeline/interpolation.h"

#include <fmt/format.h>

#include "core/error.h"
#include "mesh/curvature.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

SolverReport interpolate(const Mesh& mesh, const PreparedMesh& prepared, const Options& options,
                         ComputeBackend& backend, std::span<double> values, const RunControl& control,
                         std::vector<std::string>& warnings) {
  const std::vector<double> curvature = options.guidance != 0 ? faceCurvature(mesh) : std::vector<double>{};
  const PoissonSystem system =
      buildPoissonSystem(prepared.graph, prepared.geometry, values, curvature, options.guidance);
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
