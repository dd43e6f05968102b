#pragma once

#include <cstdint>
#include <vector>

#include "mesh/edge_survey.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// For each face the lowest face with its corners at the same three points, in either winding, with the same vertices
/// or with copies of them (see coincidentVertices()); the face itself where there is no other. #F. Faces with two
/// corners at one point are compared by their vertices. Coincident faces are at distance 0 of each other, where hits
/// are rounding noise. They share one identity: a cone ignores the copies of its own face, and every backend reports
/// the same copy.
[[nodiscard]] std::vector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh);

/// The same; faster where the edges exclude copies.
[[nodiscard]] std::vector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh, const EdgeSurvey& edges);

}  // namespace asdfvk
