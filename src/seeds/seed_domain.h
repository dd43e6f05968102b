#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// Where seeds are chosen. What it refers to must outlive it.
struct SeedDomain {
  const DualGraph& graph;
  const FaceGeometry& geometry;
  std::span<const uint32_t> candidates;  ///< Faces that can cast rays, ascending, each once.
};

/// The candidates that are not among `existing` (faces in any order), ascending. Throws CheckFailure for an existing
/// face that the graph has not.
[[nodiscard]] std::vector<uint32_t> unchosenCandidates(const SeedDomain& domain, std::span<const uint32_t> existing);

}  // namespace asdfvk
