#pragma once

#include <cstdint>
#include <span>

#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "trace/cone_tracer.h"
#include "trace/seeds.h"

namespace asdfvk {

/// Views of a computed result.
struct ComputedValues {
  const Seeds& seeds;               ///< Its nodes are faces.
  std::span<const uint8_t> isSeed;  ///< #F
  std::span<const double> values;   ///< #F, final.
  bool tracedByReference = false;
};

/// Compares values with the values of the double-precision reference. The compared faces are up to `count` random
/// traced faces, and up to `count` random faces of all faces that can cast rays. A face that is in both samples is
/// traced once. traceableFaces: ascending.
[[nodiscard]] CheckReport checkAgainstReference(const TraceScene& scene, const Cone& cone,
                                                std::span<const uint32_t> traceableFaces,
                                                const ComputedValues& computed, uint64_t count, uint64_t randomSeed,
                                                const RunControl& control);

}  // namespace asdfvk
