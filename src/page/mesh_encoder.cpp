#include "page/mesh_encoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/json.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNone = 0xffffffff;

constexpr double kGridSize = 65535;

/// Number of low bits of a float32 that a page omits. The relative error of 2^-15 is small enough for the four digits
/// that a page shows.
constexpr int kDroppedBits = 9;

/// Coordinates as whole numbers of steps from the lower corner of a box.
struct Grid {
  Box3d box;
  double step = 0;

  explicit Grid(const Box3d& gridBox) : box(gridBox) {
    const Vec3d size = box.size();
    step = std::max({size.x, size.y, size.z}) / kGridSize;
  }

  [[nodiscard]] uint32_t stepsOf(double coordinate, size_t axis) const {
    if (!(step > 0) || !std::isfinite(coordinate)) return 0;
    // The coordinates are halved, because the difference of two finite coordinates may overflow.
    const double steps = std::round((coordinate * 0.5 - box.min[axis] * 0.5) / (step * 0.5));
    return static_cast<uint32_t>(std::clamp(steps, 0.0, kGridSize));
  }
};

/// All faces in the order of a depth-first walk over shared edges, so that the differences in the arrays are small.
std::vector<uint32_t> walkedFaces(const TriangleMesh& mesh) {
  const DualGraph graph = buildDualGraph(mesh);
  std::vector<uint32_t> faces, stack;
  faces.reserve(mesh.faces.size());
  std::vector<uint8_t> isWalked(mesh.faces.size(), 0);
  for (uint32_t first = 0; first < mesh.faceCount(); ++first) {
    stack.push_back(first);
    while (!stack.empty()) {
      const uint32_t face = stack.back();
      stack.pop_back();
      if (isWalked[face] != 0) continue;
      isWalked[face] = 1;
      faces.push_back(face);
      for (const uint32_t neighbour : graph.neighboursOf(face))
        if (isWalked[neighbour] == 0) stack.push_back(neighbour);
    }
  }
  return faces;
}

/// Order of faces and vertices in the page.
struct Layout {
  std::vector<uint32_t> faces;
  std::vector<uint32_t> vertices;  ///< Vertices of faces, in the order of their first use.
  /// For each corner: index of its vertex in `vertices` minus the count of preceding vertices; 0 for a new vertex.
  std::vector<int32_t> corners;

  explicit Layout(const TriangleMesh& mesh) : faces(walkedFaces(mesh)) {
    std::vector<uint32_t> placeOf(mesh.vertices.size(), kNone);
    corners.reserve(3 * faces.size());
    for (const uint32_t face : faces) {
      Face vertexOf = mesh.faces[face];
      if (!mesh.hasFiniteCorners(face)) vertexOf = {vertexOf[0], vertexOf[0], vertexOf[0]};
      for (const uint32_t vertex : vertexOf) {
        const auto count = static_cast<uint32_t>(vertices.size());
        if (placeOf[vertex] == kNone) {
          placeOf[vertex] = count;
          vertices.push_back(vertex);
        }
        corners.push_back(static_cast<int32_t>(placeOf[vertex] - count));
      }
    }
  }
};

/// The differences of consecutive numbers modulo 2^32, beginning with the first number.
template <typename NumberAt>
std::vector<int32_t> differencesOf(size_t count, const NumberAt& numberAt) {
  std::vector<int32_t> differences(count);
  uint32_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t number = numberAt(i);
    differences[i] = static_cast<int32_t>(number - last);
    last = number;
  }
  return differences;
}

/// The upper bits of the value as float32, rounded; the bits of NaN if the value is not finite.
uint32_t upperBitsOf(double value) {
  constexpr uint32_t kNanBits = 0x7fc00000, kExponentBits = 0x7f800000;
  if (!std::isfinite(value)) return kNanBits >> kDroppedBits;
  const auto bits = std::bit_cast<uint32_t>(static_cast<float>(value));
  const uint32_t rounded = bits + (1u << (kDroppedBits - 1));
  // The greatest numbers are not rounded, because the result would be infinite.
  return ((rounded & kExponentBits) == kExponentBits ? bits : rounded) >> kDroppedBits;
}

