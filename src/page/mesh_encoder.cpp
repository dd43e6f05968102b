#include "page/mesh_encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/json.h"
#include "core/parallel.h"
#include "mesh/face_geometry.h"
#include "page/connectivity.h"
#include "page/decimal_codes.h"
#include "page/field_encoder.h"
#include "page/half_edges.h"

namespace asdfvk {
namespace {

/// Coordinates are multiples of the longest side of the box over this.
constexpr double kGridSize = 65535;

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
    // Halves: the difference of two finite numbers may overflow.
    const double steps = std::round((coordinate * 0.5 - box.min[axis] * 0.5) / (step * 0.5));
    return static_cast<uint32_t>(std::clamp(steps, 0.0, kGridSize));
  }
};

Bytes encodeCoordinates(const TriangleMesh& mesh, const Connectivity& walk, const Grid& grid, size_t axis) {
  const size_t count = walk.vertices.size();
  std::vector<int32_t> steps(count);
  std::vector<uint32_t> residuals(count);
  for (size_t i = 0; i < count; ++i)
    steps[i] = static_cast<int32_t>(grid.stepsOf(mesh.vertices[walk.vertices[i]][axis], axis));
  for (size_t i = 0; i < count; ++i) {
    const auto [start, end, opposite] = walk.frontOf[i];
    int32_t predicted = i == 0 ? 0 : steps[i - 1];
    if (start != kNone) predicted = steps[start] + steps[end] - steps[opposite];
    residuals[i] = zigzag(static_cast<int16_t>(steps[i] - predicted)) & 0xffff;
  }
  return bytePlanesOf(residuals);
}

Bytes encodeFaceIds(std::span<const uint32_t> inputFaces, const Connectivity& walk) {
  std::vector<uint32_t> residuals(inputFaces.size());
  for (size_t i = 0; i < inputFaces.size(); ++i) {
    const uint32_t neighbour = walk.neighboursOf[i][0];
    const uint32_t predicted = neighbour == kNone ? 0 : inputFaces[neighbour];
    residuals[i] = zigzag(static_cast<int32_t>(inputFaces[i] - predicted));
  }
  return bytePlanesOf(residuals);
}

std::vector<uint32_t> inputFacesOf(const TriangleMesh& mesh, const Connectivity& walk) {
  std::vector<uint32_t> inputFaces(walk.faces.size());
  forEachInParallel(inputFaces.size(), [&](uint32_t i) { inputFaces[i] = mesh.inputFaceOf(walk.faces[i]); });
  return inputFaces;
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
                PageStreams& streams, const Box3d& box) {
  const Connectivity walk = encodeConnectivity(mesh);
  const Grid grid(box);
  const std::vector<uint32_t> inputFaces = inputFacesOf(mesh, walk);

  std::vector<FieldEncoder> encoders;
  encoders.reserve(fields.size());  // The sources refer to them.
  for (const Field& field : fields) encoders.emplace_back(field, inputFaces, walk);
  std::vector<std::function<Bytes()>> sources;
  std::vector<std::pair<FieldEncoder*, std::string>> fieldOf;  // Of the first sources: the field and the key.
  for (FieldEncoder& encoder : encoders)
    for (const std::string& key : encoder.streamKeys()) {
      sources.push_back([&encoder, key] { return encoder.encode(key); });
      fieldOf.emplace_back(&encoder, key);
    }
  const std::array<const char*, 6> keys{"faces", "x", "y", "z", "symbols", "references"};
  sources.push_back([&] { return encodeFaceIds(inputFaces, walk); });
  for (size_t axis = 0; axis < 3; ++axis)
    sources.push_back([&, axis] { return encodeCoordinates(mesh, walk, grid, axis); });
  sources.push_back([&] { return walk.symbols; });
  sources.push_back([&] { return walk.references; });

  const std::vector<uint32_t> numbers = streams.add(sources);
  for (size_t i = 0; i < fieldOf.size(); ++i) fieldOf[i].first->setStream(fieldOf[i].second, numbers[i]);
  Json description;
  description["faceCount"] = walk.faces.size();
  description["vertexCount"] = walk.vertices.size();
  description["inputFaceCount"] = mesh.inputFaceCount();
  description["boxMin"] = arrayOf(grid.box.min);
  description["boxMax"] = arrayOf(grid.box.max);
  description["step"] = grid.step;
  description["gateCount"] = walk.gateCount;
  for (size_t i = 0; i < keys.size(); ++i) description["streams"][keys[i]] = numbers[fieldOf.size() + i];
  description["fields"] = Json::array();
  for (const FieldEncoder& encoder : encoders) description["fields"].push_back(encoder.description());
  return description;
}

}  // namespace asdfvk
