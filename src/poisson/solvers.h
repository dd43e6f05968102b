#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "poisson/poisson_solver.h"

namespace asdfvk {

class Device;

/// A row of the table of solvers. make() throws Error{NoDeviceForKernel} for a null device where it needs one.
struct SolverRow {
  const char* name;
  bool needsDevice;
  std::unique_ptr<PoissonSolver> (*make)(const Device* device);
};

[[nodiscard]] std::span<const SolverRow> solverTable();

/// The solver of that name. Throws Error{UnknownName}, Error{NoDeviceForKernel}.
[[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(std::string_view name, const Device* device);

}  // namespace asdfvk
