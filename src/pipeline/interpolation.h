#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/asdf.h"
#include "pipeline/compute_backend.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// Fills the faces without a value from the Poisson equation. values: #F; faces of components without any value keep
/// none. Returns what the solver reports; its name is "none" when there was nothing to solve. Where the choice of
/// solver is open and the device fails or is too small, Eigen solves instead and `warnings` says why.
[[nodiscard]] SolverReport interpolate(const Mesh& mesh, const PreparedMesh& prepared, const Options& options,
                                       ComputeBackend& backend, std::span<double> values, const RunControl& control,
                                       std::vector<std::string>& warnings);

}  // namespace asdfvk
