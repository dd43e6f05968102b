#pragma once

#include "asdf_vk/session.h"
#include "pipeline/computation.h"
#include "pipeline/judged_surface.h"
#include "pipeline/prepared_scene.h"

namespace asdfvk {

/// Measures the thickness and the gaps that the options request, with their fields and reports. scene: that of the
/// computation. former: the surface of a former version for a comparison, or null. Throws Error{Cancelled}.
void measureSurfaces(Result& result, const Computation& computation, const PreparedScene& scene,
                     const JudgedSurface* former, const RunControl& control);

}  // namespace asdfvk
