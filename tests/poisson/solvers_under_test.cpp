#include "solvers_under_test.h"

namespace asdfvk {

std::vector<SolverUnderTest>& solversUnderTest() {
  static std::vector<SolverUnderTest> solvers = [] {
    std::vector<SolverUnderTest> made;
    made.push_back({"eigen", makeEigenSolver(), 1e-12});
    return made;
  }();
  return solvers;
}

}  // namespace asdfvk
