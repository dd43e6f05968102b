#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/components.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Which components look the wrong way.
struct OrientationReport {
  std::vector<uint8_t> isCavity;             ///< #components; see findCavities().
  std::vector<uint32_t> invertedComponents;  ///< Ascending indices.

  /// One sentence that names the inverted components by their lowest input face and says how many hang together with
  /// it; empty when there is none.
  [[nodiscard]] std::string sentence(const TriangleMesh& mesh, const Components& components) const;
};

/// The rule of CGAL's orient_to_bound_a_volume: a closed component inside an even number of others bounds a solid and
/// looks outwards (positive volume), one inside an odd number is a cavity and looks inwards. Components that are open,
/// wound inconsistently or without volume are never inverted.
[[nodiscard]] OrientationReport analyseOrientation(const TriangleMesh& mesh, const Components& components);

/// Reverses the faces f with isFlipped[f] != 0 (#F): their winding, their normal, and the corners of their input
/// face, once for each input face, by the first of its triangles.
void flipFaces(Mesh& mesh, FaceGeometry& geometry, std::span<const uint8_t> isFlipped);

/// Turns over every face.
void flipAllFaces(Mesh& mesh, FaceGeometry& geometry, Components& components);

/// Turns over the faces of the inverted components and empties the report's list of them.
void orientOutward(Mesh& mesh, FaceGeometry& geometry, Components& components, OrientationReport& report);

}  // namespace asdfvk
