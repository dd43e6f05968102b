#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// A closed, manifold triangle mesh, oriented outwards, with the part and diameter of each face.
struct GeneratedShape {
  Mesh mesh;
  std::vector<uint32_t> part;  ///< #F, part of each face; all 0 for a shape with one part.
  /// #F, true local diameter of the shape at the face, in the unit of the mesh; 0: unknown.
  std::vector<float> diameter;
};

/// Range of requested face counts. The count of a result is within about 15 % of the requested count. Below some
/// hundred faces, the result has the closest count that the shape allows.
inline constexpr uint64_t kMinFaceCount = 20;
inline constexpr uint64_t kMaxFaceCount = 50'000'000;

/// Gives every face part 0 and the same diameter.
[[nodiscard]] GeneratedShape withUniformDiameter(Mesh mesh, double diameter);

/// Writes a binary little-endian PLY file, atomically. Vertices are float or double; the properties of faces are `list
/// uchar int vertex_indices`, `float diameter` and `int part`. "-" is standard output. Throws Error{Output}.
void writeGeneratedPly(const std::filesystem::path& path, const GeneratedShape& shape, bool doubleVertices);

}  // namespace asdfvk
