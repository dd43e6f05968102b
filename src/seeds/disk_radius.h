#pragma once

#include <cstdint>
#include <span>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// An estimate of the radius at which Poisson disks fill the candidates' part of the graph with about `count` centres,
/// of which none lies in the disk of another: the root mean square, over some random candidates, of the radius of the
/// disk around them that holds as many faces as a disk does then. For disks in the plane these are 2.2 times the faces
/// per centre: maximal random packings of disks of half the radius cover 0.55 of it.
/// arcLengths: aligned with graph.neighbours. Takes about the time of going over the graph once. At least one candidate
/// and a count of at least 1. Positive.
[[nodiscard]] float estimateDiskRadius(const DualGraph& graph, std::span<const float> arcLengths,
                                       std::span<const uint32_t> candidates, uint64_t count, uint64_t randomSeed);

}  // namespace asdfvk
