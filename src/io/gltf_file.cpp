#include "io/gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/text.h"
#include "io/base64_text.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is read by copying its bytes");

constexpr uint64_t kGlbHeaderSize = 12, kChunkGlbHeaderSize = 8;
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr int kMaxJsonDepth = 64;  // glTF needs about ten.

enum GltfType : uint32_t { kGltfByte = 5120, kGltfUByte, kGltfShort, kGltfUShort, kGltfUInt = 5125, kGltfFloat };

[[noreturn]] void failGltf(std::string_view where, std::string_view reason) {
  failInput(fmt::format("{}: {}", where, reason));
}

template <typename T>
T gltfNumber(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

uint32_t gltfSizeOf(uint32_t componentType) {
  switch (componentType) {
    case kGltfByte:
    case kGltfUByte:
      return 1;
    case kGltfShort:
    case kGltfUShort:
      return 2;
    default:
      return 4;
  }
}

/// Whether the extension changes neither positions nor triangles.
bool isHarmless(std::string_view extension) {
  constexpr std::array<std::string_view, 9> kPrefixes{"KHR_materials_", "KHR_texture_",     "EXT_texture_",
                                                      "MSFT_texture_",  "KHR_lights_",      "EXT_lights_",
                                                      "KHR_xmp",        "EXT_structural_m", "KHR_animation_"};
  return extension == "KHR_mesh_quantization" ||
         std::any_of(kPrefixes.begin(), kPrefixes.end(), [&](auto prefix) { return extension.starts_with(prefix); });
}

/// Empty if there is no such member.
std::string gltfText(const GltfJson& object, const char* key, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value == nullptr) return {};
  if (!value->is_string()) failGltf(where, fmt::format("{} is not a string", key));
  return value->get<std::string>();
}

}  // namespace

const GltfJson* gltfMember(const GltfJson& object, const char* key, std::string_view where) {
  if (!object.is_object()) failGltf(where, "is not a JSON object");
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

uint64_t gltfWhole(const GltfJson& object, const char* key, std::optional<uint64_t> fallback, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value == nullptr) {
    if (!fallback) failGltf(where, fmt::format("has no {}", key));
    return *fallback;
  }
  if (value->is_number_unsigned()) return value->get<uint64_t>();
  if (value->is_number_float()) {  // Some writers spell 3 as 3.0.
    const double number = value->get<double>();
    if (number >= 0 && number < 0x1p53 && number == std::floor(number)) return static_cast<uint64_t>(number);
  }
  failGltf(where, fmt::format("{} is not a non-negative integer", key));
}

const GltfJson* gltfArray(const GltfJson& object, const char* key, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value != nullptr && !value->is_array()) failGltf(where, fmt::format("{} is not an array", key));
  return value;
}

bool gltfNumbers(const GltfJson& object, const char* key, std::span<double> numbers, std::string_view where) {
  const GltfJson* const values = gltfArray(object, key, where);
  if (values == nullptr) return false;
  if (values->size() != numbers.size())
    failGltf(where, fmt::format("{} has {} instead of {}", key, counted(values->size(), "number"), numbers.size()));
  for (size_t i = 0; i < numbers.size(); ++i) {
    const GltfJson& value = (*values)[i];
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      failGltf(where, fmt::format("{} has an entry that is not a finite number", key));
    numbers[i] = value.get<double>();
  }
  return true;
}

uint32_t GltfAccessor::wholeAt(const Elements& elements, uint64_t i) {
  const char* const from = elements.data + i * elements.stride;
  switch (elements.componentType) {
    case kGltfUByte:
      return gltfNumber<uint8_t>(from);
    case kGltfUShort:
      return gltfNumber<uint16_t>(from);
    default:
      return gltfNumber<uint32_t>(from);
  }
}

const char* GltfAccessor::elementAt(uint64_t i) const {
  uint64_t low = 0, high = sparseCount_;  // Bounds of the position of the first sparse index that is not below i.
  while (low < high) {
    const uint64_t middle = (low + high) / 2;
    wholeAt(sparseIndices_, middle) < i ? low = middle + 1 : high = middle;
  }
  if (low < sparseCount_ && wholeAt(sparseIndices_, low) == i) return sparseValues_.data + low * sparseValues_.stride;
  constexpr static std::array<char, 12> kZeros{};
  return base_.data == nullptr ? kZeros.data() : base_.data + i * base_.stride;
}

