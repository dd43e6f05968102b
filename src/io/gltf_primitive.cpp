#include "io/gltf_primitive.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/text.h"
#include "io/draco_mesh.h"
#include "io/input_failure.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

/// Limit of the memory for decoding all meshes. A face has 1 to 40 bytes in a file, and 50 to 300 bytes in the arrays
/// of libdraco.
uint64_t maxDracoBytes(const MeshSource& source) {
  constexpr uint64_t kDracoBytesPerByte = 512, kLeastLimit = uint64_t{64} << 20;
  const uint64_t allowedFaceCount = std::min<uint64_t>(source.options.maxFaces, kMaxTriangleCount);
  return std::max(kLeastLimit, kDracoBytesPerByte * std::max(source.sizeForLimits(), allowedFaceCount));
}

}  // namespace

GltfPrimitive::GltfPrimitive(GltfFile& file, const GltfJson& json, std::string where)
    : file_(file), where_(std::move(where)), mode_(gltfWhole(json, "mode", kGltfTriangles, where_)) {
  const auto hasBufferView = [&](uint64_t accessor) {
    return gltfMember(file.item("accessors", accessor, where_), "bufferView", where_) != nullptr;
  };
  if (mode_ > kGltfFan) failGltf(where_, fmt::format("mode {} is unknown", mode_));
  const GltfJson* const attributes = gltfMember(json, "attributes", where_);
  if (attributes == nullptr || gltfMember(*attributes, "POSITION", where_) == nullptr) return;
  const uint64_t positions = gltfWhole(*attributes, "POSITION", std::nullopt, where_);
  positions_ = file.vectors(positions);
  bool isPlain = hasBufferView(positions);
  if (gltfMember(json, "indices", where_) != nullptr) {
    const uint64_t indices = gltfWhole(json, "indices", std::nullopt, where_);
    indices_ = file.indices(indices);
    isPlain = isPlain && hasBufferView(indices);
  }
  if (mode_ == kGltfTriangles && cornerCount() % 3 != 0)
    failGltf(where_, fmt::format("{} corners do not make triangles", cornerCount()));
  draco_ = gltfExtension(json, "KHR_draco_mesh_compression", where_);
  // If the extension is not required, the accessors may have the same triangles without compression.
  if (isPlain && !file.requiresDraco()) draco_ = nullptr;
  if (draco_ != nullptr && mode_ > kGltfTriangles)
    failGltf(where_, fmt::format("mode {} with Draco; export triangles, or without compression", mode_));
  if (draco_ == nullptr) return;
  dracoView_ = gltfWhole(*draco_, "bufferView", std::nullopt, where_);
  (void)file.bytesOf(dracoView_, where_);  // Reads the file beside, on whose size the limits depend.
}

uint64_t GltfPrimitive::faceCount() const {
  if (mode_ < kGltfTriangles || isEmpty()) return 0;
  return mode_ == kGltfTriangles ? cornerCount() / 3 : std::max<uint64_t>(cornerCount(), 2) - 2;
}

uint64_t GltfPrimitive::vertexAt(uint64_t corner) const {
  const uint64_t vertex = indices_ ? indices_->indexAt(corner) : corner;
  if (vertex >= vertexCount())
    failGltf(where_, fmt::format("index {} is out of range; the primitive has {}", vertex,
                                 counted(vertexCount(), "vertex", "vertices")));
  return vertex;
}

uint64_t GltfPrimitive::addDecoded(std::vector<Face>& faces, CornerWelder& welder, const MeshSource& source) const {
  const GltfJson* const attributes = gltfMember(*draco_, "attributes", where_);
  if (attributes == nullptr) failGltf(where_, "its Draco extension has no attributes");
  const DracoRequest request{.positionId = gltfWhole(*attributes, "POSITION", std::nullopt, where_),
                             .type = static_cast<GltfType>(positions_->componentType()),
                             .maxFaceCount = faceCount()};
  file_.dracoBudget().maxByteCount = maxDracoBytes(source);
  const DracoMesh mesh = decodeDraco(file_.bytesOf(dracoView_, where_), request, file_.dracoBudget(), where_);
  const uint64_t pointSize = uint64_t{3} * gltfSizeOf(request.type);
  const GltfAccessor points(mesh.positions.size() / pointSize, {mesh.positions.data(), pointSize, request.type},
                            positions_->isNormalized());
  for (const Face& corners : mesh.faces) {
    Face face;
    for (size_t c = 0; c < 3; ++c) face[c] = welder.indexOf(points.vectorAt(corners[c]));
    faces.push_back(face);
  }
  return faceCount() - mesh.faces.size();
}

uint64_t GltfPrimitive::addTo(std::vector<Face>& faces, CornerWelder& welder, const MeshSource& source) const {
  const uint64_t count = faceCount();
  if (draco_ != nullptr && count > 0) return addDecoded(faces, welder, source);
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t a = mode_ == kGltfTriangles ? 3 * i : mode_ == kGltfFan ? 0 : i;
    const uint64_t b = mode_ == kGltfTriangles ? a + 1 : i + 1;
    const bool isOdd = mode_ == kGltfStrip && i % 2 == 1;
    const std::array vertices{vertexAt(a), vertexAt(isOdd ? b + 1 : b), vertexAt(isOdd ? b : b + 1)};
    // In a strip, triangles with two equal indices only connect pieces of the strip and are not faces.
    if (mode_ == kGltfStrip && (vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0]))
      continue;
    Face face;
    for (size_t c = 0; c < 3; ++c) face[c] = welder.indexOf(positions_->vectorAt(vertices[c]));
    faces.push_back(face);
  }
  return 0;
}

}  // namespace asdfvk
