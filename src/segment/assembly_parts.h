#pragma once

#include "segment/parts.h"

namespace asdfvk {

/// Segments an assembly. An assembly is a file that states the number of its parts. Each component of at least
/// kMinPartArea is divided separately; each smaller component is one part. Parts are numbered by ascending mean value.
/// Parts::agreement is the mean over the divided components, weighted by area. Throws the errors of segmentIntoParts().
/// Precondition: options.partCount is unset.
[[nodiscard]] Parts segmentAssembly(const PartsInput& input, const PartsOptions& options, const LineOfSight& sight,
                                    const RunControl& control = {});

}  // namespace asdfvk
