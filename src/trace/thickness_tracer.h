#pragma once

#include <cstdint>
#include <span>

#include "trace/cone_tracer.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Sets thickness[i] to the thickness of hits.seeds[i] in the mesh's unit (cone/thickness.h). The first ball touches
/// the opposing wall among the hits of the face's rays that gives the least diameter, length / cos t with the angle t
/// to the axis. Where no hit is on an opposing wall, a ray along the axis is cast by the reference; so the rim of a
/// plate has a thickness. Where that ray hits no opposing wall either, the thickness is the least length / cos t of all
/// valid hits (see isFalseHit()), without shrinking, and kNoValue without a valid hit. The same bits on any number of
/// threads.
ThicknessStatistics measureThickness(const TraceScene& scene, const Cone& cone, const OpposingWalls& walls,
                                     const SeedHits& hits, BallShrinker& shrinker, std::span<double> thickness,
                                     const RunControl& control);

}  // namespace asdfvk
