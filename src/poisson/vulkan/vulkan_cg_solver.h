#pragma once

#include <memory>

#include "poisson/poisson_solver.h"
#include "vk/device.h"

namespace asdfvk {

/// Jacobi-preconditioned conjugate gradients on the device, in float32 within an iterative refinement in double; the
/// scalars never leave the device, the host looks at them every few iterations. Where float32 does not get there,
/// Eigen's in double carry on, on the CPU. Its kernels are made here, once for many meshes. The device must outlive the
/// solver. solve() throws Error{Device} for a system that the device's limits refuse.
[[nodiscard]] std::unique_ptr<PoissonSolver> makeVulkanCgSolver(const Device& device);

}  // namespace asdfvk
