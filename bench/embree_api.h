#pragma once

// Includes Embree 3 or 4, whichever CMake found. No other file depends on the version.
#if ASDFVK_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/// Ray queries. intersect1() finds the nearest hit of one ray. intersect8() finds the nearest hits of eight rays;
/// isActive has -1 for each ray to trace, else 0. In Embree 3 the flags of a query are in a context, in Embree 4 in
/// arguments. With the flag `incoherent`, Embree traverses the hierarchy for each ray separately.
namespace asdfvk {

#if ASDFVK_EMBREE_VERSION >= 4

template <typename Arguments>
[[nodiscard]] Arguments incoherentArguments(void (*initialize)(Arguments*)) {
  Arguments arguments;
  initialize(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  return arguments;
}

inline void intersect1(RTCScene scene, RTCRayHit& query) {
  RTCIntersectArguments arguments = incoherentArguments(rtcInitIntersectArguments);
  rtcIntersect1(scene, &query, &arguments);
}

inline void intersect8(RTCScene scene, const int* isActive, RTCRayHit8& queries) {
  RTCIntersectArguments arguments = incoherentArguments(rtcInitIntersectArguments);
  rtcIntersect8(isActive, scene, &queries, &arguments);
}

inline void occluded1(RTCScene scene, RTCRay& ray) {
  RTCOccludedArguments arguments = incoherentArguments(rtcInitOccludedArguments);
  rtcOccluded1(scene, &ray, &arguments);
}

#else

[[nodiscard]] inline RTCIntersectContext incoherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

inline void intersect1(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context = incoherentContext();
  rtcIntersect1(scene, &context, &query);
}

inline void intersect8(RTCScene scene, const int* isActive, RTCRayHit8& queries) {
  RTCIntersectContext context = incoherentContext();
  rtcIntersect8(isActive, scene, &context, &queries);
}

inline void occluded1(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context = incoherentContext();
  rtcOccluded1(scene, &context, &ray);
}

#endif

/// Whether the ray hits anything between `ray.tnear` and `ray.tfar`.
[[nodiscard]] inline bool isOccluded(RTCScene scene, RTCRay ray) {
  occluded1(scene, ray);
  return ray.tfar < 0;  // After a hit, Embree sets tfar to minus infinity.
}

}  // namespace asdfvk