Vec3d GltfAccessor::vectorAt(uint64_t i) const {
  const char* const from = elementAt(i);
  Vec3d vector;
  const auto fill = [&]<typename T>(T) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto number = static_cast<double>(gltfNumber<T>(from + axis * sizeof(T)));
      vector[axis] =
          isNormalized_ ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : number;
    }
  };
  switch (base_.componentType) {
    case kGltfByte:
      fill(int8_t{});
      break;
    case kGltfUByte:
      fill(uint8_t{});
      break;
    case kGltfShort:
      fill(int16_t{});
      break;
    case kGltfUShort:
      fill(uint16_t{});
      break;
    default:
      fill(float{});
  }
  return vector;
}

uint32_t GltfAccessor::indexAt(uint64_t i) const {
  if (sparseCount_ == 0) return wholeAt(base_, i);
  return wholeAt({elementAt(i), 0, base_.componentType}, 0);
}

GltfFile::GltfFile(const MeshSource& source) : source_(source) {
  const std::span<const char> bytes = source.bytes;
  if (std::string_view(bytes.data(), bytes.size()).starts_with("glTF"))
    readBinary(bytes);
  else
    parseDocument(bytes);
  const GltfJson* const asset = gltfMember(document_, "asset", "glTF");
  if (asset == nullptr) failInput("JSON without 'asset' is not glTF");
  const std::string version = gltfText(*asset, "version", "asset");
  if (!version.starts_with("2."))
    failInput(fmt::format("glTF version {}; version 2.0 is read: convert the file", asdfvk::quoted(version)));
  requireKnownExtensions();
  readBuffers();
}

void GltfFile::readBinary(std::span<const char> bytes) {
  if (bytes.size() < kGlbHeaderSize + kChunkGlbHeaderSize) failInput("binary glTF is truncated in its header");
  const auto version = gltfNumber<uint32_t>(bytes.data() + 4);
  if (version != 2) failInput(fmt::format("binary glTF version {}; version 2 is read: convert the file", version));
  const uint64_t length = gltfNumber<uint32_t>(bytes.data() + 8);
  if (length != bytes.size())
    failInput(fmt::format("binary glTF has {} bytes by its header; this file has {} and {}", length, bytes.size(),
                          length > bytes.size() ? "is truncated" : "continues after its end"));
  uint64_t at = kGlbHeaderSize;
  for (uint32_t chunk = 0; at < length; ++chunk) {
    if (length - at < kChunkGlbHeaderSize) failAtByte(at, "truncated in the header of a chunk");
    const uint64_t chunkLength = gltfNumber<uint32_t>(bytes.data() + at);
    const auto type = gltfNumber<uint32_t>(bytes.data() + at + 4);
    at += kChunkGlbHeaderSize;
    if (chunkLength > length - at)
      failAtByte(at, fmt::format("a chunk of {} bytes does not fit; {} are left", chunkLength, length - at));
    const std::span<const char> contents = bytes.subspan(at, chunkLength);
    if ((chunk == 0) != (type == kJsonChunk)) failAtByte(at, "the first chunk, and no other, must be JSON");
    if (type == kJsonChunk) parseDocument(contents);
    if (type == kBinaryChunk && chunk == 1) {
      binary_ = contents;
      hasBinary_ = true;
    }
    at += chunkLength;
  }
}

void GltfFile::parseDocument(std::span<const char> text) {
  const auto limitDepth = [](int depth, GltfJson::parse_event_t, const GltfJson&) {
    if (depth > kMaxJsonDepth) failInput(fmt::format("JSON nested more than {} levels deep", kMaxJsonDepth));
    return true;
  };
  // Chunks are padded with blanks; some writers pad with zero bytes.
  while (!text.empty() && text.back() == '\0') text = text.first(text.size() - 1);
  try {
    document_ = GltfJson::parse(text.begin(), text.end(), limitDepth);
  } catch (const GltfJson::parse_error& error) {
    failInput(fmt::format("byte {} of the JSON: syntax error", error.byte));
  } catch (const GltfJson::exception&) {
    failInput("the JSON has a number out of range");
  }
}

