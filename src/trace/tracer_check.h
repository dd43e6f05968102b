#pragma once

#include <cstdint>
#include <span>

#include "cone/cone.h"
#include "trace/cone_tracer.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Comparison of a tracer with the reference on up to 64 faces of a scene.
struct TracerCheck {
  uint32_t comparedCount = 0;   ///< Faces with a value in one or both computations.
  uint32_t differingCount = 0;  ///< Compared faces that differ by more than kAgreementTolerance bounding-box diagonals.

  /// Whether so many faces differ that the tracer is wrong: rays that graze edges make few of them differ.
  [[nodiscard]] bool isRefuted() const { return differingCount > 4 && 4 * differingCount > comparedCount; }
  /// Whether the faces suffice to refute a tracer.
  [[nodiscard]] bool isConclusive() const { return comparedCount >= 16; }
};

[[nodiscard]] TracerCheck checkTracer(ConeTracer& tracer, const TraceScene& scene, const Cone& cone);

/// Counts values, of equal arrays, that differ by more than kAgreementTolerance of the diagonal; those missing on both
/// sides are not compared.
[[nodiscard]] TracerCheck compareValues(std::span<const double> values, std::span<const double> expected,
                                        double diagonal);

}  // namespace asdfvk
