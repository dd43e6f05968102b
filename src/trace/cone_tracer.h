#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bvh/bvh.h"
#include "cone/cone.h"
#include "core/run_control.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// What cones are traced against. Views only: everything must outlive the tracer.
struct TraceScene {
  const Mesh& mesh;
  const FaceGeometry& geometry;
  std::span<const uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  const Bvh& bvh;
};

struct TraceStatistics {
  uint64_t rayCount = 0;
  uint64_t redoneConeCount =
      0;  ///< Cones that the reference traced instead of a device: beyond its iterations or float32.
};

/// A way to trace cones. All of them share one accept rule: the nearest hit that is not on the seed face itself or a
/// copy of it; dropped when that hit's face looks along the seed's normal (angle below 90 degrees, see
/// Cone::falseHitCosine) or nothing is hit.
class ConeTracer {
 public:
  virtual ~ConeTracer() = default;

  /// values[i] becomes the shape diameter at seedFaces[i] in the mesh's unit, or kNoValue when no ray of its cone is
  /// valid. Precondition: no seed face is degenerate. Throws Error{Cancelled} between chunks, Error{Device}.
  virtual TraceStatistics trace(std::span<const uint32_t> seedFaces, std::span<double> values,
                                const RunControl& control) = 0;
};

}  // namespace asdfvk
