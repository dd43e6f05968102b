#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

template <typename T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr T operator[](size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T& operator[](size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr bool operator==(const Vec3&) const = default;

  template <typename U>
  constexpr explicit operator Vec3<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};
using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

/// Three vertex indices, counter-clockwise seen from outside.
using Face = std::array<uint32_t, 3>;

/// Marks a face without a value: a quiet NaN.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The input faces of a mesh that has faces other than triangles. Input face i has the corners corners[firstCorner[i]]
/// .. corners[firstCorner[i + 1] - 1], in file order. A face may have fewer than three corners.
struct Polygons {
  std::vector<uint64_t> firstCorner;  ///< #I+1 indices into `corners`. Empty: every input face is one triangle.
  std::vector<uint32_t> corners;      ///< Vertex indices.
  std::vector<uint32_t> inputFaceOf;  ///< #F. The input face of each triangle, in non-decreasing order.

  [[nodiscard]] bool isEmpty() const { return firstCorner.empty(); }
};

/// An object of a file, for example a solid or a node.
struct NamedFaces {
  uint64_t firstFace = 0;  ///< Index of an input face.
  std::string name;        ///< Valid UTF-8 on one line; at most 200 bytes. Empty if the faces have no name.

  bool operator==(const NamedFaces&) const = default;
};

/// A triangle mesh in plain arrays. readMesh() returns all faces of the file, in file order.
struct Mesh {
  std::vector<Vec3d> vertices;  ///< #V, in the unit of the file. Coordinates may be non-finite (Report::defects).
  std::vector<Face> faces;      ///< #F triangles.
  Polygons polygons;            ///< Empty if every input face is a triangle.
  /// Unit of length that a 3MF, glTF or STEP file states: "um", "mm", "cm", "m", "in" or "ft"; empty if the file states
  /// no unit.
  std::string unit = {};
  /// Number of mesh instances in a 3MF or glTF file, or of placed bodies in a STEP file; 0 for other formats. Instances
  /// share no vertices.
  uint32_t statedPartCount = 0;
  /// Greatest distance between the faces and the curved surfaces that a STEP file has (ReadOptions::chordError), in the
  /// unit of the mesh; 0 for formats whose files have the faces themselves.
  double chordError = 0;
  /// Contents of the file that are not part of the surface and were left out, for example "12 points".
  std::vector<std::string> skipped = {};
  /// Number of negative volumes of a 3MF file, which its program subtracts from the other parts, and of parts of
  /// unknown types, which may be negative volumes. They are not part of the mesh, so that the thickness of its walls is
  /// not known.
  uint32_t negativeVolumeCount = 0;
  /// The greatest step of neighbouring float32 values at the coordinates of the parts of the file, in the unit of the
  /// mesh: transforms change coordinates, but not the steps that they were rounded to. 0: not float32, or no parts.
  double float32Step = 0;
  /// The objects that the file names, in file order: an object has the input faces from `firstFace` to the first face
  /// of the next object. Each object has a face. Consecutive objects have different names. Empty if the file names none
  /// (docs/formats.md#names-of-objects).
  std::vector<NamedFaces> objects = {};

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(faces.size()); }
  /// #I: the number of faces in the file.
  [[nodiscard]] uint64_t inputFaceCount() const {
    return polygons.isEmpty() ? faces.size() : polygons.firstCorner.size() - 1;
  }
};

/// The name of the object that has the input face; empty if the file does not name it. Views an element of `objects`.
[[nodiscard]] inline std::string_view objectNameOf(std::span<const NamedFaces> objects, uint64_t inputFace) {
  const auto next = std::upper_bound(objects.begin(), objects.end(), inputFace,
                                     [](uint64_t face, const NamedFaces& object) { return face < object.firstFace; });
  return next == objects.begin() ? std::string_view() : std::string_view(std::prev(next)->name);
}

/// View of the caller's arrays, which must outlive the view. The library uses double positions and triangles in place.
/// The library converts float positions to double (24 bytes per vertex) and triangulates polygons (about 16 bytes per
/// corner). The faces of the view are the input faces: a field has one value per input face.
class MeshView {
 public:
  MeshView(const Mesh& mesh);  // NOLINT: implicit by design
  /// positions: 3 #V numbers, x y z per vertex. triangles: 3 #F vertex indices.
  MeshView(std::span<const double> positions, std::span<const uint32_t> triangles)
      : doubles_(positions), corners_(triangles) {}
  MeshView(std::span<const float> positions, std::span<const uint32_t> triangles)
      : floats_(positions), corners_(triangles) {}
  /// Input face i has the corners corners[firstCorner[i]] .. corners[firstCorner[i + 1] - 1]. firstCorner: #I+1,
  /// ascending from 0 to corners.size(). Empty: each three consecutive corners are a triangle.
  MeshView(std::span<const double> positions, std::span<const uint32_t> corners, std::span<const uint64_t> firstCorner)
      : doubles_(positions), corners_(corners), firstCorner_(firstCorner) {}
  MeshView(std::span<const float> positions, std::span<const uint32_t> corners, std::span<const uint64_t> firstCorner)
      : floats_(positions), corners_(corners), firstCorner_(firstCorner) {}

  [[nodiscard]] size_t vertexCount() const { return (doubles_.size() + floats_.size()) / 3; }
  [[nodiscard]] uint64_t inputFaceCount() const {
    return firstCorner_.empty() ? corners_.size() / 3 : firstCorner_.size() - 1;
  }
  [[nodiscard]] std::span<const double> doubles() const { return doubles_; }  ///< Empty for float positions.
  [[nodiscard]] std::span<const float> floats() const { return floats_; }     ///< Empty for double positions.
  [[nodiscard]] std::span<const uint32_t> corners() const { return corners_; }
  [[nodiscard]] std::span<const uint64_t> firstCorner() const { return firstCorner_; }  ///< Empty for triangles.
  /// The viewed Mesh, whose triangulation the library reuses; null for a view of arrays.
  [[nodiscard]] const Mesh* mesh() const { return mesh_; }

 private:
  std::span<const double> doubles_;
  std::span<const float> floats_;
  std::span<const uint32_t> corners_;
  std::span<const uint64_t> firstCorner_;
  const Mesh* mesh_ = nullptr;
};

inline MeshView::MeshView(const Mesh& mesh)
    : doubles_(mesh.vertices.empty() ? nullptr : &mesh.vertices.front().x, 3 * mesh.vertices.size()),
      corners_(mesh.polygons.isEmpty()
                   ? std::span<const uint32_t>(mesh.faces.empty() ? nullptr : mesh.faces.front().data(),
                                               3 * mesh.faces.size())
                   : std::span<const uint32_t>(mesh.polygons.corners)),
      firstCorner_(mesh.polygons.firstCorner),
      mesh_(&mesh) {}

}  // namespace asdfvk
