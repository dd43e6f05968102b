#include "io/draco_mesh.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/core.h>

#include <limits>
#include <optional>

#include "core/text.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

/// The counts at the beginning of the connectivity.
struct DracoCounts {
  uint32_t faces = 0, vertices = 0, symbols = 0, splits = 0;
  uint8_t attributeSets = 0;  ///< Groups of attributes with their own corners.
};

bool isRead(draco::DecoderBuffer buffer, draco::MeshSequentialDecoder*, DracoCounts& counts) {
  return draco::DecodeVarint(&counts.faces, &buffer) && draco::DecodeVarint(&counts.vertices, &buffer);
}

bool isRead(draco::DecoderBuffer buffer, draco::MeshEdgebreakerDecoder*, DracoCounts& counts) {
  return draco::DecodeVarint(&counts.vertices, &buffer) && draco::DecodeVarint(&counts.faces, &buffer) &&
         buffer.Decode(&counts.attributeSets) && draco::DecodeVarint(&counts.symbols, &buffer) &&
         draco::DecodeVarint(&counts.splits, &buffer) && counts.vertices / 3 <= counts.faces &&
         counts.symbols <= counts.faces && counts.splits <= counts.symbols;
}

/// A decoder that checks its counts before it allocates memory. A few bytes may announce billions of faces, and an
/// attribute may have 255 numbers per point. `reason` says why a mesh is refused.
template <typename Decoder>
class LimitedDracoDecoder final : public Decoder {
 public:
  LimitedDracoDecoder(const DracoRequest& request, DracoBudget& budget, std::string& reason)
      : request_(request), budget_(budget), reason_(reason) {}

 protected:
  bool DecodeConnectivity() override {
    DracoCounts counts;
    if (!isRead(*this->buffer(), static_cast<Decoder*>(nullptr), counts)) return false;
    if (counts.faces > request_.maxFaceCount) {
      reason_ = fmt::format("has {}; its accessor has {}", counted(counts.faces, "face"), request_.maxFaceCount);
      return false;
    }
    // Upper bounds of the arrays of libdraco.
    constexpr uint64_t kBytesPerFace = 80, kBytesPerVertex = 40, kBytesPerCornerSet = 48;
    return isWithinMemory(counts.faces * (kBytesPerFace + kBytesPerCornerSet * counts.attributeSets) +
                          (uint64_t{counts.vertices} + counts.splits) * kBytesPerVertex) &&
           Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& points = *this->point_cloud();
    uint64_t bytesPerPoint = 0;
    constexpr uint64_t kBytesPerNumber = 16, kFurtherBytes = 16;
    for (int32_t i = 0; i < points.num_attributes(); ++i)
      bytesPerPoint += kBytesPerNumber * points.attribute(i)->num_components() + kFurtherBytes;
    return isWithinMemory(bytesPerPoint * points.num_points()) && Decoder::DecodeAllAttributes();
  }

 private:
  bool isWithinMemory(uint64_t byteCount) {
    budget_.usedByteCount += byteCount;
    if (budget_.usedByteCount <= budget_.maxByteCount) return true;
    reason_ =
        fmt::format("needs more than {} MiB to be decoded; export without compression", budget_.maxByteCount >> 20);
    return false;
  }

  const DracoRequest& request_;
  DracoBudget& budget_;
  std::string& reason_;
};

template <typename Decoder>
bool isDracoDecoded(std::span<const char> bytes, const DracoRequest& request, DracoBudget& budget, draco::Mesh& mesh,
                    std::string& reason) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  return LimitedDracoDecoder<Decoder>(request, budget, reason).Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
}

draco::DataType dracoTypeOf(GltfType type) {
  switch (type) {
    case kGltfByte:
      return draco::DT_INT8;
    case kGltfUByte:
      return draco::DT_UINT8;
    case kGltfShort:
      return draco::DT_INT16;
    case kGltfUShort:
      return draco::DT_UINT16;
    default:
      return draco::DT_FLOAT32;
  }
}

}  // namespace

DracoMesh decodeDraco(std::span<const char> bytes, const DracoRequest& request, DracoBudget& budget,
                      std::string_view where) {
  const auto fail = [&](std::string_view reason) {
    failInput(fmt::format("{} is compressed by Draco, and its data {}", where, reason));
  };
  // The five letters, the version, the kind of geometry, the method, and two bytes of flags. glTF demands version 2.2.
  constexpr size_t kHeaderSize = 11;
  const std::string_view header(bytes.data(), std::min(bytes.size(), kHeaderSize));
  if (header.size() < kHeaderSize || !header.starts_with("DRACO")) fail("has no header of Draco");
  if (!header.substr(5).starts_with("\2\2"))
    fail(fmt::format("has the version {}.{} instead of 2.2", +header[5], +header[6]));
  if (header[7] != draco::TRIANGULAR_MESH) fail("is not a mesh of triangles");
  budget.usedByteCount += bytes.size();
  draco::Mesh mesh;
  std::string reason = "is damaged";
  if (!(header[8] == draco::MESH_EDGEBREAKER_ENCODING
            ? isDracoDecoded<draco::MeshEdgebreakerDecoder>(bytes, request, budget, mesh, reason)
            : isDracoDecoded<draco::MeshSequentialDecoder>(bytes, request, budget, mesh, reason)))
    fail(reason);

  const bool isId = request.positionId <= std::numeric_limits<uint32_t>::max();
  const draco::PointAttribute* const positions =
      isId ? mesh.GetAttributeByUniqueId(static_cast<uint32_t>(request.positionId)) : nullptr;
  if (positions == nullptr) fail(fmt::format("has no attribute {}", request.positionId));
  const uint64_t pointSize = uint64_t{3} * gltfSizeOf(request.type);
  if (positions->num_components() != 3 || positions->data_type() != dracoTypeOf(request.type) ||
      positions->byte_stride() != static_cast<int64_t>(pointSize))
    fail("has positions of another type than its accessor");
  DracoMesh result;
  result.positions.resize(pointSize * mesh.num_points());
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = positions->mapped_index(draco::PointIndex(i));
    if (value.value() >= positions->size()) fail("is damaged");
    positions->GetValue(value, result.positions.data() + i * pointSize);
  }
  result.faces.resize(mesh.num_faces());
  for (uint32_t i = 0; i < mesh.num_faces(); ++i)
    for (size_t corner = 0; corner < 3; ++corner) {
      result.faces[i][corner] = mesh.face(draco::FaceIndex(i))[corner].value();
      if (result.faces[i][corner] >= mesh.num_points()) fail("is damaged");
    }
  return result;
}

}  // namespace asdfvk
