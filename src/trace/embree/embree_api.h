#pragma once

// Embree 3 or 4, as CMake found it. The only file that depends on the version.
#if ASDFVK_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

// Ray queries. Embree 3 takes their flags in a context, Embree 4 in arguments. The flag `incoherent` is set: Embree
// traverses for each ray alone.
namespace asdfvk {

/// Nearest hit of a ray.
inline void intersect1(RTCScene scene, RTCRayHit& query) {
#if ASDFVK_EMBREE_VERSION >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect1(scene, &query, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect1(scene, &context, &query);
#endif
}

/// Nearest hits of eight rays; isActive: eight numbers, -1 or 0.
inline void intersect8(RTCScene scene, const int* isActive, RTCRayHit8& queries) {
#if ASDFVK_EMBREE_VERSION >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect8(isActive, scene, &queries, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect8(isActive, scene, &context, &queries);
#endif
}

/// Whether anything is between `ray.tnear` and `ray.tfar`.
[[nodiscard]] inline bool isOccluded(RTCScene scene, RTCRay ray) {
#if ASDFVK_EMBREE_VERSION >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcOccluded1(scene, &ray, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded1(scene, &context, &ray);
#endif
  return ray.tfar < 0;  // Minus infinity after a hit.
}

}  // namespace asdfvk
