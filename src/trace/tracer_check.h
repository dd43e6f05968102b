#pragma once

#include <cstdint>
#include <span>

#include "cone/cone.h"
#include "trace/cone_tracer.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Comparison of a tracer with the reference on up to 64 faces of a scene.
struct TracerCheck {
  uint32_t comparedCount = 0;  ///< Faces with a value in one or both computations.
  /// Compared faces whose values differ by more than kAgreementTolerance bounding-box diagonals.
  uint32_t differingCount = 0;

  /// Whether the tracer is wrong. A few faces may differ, because rays graze edges.
  [[nodiscard]] bool isRefuted() const { return differingCount > 4 && 4 * differingCount > comparedCount; }
  /// Whether enough faces were compared to detect a wrong tracer.
  [[nodiscard]] bool isConclusive() const { return comparedCount >= 16; }
};

[[nodiscard]] TracerCheck checkTracer(ConeTracer& tracer, const TraceScene& scene, const Cone& cone);

/// Compares two arrays of equal size. Entries that are missing in both arrays are not compared.
[[nodiscard]] TracerCheck compareValues(std::span<const double> values, std::span<const double> expected,
                                        double diagonal);

}  // namespace asdfvk
