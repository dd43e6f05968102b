#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/components.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Components whose faces have the wrong orientation.
struct OrientationReport {
  std::vector<uint8_t> isCavity;             ///< #components; see findCavities().
  std::vector<uint32_t> invertedComponents;  ///< Ascending indices.

  /// One sentence that counts the inverted components. It names the first five, each by its lowest input face and the
  /// number of faces connected to this face. Empty if there is no inverted component.
  [[nodiscard]] std::string sentence(const TriangleMesh& mesh, const Components& components) const;
};

/// Finds inverted components by the rule of CGAL's orient_to_bound_a_volume. A closed component inside an even number
/// of other components bounds a solid and should have a positive volume. A closed component inside an odd number of
/// others is a cavity and should have a negative volume. Components that are open, inconsistently wound or without
/// volume are never inverted.
[[nodiscard]] OrientationReport analyseOrientation(const TriangleMesh& mesh, const Components& components);

/// Reverses the winding of the triangles f with isFlipped[f] != 0 (#F), and the winding of each input face that
/// contains such a triangle. The first corner of each face stays the first.
void flipFaces(Mesh& mesh, std::span<const uint8_t> isFlipped);
/// Like flipFaces(mesh, isFlipped). In addition, reverses the normal of each triangle f with isFlipped[f] != 0.
void flipFaces(Mesh& mesh, FaceGeometry& geometry, std::span<const uint8_t> isFlipped);
/// Reverses all triangles of the given input faces. Precondition: the indices ascend.
void flipInputFaces(Mesh& mesh, std::span<const uint64_t> inputFaces);

/// Reverses every face.
void flipAllFaces(Mesh& mesh, FaceGeometry& geometry, Components& components);

/// Reverses the faces of the inverted components, and clears OrientationReport::invertedComponents.
void orientOutward(Mesh& mesh, FaceGeometry& geometry, Components& components, OrientationReport& report);

}  // namespace asdfvk
