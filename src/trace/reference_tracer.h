#pragma once

#include "trace/cone_tracer.h"
#include "trace/nearest_hit.h"

namespace asdfvk {

/// nearestHit() from any origin. Rays from an origin with a coordinate above 2^32 normalised units have no hit.
[[nodiscard]] RayHit nearestHitFromAnywhere(const TraceScene& scene, const Vec3d& origin, const Vec3d& direction,
                                            uint32_t skippedFace, double contactDistance);

/// The value of one cone, with the same bits as makeReferenceTracer(). Thread-safe. hits: empty, or one per ray.
double referenceCone(const TraceScene& scene, const Cone& cone, const ConeStart& start, std::span<ConeHit> hits = {});
/// The cone of a face. Precondition: the face is not degenerate.
double referenceCone(const TraceScene& scene, const Cone& cone, uint32_t seedFace, std::span<ConeHit> hits = {});

}  // namespace asdfvk
