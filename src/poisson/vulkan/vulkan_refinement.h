#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/run_control.h"
#include "poisson/poisson_solver.h"
#include "poisson/poisson_system.h"
#include "poisson/solver_progress.h"
#include "poisson/vulkan/vulkan_matrix.h"

namespace asdfvk {

/// One pass of refinement on the device: solve the scaled system for a right-hand side of weighted norm 1.
struct DevicePass {
  const VulkanMatrix& matrix;
  std::span<const float> rightHandSide;  ///< #U
  double residualNorm;                   ///< What norm 1 stands for.
  double reduction;                      ///< Of that norm, which is enough.
  uint32_t maxIterations;
  SolverProgress& progress;
};

struct DevicePassResult {
  std::vector<float> solution;  ///< #U
  uint32_t iterationCount = 0;
};

using DeviceSolver = std::function<DevicePassResult(const DevicePass& pass)>;

struct DeviceMethod {
  std::string name;           ///< For the report.
  double strongestReduction;  ///< See Corrector.
  bool cpuFinishes;           ///< Where its float32 no longer helps, makeDoubleCorrector() continues.
  DeviceSolver solver;
};

/// solveByRefinement() whose passes run in float32 on the device; the matrix is uploaded when the first one needs it.
[[nodiscard]] SolverReport solveOnDevice(const DeviceMethod& method, const Device& device, const PoissonSystem& system,
                                         const SolverOptions& options, std::span<double> solution,
                                         const RunControl& control);

}  // namespace asdfvk