void GltfFile::requireKnownExtensions() const {
  const GltfJson* const required = gltfArray(document_, "extensionsRequired", "glTF");
  if (required == nullptr) return;
  for (const GltfJson& entry : *required) {
    if (!entry.is_string()) failInput("extensionsRequired has an entry that is not a string");
    const std::string name = entry.get<std::string>();
    if (isHarmless(name)) continue;
    const bool isCompression = name == "KHR_draco_mesh_compression" || name.ends_with("_meshopt_compression");
    failInput(
        isCompression
            ? fmt::format("the mesh is compressed by {}, which is not supported; export it without compression", name)
            : fmt::format("requires the extension {}, which is not supported; export without it",
                          asdfvk::quoted(name)));
  }
}

void GltfFile::readBuffers() {
  const uint64_t count = countOf("buffers");
  for (uint64_t i = 0; i < count; ++i) {
    const std::string where = fmt::format("buffer {}", i);
    const GltfJson& buffer = item("buffers", i, "glTF");
    const uint64_t length = gltfWhole(buffer, "byteLength", std::nullopt, where);
    const GltfJson* const uri = gltfMember(buffer, "uri", where);
    std::span<const char> contents;
    if (uri != nullptr) {
      if (!uri->is_string()) failGltf(where, "uri is not a string");
      const auto& text = uri->get_ref<const std::string&>();
      const size_t comma = text.find(',');
      if (!text.starts_with("data:"))
        failGltf(where, fmt::format("its data is in the file {}, and no other file is ever opened; export as .glb, or "
                                    "embed the data",
                                    asdfvk::quoted(text)));
      if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
        failGltf(where, "its data URI is not base64");
      std::optional<std::vector<char>> bytes = base64Bytes(std::string_view(text).substr(comma + 1));
      if (!bytes) failGltf(where, "its data URI is not base64");
      decoded_.push_back(std::move(*bytes));
      contents = decoded_.back();
    } else if (i == 0 && hasBinary_) {
      contents = binary_;
    } else {
      // A compressed view may refer to a buffer without data. Any other use of this buffer is an error.
      buffers_.emplace_back();
      continue;
    }
    if (length > contents.size())
      failGltf(where, fmt::format("byteLength {}; its data has {} bytes", length, contents.size()));
    buffers_.push_back(contents.first(length));
  }
}

uint64_t GltfFile::countOf(const char* array) const {
  const GltfJson* const items = gltfArray(document_, array, "glTF");
  return items == nullptr ? 0 : items->size();
}

const GltfJson& GltfFile::item(const char* array, uint64_t index, std::string_view where) const {
  const GltfJson* const items = gltfArray(document_, array, "glTF");
  const uint64_t count = items == nullptr ? 0 : items->size();
  if (index >= count) failGltf(where, fmt::format("entry {} of {} is out of range; there are {}", index, array, count));
  return (*items)[index];
}

std::span<const char> GltfFile::viewOf(uint64_t index, uint64_t& stride, std::string_view where) const {
  const GltfJson& view = item("bufferViews", index, where);
  const std::string name = fmt::format("buffer view {}", index);
  const uint64_t buffer = gltfWhole(view, "buffer", std::nullopt, name);
  const uint64_t offset = gltfWhole(view, "byteOffset", 0, name);
  const uint64_t length = gltfWhole(view, "byteLength", std::nullopt, name);
  stride = gltfWhole(view, "byteStride", stride, name);
  (void)item("buffers", buffer, name);
  const std::span<const char> bytes = buffers_[buffer];
  if (bytes.empty()) failGltf(name, fmt::format("buffer {} has no data in this file", buffer));
  if (offset > bytes.size() || length > bytes.size() - offset)
    failGltf(name, fmt::format("bytes {} to {} + {} are beyond the {} of buffer {}", offset, offset, length,
                               bytes.size(), buffer));
  return bytes.subspan(offset, length);
}

