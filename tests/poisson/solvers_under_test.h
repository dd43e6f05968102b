#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "poisson/poisson_solver.h"

namespace asdfvk {

struct SolverUnderTest {
  std::string name;
  std::unique_ptr<PoissonSolver> solver;
  double tightestTolerance;  ///< What it is asked for where a test wants the solution itself.
};

/// Every solver that this machine can run; says so with a message where there is no Vulkan device.
[[nodiscard]] std::vector<SolverUnderTest>& solversUnderTest();

}  // namespace asdfvk
