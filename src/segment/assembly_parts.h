#pragma once

#include "segment/parts.h"

namespace asdfvk {

/// Parts of an assembly, a file that states its parts: each component of at least kMinPartArea is divided as if it were
/// alone, and each smaller one is a part. Numbered by ascending mean value, agreement the mean by area. Throws as
/// segmentIntoParts(). Precondition: options.partCount is unset.
[[nodiscard]] Parts segmentAssembly(const PartsInput& input, const PartsOptions& options, const LineOfSight& sight,
                                    const RunControl& control = {});

}  // namespace asdfvk
