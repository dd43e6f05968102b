#pragma once

#include "core/buckets.h"
#include "predict/seed_cells.h"
#include "predict/traced_cones.h"

namespace asdfvk {

/// Per cell: the seeds of other cells whose rays ended in it and were kept, ascending, each once. A ray works both
/// ways: faces of the cell see the seed that it came from.
[[nodiscard]] Buckets<uint32_t> landedSeeds(const Cone& cone, const TraceScene& scene, const TracedCones& traced,
                                            const SeedCells& cells);

}  // namespace asdfvk
