#include "pipeline/interpolation.h"

#include <vector>

#include "mesh/curvature.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

SolverReport interpolate(const Mesh& mesh, const PreparedMesh& prepared, const Options& options,
                         ComputeBackend& backend, std::span<double> values, const RunControl& control) {
  const std::vector<double> curvature = options.guidance != 0 ? faceCurvature(mesh) : std::vector<double>{};
  const PoissonSystem system =
      buildPoissonSystem(prepared.graph, prepared.geometry, values, curvature, options.guidance);
  if (system.unknownCount() == 0) return {.name = "none"};
  std::vector<double> solution(system.unknownCount());
  SolverReport report = backend.solver(options.solver).solve(system, options.solverOptions, solution, control);
  for (size_t i = 0; i < solution.size(); ++i) values[system.faces[i]] = solution[i];
  return report;
}

}  // namespace asdfvk
