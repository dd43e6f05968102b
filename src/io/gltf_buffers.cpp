#include "io/gltf_buffers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/text.h"
#include "io/base64_text.h"
#include "io/files_beside.h"
#include "io/input_failure.h"
#include "io/meshopt_view.h"

namespace asdfvk {
namespace {

constexpr std::array kMeshoptExtensions{"EXT_meshopt_compression", "KHR_meshopt_compression"};

const GltfJson* meshoptOf(const GltfJson& json, std::string_view where) {
  for (const char* const name : kMeshoptExtensions)
    if (const GltfJson* const extension = gltfExtension(json, name, where)) return extension;
  return nullptr;
}

MeshoptView meshoptViewOf(const GltfJson& json, const std::string& where) {
  MeshoptView view{.count = gltfWhole(json, "count", std::nullopt, where),
                   .stride = gltfWhole(json, "byteStride", std::nullopt, where)};
  constexpr uint64_t kMaxStride = 256;
  if (view.stride == 0 || view.stride > kMaxStride) failGltf(where, fmt::format("byteStride {}", view.stride));
  const std::string mode = gltfText(json, "mode", where), filter = gltfText(json, "filter", where);
  constexpr std::array<std::string_view, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
  constexpr std::array<std::string_view, 4> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
  const auto* const foundMode = std::find(kModes.begin(), kModes.end(), mode);
  const auto* const foundFilter = std::find(kFilters.begin(), kFilters.end(), filter.empty() ? "NONE" : filter);
  if (foundMode == kModes.end()) failGltf(where, fmt::format("its mode {} is unknown", asdfvk::quoted(mode)));
  if (foundFilter == kFilters.end()) failGltf(where, fmt::format("its filter {} is unknown", asdfvk::quoted(filter)));
  view.mode = static_cast<MeshoptMode>(foundMode - kModes.begin());
  view.filter = static_cast<MeshoptFilter>(foundFilter - kFilters.begin());
  return view;
}

}  // namespace

GltfBuffers::GltfBuffers(const GltfJson& document, std::optional<std::span<const char>> binary,
                         const MeshSource& source)
    : document_(document),
      binary_(binary),
      source_(source),
      requiresDecoding_(gltfRequires(document, kMeshoptExtensions[0]) || gltfRequires(document, kMeshoptExtensions[1])),
      buffers_(gltfCount(document, "buffers")) {}

std::span<const char> GltfBuffers::buffer(uint64_t index) {
  const std::string where = fmt::format("buffer {}", index);
  const GltfJson& json = gltfItem(document_, "buffers", index, "glTF");
  if (!buffers_[index]) buffers_[index] = load(index, json, where);
  return *buffers_[index];
}

std::span<const char> GltfBuffers::load(uint64_t index, const GltfJson& json, const std::string& where) {
  const uint64_t byteLength = gltfWhole(json, "byteLength", std::nullopt, where);
  if (!hasData(index, json, where)) failGltf(where, "has no data in this file");
  const GltfJson* const uri = gltfMember(json, "uri", where);
  if (uri != nullptr && !uri->is_string()) failGltf(where, "uri is not a string");
  const std::string_view text = uri == nullptr ? std::string_view() : uri->get_ref<const std::string&>();
  const std::span<const char> bytes = uri == nullptr              ? *binary_
                                      : text.starts_with("data:") ? embedded(text, where)
                                                                  : fileBeside(percentDecoded(text), where);
  if (byteLength > bytes.size())
    failGltf(where, fmt::format("byteLength {}; its data has {} bytes", byteLength, bytes.size()));
  constexpr uint64_t kMaxPadding = 3;  // The BIN chunk is padded to a multiple of four bytes.
  if (const uint64_t further = bytes.size() - byteLength; further > kMaxPadding) unusedByteCount_ += further;
  return bytes.first(byteLength);
}

std::span<const char> GltfBuffers::embedded(std::string_view uri, std::string_view where) {
  const size_t comma = std::min(uri.find(','), uri.size() - 1);
  std::optional<std::vector<char>> bytes;
  if (uri.substr(0, comma).ends_with(";base64")) bytes = base64Bytes(uri.substr(comma + 1));
  if (!bytes) failGltf(where, "its data URI is not base64");
  return embedded_.emplace_back(std::move(*bytes));
}

std::span<const char> GltfBuffers::fileBeside(std::string_view name, std::string_view where) {
  if (source_.beside != nullptr) return source_.beside->read(name, where);
  failGltf(where, fmt::format("its data is in the file {}, which is read only beside a named file; export as .glb, or "
                              "read the file by its path",
                              asdfvk::quoted(name)));
}

bool GltfBuffers::hasData(uint64_t index, const GltfJson& json, const std::string& where) const {
  return gltfMember(json, "uri", where) != nullptr || (index == 0 && binary_);
}

std::span<const char> GltfBuffers::range(const GltfJson& json, const std::string& where) {
  const uint64_t index = gltfWhole(json, "buffer", std::nullopt, where);
  const uint64_t offset = gltfWhole(json, "byteOffset", 0, where);
  const uint64_t length = gltfWhole(json, "byteLength", std::nullopt, where);
  const std::span<const char> bytes = buffer(index);
  if (offset > bytes.size() || length > bytes.size() - offset)
    failGltf(where, fmt::format("bytes {} to {} + {} are beyond the {} of buffer {}", offset, offset, length,
                                bytes.size(), index));
  return bytes.subspan(offset, length);
}

GltfView GltfBuffers::view(uint64_t index, std::string_view where) {
  const GltfJson& json = gltfItem(document_, "bufferViews", index, where);
  const std::string name = fmt::format("buffer view {}", index);
  if (const GltfJson* const compression = meshoptOf(json, name)) {
    // For programs without a decoder, the view itself may have the elements without compression.
    const uint64_t buffer = gltfWhole(json, "buffer", std::nullopt, name);
    const GltfJson& bufferJson = gltfItem(document_, "buffers", buffer, name);
    const bool isPlain = hasData(buffer, bufferJson, name) && !requiresDecoding_ &&
                         !(readsMeshopt() && meshoptOf(bufferJson, name) != nullptr);
    if (!isPlain) return decoded(index, *compression, name);
  }
  GltfView view{.bytes = range(json, name), .stride = {}};
  if (gltfMember(json, "byteStride", name) != nullptr) view.stride = gltfWhole(json, "byteStride", std::nullopt, name);
  return view;
}

GltfView GltfBuffers::decoded(uint64_t index, const GltfJson& compression, const std::string& where) {
  const MeshoptView view = meshoptViewOf(compression, where);
  const auto [place, isNew] = decodedViews_.try_emplace(index);
  if (isNew) {
    const std::span<const char> bytes = range(compression, where);
    constexpr uint64_t kLeastLimit = uint64_t{64} << 20, kDecodedBytesPerByte = 64;
    const uint64_t limit = source_.limit(kLeastLimit, kDecodedBytesPerByte);
    if (view.count > (limit - decodedByteCount_) / view.stride)
      failGltf(where, fmt::format("the compressed views of this file need more than {} MiB; export without compression",
                                  limit >> 20));
    decodedByteCount_ += view.count * view.stride;
    place->second = decodeMeshopt(bytes, view, where);
  }
  return {place->second, view.stride, true};
}

}  // namespace asdfvk
