#pragma once

#include <cstdint>

#include "asdf_vk/session.h"
#include "pipeline/body_names.h"
#include "pipeline/computation.h"
#include "pipeline/judged_surface.h"
#include "pipeline/thickness.h"

namespace asdfvk {

/// Area of the computed faces.
[[nodiscard]] double computedArea(const Computation& computation);

/// Percentiles and, with a limit, the verdict and the thin regions. thin: receives the thin parts, with indices of
/// regions from firstRegion on.
[[nodiscard]] ThicknessReport describeThickness(const Computation& computation, const JudgedSurface& surface,
                                                const FaceThickness& thickness, const BodyNames& names,
                                                uint32_t firstRegion, ThinSurface& thin);

}  // namespace asdfvk
