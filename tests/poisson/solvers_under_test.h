#pragma once

#include <memory>
#include <string>
#include <vector>

#include "poisson/poisson_solver.h"
#include "support/test_device.h"

namespace asdfvk {

struct SolverUnderTest {
  std::string name;
  std::unique_ptr<PoissonSolver> solver;
  double tightestTolerance;  ///< What it is asked for where a test wants the solution itself.
};

/// Every solver, those on the device under validation. Made anew for each test, whose end hears what the layers said.
class SolversUnderTest {
 public:
  SolversUnderTest();

  [[nodiscard]] auto begin() { return solvers_.begin(); }
  [[nodiscard]] auto end() { return solvers_.end(); }

 private:
  test::ValidatedDevice device_;
  std::vector<SolverUnderTest> solvers_;
};

}  // namespace asdfvk