struct FieldNumbers {
  const char* kind;
  std::vector<uint32_t> ofInputFaces;
};

FieldNumbers numbersOf(const Field& field) {
  ASDFVK_CHECK(field.componentCount == 1);
  if (const std::vector<double>* reals = field.reals()) {
    requireSingles(*reals, "'" + field.name + "'");
    FieldNumbers numbers{"number", std::vector<uint32_t>(reals->size())};
    std::transform(reals->begin(), reals->end(), numbers.ofInputFaces.begin(), upperBitsOf);
    return numbers;
  }
  if (const auto* labels = std::get_if<std::vector<uint32_t>>(&field.values)) return {"label", *labels};
  const auto& bytes = std::get<std::vector<uint8_t>>(field.values);
  const bool isFlag = std::all_of(bytes.begin(), bytes.end(), [](uint8_t byte) { return byte <= 1; });
  return {isFlag ? "flag" : "label", std::vector<uint32_t>(bytes.begin(), bytes.end())};
}

}  // namespace

Box3d boxOfFaces(const TriangleMesh& mesh) {
  Box3d box;
  for (const Face& face : mesh.faces)
    for (const uint32_t vertex : face)
      if (isFinite(mesh.vertices[vertex])) box.add(mesh.vertices[vertex]);
  if (box.isEmpty()) box.add(Vec3d{});
  return box;
}

Json encodeMesh(const TriangleMesh& mesh, std::span<const std::reference_wrapper<const Field>> fields,
                PageArrays& arrays, const Box3d& box) {
  const Layout layout(mesh);
  const Grid grid(box);
  const size_t faceCount = layout.faces.size(), vertexCount = layout.vertices.size();
  const std::array<const char*, 5> keys{"corners", "faces", "x", "y", "z"};
  std::vector<PageArrays::Source> sources;
  sources.push_back([&] { return layout.corners; });
  sources.push_back(
      [&] { return differencesOf(faceCount, [&](size_t i) { return mesh.inputFaceOf(layout.faces[i]); }); });
  for (size_t axis = 0; axis < 3; ++axis)
    sources.push_back([&, axis] {
      return differencesOf(vertexCount,
                           [&](size_t i) { return grid.stepsOf(mesh.vertices[layout.vertices[i]][axis], axis); });
    });
  std::vector<FieldNumbers> numbers;
  numbers.reserve(fields.size());  // Prevents a reallocation, because the sources refer to the elements.
  for (const Field& field : fields) {
    const FieldNumbers& added = numbers.emplace_back(numbersOf(field));
    sources.push_back([&] {
      return differencesOf(faceCount, [&](size_t i) { return added.ofInputFaces[mesh.inputFaceOf(layout.faces[i])]; });
    });
  }

  const std::vector<uint32_t> arrayNumbers = arrays.add(sources);
  Json description;
  description["faceCount"] = faceCount;
  description["vertexCount"] = vertexCount;
  description["inputFaceCount"] = mesh.inputFaceCount();
  description["boxMin"] = arrayOf(grid.box.min);
  description["boxMax"] = arrayOf(grid.box.max);
  description["step"] = grid.step;
  for (size_t i = 0; i < keys.size(); ++i) description["arrays"][keys[i]] = arrayNumbers[i];
  description["fields"] = Json::array();
  for (size_t i = 0; i < fields.size(); ++i) {
    const Field& field = fields[i];
    description["fields"].push_back({{"name", field.name},
                                     {"title", field.label.empty() ? field.name : field.label},
                                     {"unit", field.unit == "length" ? "mesh units" : field.unit},
                                     {"kind", numbers[i].kind},
                                     {"array", arrayNumbers[keys.size() + i]}});
  }
  return description;
}

}  // namespace asdfvk
