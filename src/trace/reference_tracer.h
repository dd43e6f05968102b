#pragma once

#include <memory>

#include "trace/cone_tracer.h"

namespace asdfvk {

/// The tracer that the others are judged by: double precision, watertight, on all cores of the CPU; values do not
/// depend on their number.
[[nodiscard]] std::unique_ptr<ConeTracer> makeReferenceTracer(const TraceScene& scene, const Cone& cone);

/// Length in the mesh's unit of a ray that obeys the cone's rules, or kNoValue when it is dropped: nothing was hit, or
/// a face that looks along the seed's normal. Precondition: the seed face is not degenerate.
[[nodiscard]] double referenceRayLength(const TraceScene& scene, const Cone& cone, const Vec3d& direction,
                                        uint32_t seedFace);

/// The value of one cone, exactly as makeReferenceTracer()'s tracer gives it; safe to call from any thread. hits:
/// empty, or one per ray.
double referenceCone(const TraceScene& scene, const Cone& cone, uint32_t seedFace, std::span<ConeHit> hits = {});

}  // namespace asdfvk
