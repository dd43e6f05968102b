// The fields of the unstructured grids that writeVtu() writes: one piece, arrays as inline base64 without compression.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/stored_fields.h"
#include "io/text_scanner.h"

namespace asdfvk {

void writeVtu(AtomicFile& file, const ResultView& result);  // vtu_writer.cpp

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are read by copying their bytes");

bool isBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// A start tag, or an end tag, whose name begins with '/'.
struct Tag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  bool isEmpty = false;  ///< <NAME/>
  uint64_t byte = 0;     ///< Position in the file.

  /// Empty where there is no such attribute.
  [[nodiscard]] std::string_view attribute(std::string_view key) const {
    for (const auto& [attributeName, value] : attributes)
      if (attributeName == key) return value;
    return {};
  }
  void requireAttribute(std::string_view key, std::string_view value) const {
    if (attribute(key) != value)
      failAtByte(byte, fmt::format("attribute {} of {} is {}; only '{}' is supported", key, printable(name),
                                   quoted(attribute(key)), value));
  }
};

/// Tags and the text between them; without comments, entities and CDATA sections.
class TagScanner {
 public:
  explicit TagScanner(std::span<const char> bytes) : bytes_(bytes.data(), bytes.size()) {}

  Tag next() {
    skipBlanks();
    if (bytes_.substr(at_).starts_with("<?")) {
      const size_t end = bytes_.find("?>", at_);
      if (end == std::string_view::npos) failTruncated();
      at_ = end + 2;
      skipBlanks();
    }
    Tag tag;
    tag.byte = at_;
    if (peek() != '<') failAtByte(at_, "expected a tag");
    ++at_;
    tag.name = word(" \t\r\n>/", peek() == '/' ? 1 : 0);
    for (skipBlanks(); peek() != '>' && peek() != '/'; skipBlanks()) {
      const std::string_view key = word(" \t\r\n>/=", 0);
      if (peek() != '=') failAtByte(at_, "expected = and the value of an attribute");
      ++at_;
      if (peek() != '"') failAtByte(at_, "expected the value of an attribute in quotation marks");
      ++at_;
      const std::string_view value = word("\"", 0);
      ++at_;
      tag.attributes.emplace_back(key, value);
    }
    if (peek() == '/') {
      tag.isEmpty = true;
      ++at_;
    }
    if (peek() != '>') failAtByte(at_, "expected > at the end of a tag");
    ++at_;
    return tag;
  }

  Tag next(std::string_view name) {
    Tag tag = next();
    if (tag.name != name) failAtByte(tag.byte, fmt::format("expected <{}>, found <{}>", name, printable(tag.name)));
    return tag;
  }

  /// The text up to the next tag, without blanks at both ends.
  std::string_view text() {
    skipBlanks();
    const size_t end = bytes_.find('<', at_);
    if (end == std::string_view::npos) failTruncated();
    std::string_view text = bytes_.substr(at_, end - at_);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    at_ = end;
    return text;
  }

  void requireEnd() {
    skipBlanks();
    if (at_ != bytes_.size()) failAtByte(at_, "unexpected text after the last tag");
  }

  /// Position of a view into the file.
  [[nodiscard]] uint64_t byteOf(std::string_view text) const {
    return static_cast<uint64_t>(text.data() - bytes_.data());
  }

 private:
  [[noreturn]] void failTruncated() const { failAtByte(bytes_.size(), "the file ends within a tag; it is truncated"); }

  void skipBlanks() {
    while (at_ < bytes_.size() && isBlank(bytes_[at_])) ++at_;
  }
  [[nodiscard]] char peek() const {
    if (at_ == bytes_.size()) failTruncated();
    return bytes_[at_];
  }
  /// Up to the first of the ends, which is searched after `skipCount` characters.
  std::string_view word(std::string_view ends, size_t skipCount) {
    const size_t end = bytes_.find_first_of(ends, at_ + skipCount);
    if (end == std::string_view::npos) failTruncated();
    const std::string_view word = bytes_.substr(at_, end - at_);
    at_ = end;
    return word;
  }

  std::string_view bytes_;
  size_t at_ = 0;
};

/// Base64 (RFC 4648) with padding. byte: the position of the text in the file.
std::vector<char> decodeBase64(std::string_view text, uint64_t byte) {
  static const std::array<int8_t, 256> kValues = [] {
    std::array<int8_t, 256> values{};
    values.fill(-1);
    int8_t value = 0;
    for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
      values[static_cast<unsigned char>(c)] = value++;
    return values;
  }();
  if (text.size() % 4 != 0) failAtByte(byte, "the length of a base64 text is not a multiple of 4");
  const size_t paddingCount = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  std::vector<char> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (size_t i = 0; i < text.size(); i += 4) {
    const bool isLast = i + 4 == text.size();
    uint32_t bits = 0;
    for (size_t k = 0; k < 4; ++k) {
      const bool isPadding = isLast && k >= 4 - paddingCount;
      const int value = isPadding ? 0 : kValues[static_cast<unsigned char>(text[i + k])];
      if (value < 0)
        failAtByte(byte + i + k, fmt::format("{} is not a base64 character", quoted(text.substr(i + k, 1))));
      bits = bits << 6 | static_cast<uint32_t>(value);
    }
    for (size_t k = 0; k < (isLast ? 3 - paddingCount : 3); ++k)
      bytes.push_back(static_cast<char>(bits >> (16 - 8 * k) & 0xff));
  }
  return bytes;
}

