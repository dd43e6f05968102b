#include "asdf_vk/options.h"

#include "poisson/poisson_solver.h"
#include "seeds/samplers.h"

namespace asdfvk {

std::vector<std::string> solverNames() {
  std::vector<std::string> names{kAutomaticSolver};
  for (const Solver& solver : solverTable()) names.emplace_back(solver.name);
  return names;
}

std::vector<std::string> samplerNames() {
  std::vector<std::string> names;
  for (const Sampler& sampler : kSamplers) names.emplace_back(sampler.name);
  return names;
}

}  // namespace asdfvk
