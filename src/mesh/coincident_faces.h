#pragma once

#include <cstdint>
#include <vector>

#include "mesh/edge_survey.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// For each face the lowest face with its corners at the same three points, in either winding, be they the same
/// vertices or copies of them (see coincidentVertices()); itself where there is no other. #F. Faces with two corners at
/// one point go by their vertices alone. Coincident faces lie at distance 0 of each other, where a hit is rounding
/// noise: they share one identity, so that a cone passes through its own face's copies and every backend sees the same
/// one of them.
[[nodiscard]] std::vector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh);

/// The same, faster where the edges rule copies out.
[[nodiscard]] std::vector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh, const EdgeSurvey& edges);

}  // namespace asdfvk
