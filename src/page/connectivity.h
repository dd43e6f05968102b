#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// The symbols of a walk over the faces of a mesh; docs/page.md defines their meaning.
enum class WalkSymbol : uint8_t { New, Next, Previous, Both, Gate, Old, Closed, Start, Alone };

/// The faces and vertices of a mesh in the order of a walk from face to face over shared edges, and the symbols from
/// which a page rebuilds both. Related to Edgebreaker (Rossignac 1999) and the cut-border machine (Gumhold and Strasser
/// 1998); gates are a linked list, so that any triangles, non-manifold ones included, are coded without preparation.
struct Connectivity {
  std::vector<uint32_t> faces;     ///< #F: face of the mesh by its place in the page.
  std::vector<uint32_t> vertices;  ///< Vertex of the mesh by its place in the page; only those of faces.
  /// Per vertex of the page: the gate it was found behind, as two vertices and the third one of the face in front of
  /// it; kNone where there is none. These are places in the page, below that of the vertex.
  std::vector<std::array<uint32_t, 3>> frontOf;
  /// Per face of the page: two faces before it that share an edge with it, or twice the same; for a face without one,
  /// the face before it; kNone for the first face.
  std::vector<std::array<uint32_t, 2>> neighboursOf;
  std::vector<uint8_t> symbols;     ///< Two per byte, the first in the low bits.
  std::vector<uint8_t> references;  ///< LEB128 numbers.
  uint32_t gateCount = 0;
};

/// Precondition: every index of a face is below the vertex count. Faces with a corner that is not finite keep one of
/// their vertices only.
[[nodiscard]] Connectivity encodeConnectivity(const TriangleMesh& mesh);

}  // namespace asdfvk
