#pragma once

#include "pipeline/asdf.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/seed_tracing.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Recomputes `count` random faces, or all that can cast rays, with the double-precision reference and compares.
/// values: #F, the final ones.
[[nodiscard]] CheckReport checkAgainstReference(const Mesh& mesh, const PreparedMesh& prepared, const TraceScene& scene,
                                                const Cone& cone, const TracedSeeds& traced,
                                                std::span<const double> values, uint64_t count, uint64_t randomSeed,
                                                const RunControl& control);

}  // namespace asdfvk