GltfAccessor::Elements GltfFile::elementsOf(const GltfJson& holder, uint64_t count, uint32_t componentType,
                                            uint32_t componentCount, bool hasStride, std::string_view where) const {
  const uint64_t elementSize = uint64_t{gltfSizeOf(componentType)} * componentCount;
  uint64_t stride = elementSize;
  const std::span<const char> bytes = viewOf(gltfWhole(holder, "bufferView", std::nullopt, where), stride, where);
  if (!hasStride) stride = elementSize;
  const uint64_t offset = gltfWhole(holder, "byteOffset", 0, where);
  constexpr uint64_t kMaxStride = 252;
  if (stride < elementSize || stride > kMaxStride) failGltf(where, fmt::format("byteStride {}", stride));
  if (offset > bytes.size() || elementSize > bytes.size() - offset ||
      count - 1 > (bytes.size() - offset - elementSize) / stride)
    failGltf(where, fmt::format("{} do not fit into the {} bytes of its buffer view", counted(count, "element"),
                                bytes.size()));
  return {bytes.data() + offset, stride, componentType};
}

GltfAccessor GltfFile::open(uint64_t index, const char* type, uint32_t componentCount, bool isIndex) const {
  const std::string where = fmt::format("accessor {}", index);
  const GltfJson& json = item("accessors", index, "glTF");
  if (const std::string found = gltfText(json, "type", where); found != type)
    failGltf(where, fmt::format("has the type {} instead of {}", asdfvk::quoted(found), type));
  const uint64_t component = gltfWhole(json, "componentType", std::nullopt, where);
  const bool isAllowed = isIndex ? component == kGltfUByte || component == kGltfUShort || component == kGltfUInt
                                 : (component >= kGltfByte && component <= kGltfUShort) || component == kGltfFloat;
  if (!isAllowed) failGltf(where, fmt::format("componentType {} is not allowed here", component));
  GltfAccessor accessor;
  accessor.count_ = gltfWhole(json, "count", std::nullopt, where);
  if (accessor.count_ == 0) failGltf(where, "has no elements");
  const GltfJson* const normalized = gltfMember(json, "normalized", where);
  accessor.isNormalized_ = normalized != nullptr && normalized->is_boolean() && normalized->get<bool>() &&
                           component != kGltfFloat && component != kGltfUInt;
  const GltfJson* const sparse = gltfMember(json, "sparse", where);
  if (sparse == nullptr || gltfMember(json, "bufferView", where) != nullptr) {
    accessor.base_ =
        elementsOf(json, accessor.count_, static_cast<uint32_t>(component), componentCount, !isIndex, where);
  } else {
    // Elements that are not sparse are 0. The limit prevents large meshes from small files.
    if (accessor.count_ > source_.bytes.size())
      failGltf(where, "has more elements without a buffer view than the file has bytes");
    accessor.base_.componentType = static_cast<uint32_t>(component);
  }
  if (sparse == nullptr) return accessor;

  accessor.sparseCount_ = gltfWhole(*sparse, "count", std::nullopt, where);
  const GltfJson* const places = gltfMember(*sparse, "indices", where);
  const GltfJson* const values = gltfMember(*sparse, "values", where);
  if (places == nullptr || values == nullptr || accessor.sparseCount_ == 0 || accessor.sparseCount_ > accessor.count_)
    failGltf(where, "its sparse part is incomplete");
  const uint64_t placeType = gltfWhole(*places, "componentType", std::nullopt, where);
  if (placeType != kGltfUByte && placeType != kGltfUShort && placeType != kGltfUInt)
    failGltf(where, "the componentType of its sparse indices is not allowed");
  accessor.sparseIndices_ =
      elementsOf(*places, accessor.sparseCount_, static_cast<uint32_t>(placeType), 1, false, where);
  accessor.sparseValues_ =
      elementsOf(*values, accessor.sparseCount_, static_cast<uint32_t>(component), componentCount, false, where);
  for (uint64_t i = 0; i < accessor.sparseCount_; ++i) {
    const uint32_t place = GltfAccessor::wholeAt(accessor.sparseIndices_, i);
    if (place >= accessor.count_ || (i > 0 && place <= GltfAccessor::wholeAt(accessor.sparseIndices_, i - 1)))
      failGltf(where, "its sparse indices do not ascend, or are out of range");
  }
  return accessor;
}

GltfAccessor GltfFile::vectors(uint64_t accessor) const { return open(accessor, "VEC3", 3, false); }
GltfAccessor GltfFile::indices(uint64_t accessor) const { return open(accessor, "SCALAR", 1, true); }

}  // namespace asdfvk
