#include "io/gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/text.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr uint64_t kGlbHeaderSize = 12, kChunkGlbHeaderSize = 8;
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

uint32_t glbWordAt(std::span<const char> bytes, uint64_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// Whether the reader supports the extension, or the extension changes neither positions nor triangles.
bool isKnownExtension(std::string_view extension) {
  constexpr std::array<std::string_view, 5> kSupported{"KHR_mesh_quantization", "KHR_node_visibility",
                                                       "KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                       "KHR_meshopt_compression"};
  constexpr std::array<std::string_view, 9> kPrefixes{"KHR_materials_", "KHR_texture_",     "EXT_texture_",
                                                      "MSFT_texture_",  "KHR_lights_",      "EXT_lights_",
                                                      "KHR_xmp",        "EXT_structural_m", "KHR_animation_"};
  return std::find(kSupported.begin(), kSupported.end(), extension) != kSupported.end() ||
         std::any_of(kPrefixes.begin(), kPrefixes.end(), [&](auto prefix) { return extension.starts_with(prefix); });
}

}  // namespace

GltfFile::GltfFile(const MeshSource& source) : source_(source) {
  std::optional<std::span<const char>> binary;
  if (std::string_view(source.bytes.data(), source.bytes.size()).starts_with("glTF"))
    binary = readChunks();
  else
    document_ = parseGltfJson(source.bytes);
  const GltfJson* const asset = gltfMember(document_, "asset", "glTF");
  if (asset == nullptr) failInput("JSON without 'asset' is not glTF");
  const std::string version = gltfText(*asset, "version", "asset");
  if (!version.starts_with("2."))
    failInput(fmt::format("glTF version {}; version 2.0 is read: convert the file", asdfvk::quoted(version)));
  requireKnownExtensions();
  buffers_.emplace(document_, binary, source);
  requiresDraco_ = gltfRequires(document_, "KHR_draco_mesh_compression");
}

/// Returns the binary chunk.
std::optional<std::span<const char>> GltfFile::readChunks() {
  const std::span<const char> bytes = source_.bytes;
  if (bytes.size() < kGlbHeaderSize + kChunkGlbHeaderSize)
    failInput("binary glTF is truncated in its header; copy or export it again");
  if (const uint32_t version = glbWordAt(bytes, 4); version != 2)
    failInput(fmt::format("binary glTF version {}; version 2 is read: convert the file", version));
  const uint64_t length = glbWordAt(bytes, 8);
  if (length > bytes.size())
    failInput(fmt::format(
        "binary glTF has {} bytes by its header; this file has {} and is truncated; copy or export it again", length,
        bytes.size()));
  trailingByteCount_ = bytes.size() - length;
  std::optional<std::span<const char>> binary;
  uint64_t at = kGlbHeaderSize;
  for (uint32_t chunk = 0; chunk == 0 || at < length; ++chunk) {
    if (length < at + kChunkGlbHeaderSize)
      failAtByte(at, "truncated in the header of a chunk; copy or export the file again");
    const uint64_t chunkLength = glbWordAt(bytes, at);
    const uint32_t type = glbWordAt(bytes, at + 4);
    at += kChunkGlbHeaderSize;
    if (chunkLength > length - at)
      failAtByte(at, fmt::format("a chunk of {} bytes does not fit; {} are left", chunkLength, length - at));
    const std::span<const char> contents = bytes.subspan(at, chunkLength);
    if ((chunk == 0) != (type == kJsonChunk)) failAtByte(at, "the first chunk, and no other, must be JSON");
    if (type == kJsonChunk) document_ = parseGltfJson(contents);
    if (type == kBinaryChunk && chunk == 1) binary = contents;
    at += chunkLength;
  }
  return binary;
}

void GltfFile::requireKnownExtensions() const {
  const GltfJson* const required = gltfArray(document_, "extensionsRequired", "glTF");
  if (required == nullptr) return;
  for (const GltfJson& entry : *required) {
    if (!entry.is_string()) failInput("extensionsRequired has an entry that is not a string");
    const auto& name = entry.get_ref<const std::string&>();
    if (!isKnownExtension(name))
      failInput(
          fmt::format("requires the extension {}, which is not supported; export without it", asdfvk::quoted(name)));
  }
}

GltfAccessor::Elements GltfFile::elementsOf(const GltfJson& holder, uint64_t count, uint32_t componentType,
                                            uint32_t componentCount, bool hasStride, std::string_view where) {
  const uint64_t elementSize = uint64_t{gltfSizeOf(componentType)} * componentCount;
  const GltfView view = buffers_->view(gltfWhole(holder, "bufferView", std::nullopt, where), where);
  const uint64_t stride = hasStride ? view.stride.value_or(elementSize) : elementSize;
  const uint64_t offset = gltfWhole(holder, "byteOffset", 0, where);
  constexpr uint64_t kMaxStride = 252;
  if (stride < elementSize || stride > kMaxStride) failGltf(where, fmt::format("byteStride {}", stride));
  if (view.isDecoded && *view.stride != stride)
    failGltf(where, fmt::format("has elements of {} bytes; its buffer view has {}", stride, *view.stride));
  if (offset > view.bytes.size() || elementSize > view.bytes.size() - offset ||
      count - 1 > (view.bytes.size() - offset - elementSize) / stride)
    failGltf(where, fmt::format("{} do not fit into the {} bytes of its buffer view", counted(count, "element"),
                                view.bytes.size()));
  return {view.bytes.data() + offset, stride, componentType};
}

GltfAccessor GltfFile::open(uint64_t index, bool isIndex) {
  const auto found = opened_.find({index, isIndex});
  if (found != opened_.end()) return found->second;
  const std::string where = fmt::format("accessor {}", index);
  return opened_.emplace(std::pair(index, isIndex), opened(item("accessors", index, "glTF"), isIndex, where))
      .first->second;
}

GltfAccessor GltfFile::opened(const GltfJson& json, bool isIndex, const std::string& where) {
  const char* const type = isIndex ? "SCALAR" : "VEC3";
  const uint32_t componentCount = isIndex ? 1 : 3;
  if (const std::string found = gltfText(json, "type", where); found != type)
    failGltf(where, fmt::format("has the type {} instead of {}", asdfvk::quoted(found), type));
  const uint64_t component = gltfWhole(json, "componentType", std::nullopt, where);
  const bool isAllowed = isIndex ? component == kGltfUByte || component == kGltfUShort || component == kGltfUInt
                                 : (component >= kGltfByte && component <= kGltfUShort) || component == kGltfFloat;
  if (!isAllowed) failGltf(where, fmt::format("componentType {} is not allowed here", component));
  const uint64_t count = gltfWhole(json, "count", std::nullopt, where);
  // Without a buffer view, the elements are 0, or compressed by Draco.
  GltfAccessor::Elements elements{.componentType = static_cast<uint32_t>(component)};
  if (count > 0 && gltfMember(json, "bufferView", where) != nullptr)
    elements = elementsOf(json, count, elements.componentType, componentCount, !isIndex, where);
  const bool isNormalized = gltfFlag(json, "normalized", false, where) && component != kGltfFloat && !isIndex;
  GltfAccessor accessor(count, elements, isNormalized);
  if (const GltfJson* const sparse = gltfMember(json, "sparse", where); sparse != nullptr && count > 0)
    openSparse(*sparse, componentCount, accessor, where);
  return accessor;
}

void GltfFile::openSparse(const GltfJson& sparse, uint32_t componentCount, GltfAccessor& accessor,
                          const std::string& where) {
  const uint64_t count = gltfWhole(sparse, "count", std::nullopt, where);
  const GltfJson* const places = gltfMember(sparse, "indices", where);
  const GltfJson* const values = gltfMember(sparse, "values", where);
  if (places == nullptr || values == nullptr || count == 0 || count > accessor.count())
    failGltf(where, "its sparse part is incomplete");
  const uint64_t placeType = gltfWhole(*places, "componentType", std::nullopt, where);
  if (placeType != kGltfUByte && placeType != kGltfUShort && placeType != kGltfUInt)
    failGltf(where, "the componentType of its sparse indices is not allowed");
  const GltfAccessor::Elements indices = elementsOf(*places, count, static_cast<uint32_t>(placeType), 1, false, where);
  // Many accessors of a small file may have the same sparse indices.
  constexpr uint64_t kSparseElementsPerByte = 4;
  sparseElementCount_ += count;
  if (sparseElementCount_ > kSparseElementsPerByte * source_.sizeForLimits())
    failGltf(where, "the sparse parts of this file have more elements than its size allows; export without them");
  for (uint64_t i = 0; i < count; ++i)
    if (indices.wholeAt(i) >= accessor.count() || (i > 0 && indices.wholeAt(i) <= indices.wholeAt(i - 1)))
      failGltf(where, "its sparse indices do not ascend, or are out of range");
  accessor.setSparse(count, indices,
                     elementsOf(*values, count, accessor.componentType(), componentCount, false, where));
}

}  // namespace asdfvk
