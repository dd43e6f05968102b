#pragma once

#include <memory>
#include <string>

#include "trace/cone_tracer.h"

namespace asdfvk {

/// Whether this build has Embree, which is optional.
[[nodiscard]] bool hasEmbree();

/// Throws Error{Device} with the remedy where there is none.
void requireEmbree();

/// "Embree 3.13.5", the library that is loaded; empty without Embree.
[[nodiscard]] std::string embreeName();

/// Traces with Embree (Wald et al. 2014) on all cores of the CPU, in float32; the lengths of hits are computed anew in
/// double. Values do not depend on the number of threads. Cones too small for float32 are traced by the reference. The
/// scene and the cone must outlive the tracer. Throws Error{Device} when Embree fails or this build has none.
[[nodiscard]] std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene& scene, const Cone& cone);

}  // namespace asdfvk
