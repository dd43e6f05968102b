#pragma once

#include <memory>

#include "poisson/poisson_solver.h"
#include "vk/device.h"

namespace asdfvk {

/// The Jacobi iteration on the device, for comparison: slow by design. Otherwise as makeVulkanCgSolver().
[[nodiscard]] std::unique_ptr<PoissonSolver> makeVulkanJacobiSolver(const Device& device);

}  // namespace asdfvk
