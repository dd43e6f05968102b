#pragma once

#include "pipeline/asdf.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/seed_tracing.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// What was computed and has to be judged. Views only.
struct ComputedValues {
  const TracedSeeds& traced;
  std::span<const double> values;  ///< #F, the final ones.
  bool tracedByReference = false;
};

/// Recomputes up to `count` random traced faces, and up to `count` random ones of all faces that can cast rays, with
/// the double-precision reference and compares. A face in both choices is traced once.
[[nodiscard]] CheckReport checkAgainstReference(const TriangleMesh& mesh, const PreparedMesh& prepared,
                                                const TraceScene& scene, const Cone& cone,
                                                const ComputedValues& computed, uint64_t count, uint64_t randomSeed,
                                                const RunControl& control);

}  // namespace asdfvk