class VtuReader {
 public:
  explicit VtuReader(std::span<const char> bytes) : tags_(bytes) {}

  std::vector<Field> read() {
    const Tag file = tags_.next("VTKFile");
    file.requireAttribute("type", "UnstructuredGrid");
    file.requireAttribute("byte_order", "LittleEndian");
    file.requireAttribute("compressor", "");
    hasWideSizes_ = file.attribute("header_type") == "UInt64";
    if (!hasWideSizes_) file.requireAttribute("header_type", "UInt32");
    tags_.next("UnstructuredGrid");
    const Tag piece = tags_.next("Piece");
    const uint64_t pointCount = numberOf(piece, "NumberOfPoints"), cellCount = numberOf(piece, "NumberOfCells");
    for (Tag section = tags_.next(); section.name != "/Piece"; section = tags_.next()) {
      if (section.isEmpty) continue;
      if (section.name == "PointData") {
        readFields(FieldLocation::PerVertex, pointCount, "/PointData");
      } else if (section.name == "CellData") {
        readFields(FieldLocation::PerFace, cellCount, "/CellData");
      } else {
        skipSection(section);
      }
    }
    tags_.next("/UnstructuredGrid");
    tags_.next("/VTKFile");
    tags_.requireEnd();
    requireReadableNames(fields_);
    return std::move(fields_);
  }

 private:
  static uint64_t numberOf(const Tag& tag, std::string_view key) {
    const std::string_view text = tag.attribute(key);
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
      failAtByte(tag.byte,
                 fmt::format("attribute {} of {} is {}, not a count", key, printable(tag.name), quoted(text)));
    return number;
  }

  void skipSection(const Tag& section) {
    if (section.name.starts_with('/'))
      failAtByte(section.byte, fmt::format("unexpected <{}>", printable(section.name)));
    const std::string end = "/" + std::string(section.name);
    while (tags_.next().name != end) static_cast<void>(tags_.text());
  }

  void readFields(FieldLocation location, uint64_t itemCount, std::string_view end) {
    for (Tag tag = tags_.next(); tag.name != end; tag = tags_.next()) {
      if (tag.name != "DataArray")
        failAtByte(tag.byte, fmt::format("expected <DataArray>, found <{}>", printable(tag.name)));
      fields_.push_back(readField(tag, location, itemCount));
      tags_.next("/DataArray");
    }
  }

  Field readField(const Tag& tag, FieldLocation location, uint64_t itemCount) {
    tag.requireAttribute("format", "binary");
    Field field;
    field.name = tag.attribute("Name");
    field.location = location;
    if (!tag.attribute("NumberOfComponents").empty()) {
      const uint64_t count = numberOf(tag, "NumberOfComponents");
      if (count != 1 && count != 3) failAtByte(tag.byte, fmt::format("an array has {} components, not 1 or 3", count));
      field.componentCount = static_cast<uint32_t>(count);
    }
    const std::string_view text = tags_.text();
    const std::vector<char> decoded = decodeBase64(text, tags_.byteOf(text));
    const size_t sizeSize = hasWideSizes_ ? sizeof(uint64_t) : sizeof(uint32_t);
    if (decoded.size() < sizeSize) failAtByte(tag.byte, "an array is shorter than its byte count; it is truncated");
    uint64_t byteCount = 0;
    std::memcpy(&byteCount, decoded.data(), sizeSize);
    const std::span<const char> entries = std::span(decoded).subspan(sizeSize);
    if (byteCount != entries.size())
      failAtByte(tag.byte,
                 fmt::format("an array has {}; its header says {}", counted(entries.size(), "byte"), byteCount));
    const std::string_view type = tag.attribute("type");
    size_t entrySize = sizeof(uint32_t);
    if (type == "Float32") {
      field.values = storedEntries<float>(entries);
    } else if (type == "UInt32") {
      field.values = storedEntries<uint32_t>(entries);
    } else if (type == "UInt8") {
      field.values = storedEntries<uint8_t>(entries);
      entrySize = sizeof(uint8_t);
    } else {
      failAtByte(tag.byte, fmt::format("arrays of type {} are not supported", quoted(type)));
    }
    if (entries.size() % entrySize != 0 || field.size() % field.componentCount != 0 || field.itemCount() != itemCount)
      failAtByte(tag.byte, fmt::format("array {} has {} of {} and {}; the piece has {} items",
                                       asdfvk::quoted(field.name), counted(entries.size(), "byte"), type,
                                       counted(field.componentCount, "component"), itemCount));
    return field;
  }

  TagScanner tags_;
  std::vector<Field> fields_;
  bool hasWideSizes_ = false;
};

Match detectVtu(std::span<const char> bytes) {
  const std::string_view beginning(bytes.data(), std::min<size_t>(bytes.size(), 256));
  return beginning.starts_with('<') && beginning.find("<VTKFile") != std::string_view::npos ? Match::Certain
                                                                                            : Match::None;
}

std::vector<Field> parseVtuFields(std::span<const char> bytes) { return VtuReader(bytes).read(); }

}  // namespace

extern const FileFormat kVtuFormat{
    .name = "vtu", .extensions = {"vtu"}, .detect = detectVtu, .parseFields = parseVtuFields, .write = writeVtu};

}  // namespace asdfvk
