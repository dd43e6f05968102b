#include "io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/input_faces.h"
#include "io/input_failure.h"
#include "io/ply_roles.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

PlyType typeOf(std::string_view word, uint64_t line) {
  struct Name {
    std::string_view word;
    PlyType type;
  };
  constexpr auto kNames = std::to_array<Name>({
      {"char", PlyType::Int8},
      {"int8", PlyType::Int8},
      {"uchar", PlyType::UInt8},
      {"uint8", PlyType::UInt8},
      {"short", PlyType::Int16},
      {"int16", PlyType::Int16},
      {"ushort", PlyType::UInt16},
      {"uint16", PlyType::UInt16},
      {"int", PlyType::Int32},
      {"int32", PlyType::Int32},
      {"uint", PlyType::UInt32},
      {"uint32", PlyType::UInt32},
      {"float", PlyType::Float32},
      {"float32", PlyType::Float32},
      {"double", PlyType::Float64},
      {"float64", PlyType::Float64},
  });
  const auto found = std::find_if(kNames.begin(), kNames.end(), [&](const Name& name) { return name.word == word; });
  if (found == kNames.end()) failAtLine(line, fmt::format("{} is no PLY type", quoted(word)));
  return found->type;
}

class HeaderParser {
 public:
  explicit HeaderParser(std::span<const char> bytes) : bytes_(bytes), text_(bytes) {}

  PlyHeader parse() {
    if (text_.word("ply") != "ply") failAtLine(text_.line(), "a PLY file begins with 'ply'");
    text_.requireLineEnd("ply");
    hasCrLines_ = breakLength() == 1 && *text_.position() == '\r';
    while (parseLine()) text_.requireLineEnd("this header line");
    text_.requireLineEnd("end_header");
    finish();
    return std::move(header_);
  }

 private:
  /// False at end_header.
  bool parseLine() {
    const std::string_view keyword = text_.word("end_header");
    if (keyword == "end_header") return false;
    if (keyword == "format") {
      parseFormat();
    } else if (keyword == "element") {
      parseElement();
    } else if (keyword == "property") {
      parseProperty();
    } else if (keyword == "comment" || keyword == "obj_info") {
      while (!text_.wordOnLine().empty()) continue;
    } else {
      failAtLine(text_.line(), fmt::format("{} is no PLY header keyword", quoted(keyword)));
    }
    return true;
  }

  std::string_view wordOnLine(std::string_view what) {
    const std::string_view word = text_.wordOnLine();
    if (word.empty()) failAtLine(text_.line(), fmt::format("{} is missing", what));
    return word;
  }

  void parseFormat() {
    if (hasFormat_) failAtLine(text_.line(), "a second format line");
    hasFormat_ = true;
    const std::string_view encoding = wordOnLine("the encoding");
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::Ascii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::BinaryLittleEndian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::BinaryBigEndian;
    } else {
      failAtLine(text_.line(), fmt::format("{} is no PLY encoding", quoted(encoding)));
    }
    const std::string_view version = wordOnLine("the version");
    if (version != "1.0") failAtLine(text_.line(), fmt::format("PLY version {} is unknown", quoted(version)));
  }

  void parseElement() {
    PlyElement& element = header_.elements.emplace_back();
    element.name = wordOnLine("the element's name");
    if (text_.atLineEnd()) failAtLine(text_.line(), "the element's count is missing");
    const int64_t count = text_.integer("the element's count");
    if (count < 0) failAtLine(text_.line(), fmt::format("the element's count is negative: {}", count));
    element.count = static_cast<uint64_t>(count);
  }

  void parseProperty() {
    if (header_.elements.empty()) failAtLine(text_.line(), "a property stands before any element");
    PlyProperty& property = header_.elements.back().properties.emplace_back();
    std::string_view type = wordOnLine("the property's type");
    if (type == "list") {
      property.list = typeOf(wordOnLine("the type of the list's count"), text_.line());
      if (!isInteger(*property.list)) failAtLine(text_.line(), "a list's count must have an integer type");
      type = wordOnLine("the type of the list's items");
    }
    property.type = typeOf(type, text_.line());
    property.name = wordOnLine("the property's name");
  }

  void finish() {
    if (!hasFormat_) failAtLine(text_.line(), "the header ends without a format line");
    const uint64_t length = breakLength();
    header_.bodyOffset = static_cast<uint64_t>(text_.position() - bytes_.data()) + length;
    header_.bodyLine = text_.line() + (length > 0 ? 1 : 0);
    header_.vertexCount = assignPlyRoles(header_.elements);
  }

  /// Bytes of the line break ahead. Where lines end with CR alone, an LF behind end_header is the first byte of the
  /// body.
  [[nodiscard]] uint64_t breakLength() const {
    if (text_.remaining() == 0) return 0;
    const char* at = text_.position();
    return *at == '\r' && !hasCrLines_ && text_.remaining() > 1 && at[1] == '\n' ? 2 : 1;
  }

  std::span<const char> bytes_;
  TextScanner text_;
  PlyHeader header_;
  bool hasFormat_ = false;
  bool hasCrLines_ = false;
};

}  // namespace

uint64_t PlyElement::minRowSize(PlyEncoding encoding) const {
  if (encoding == PlyEncoding::Ascii) return 2 * properties.size();  // A digit and a blank for a number or a count.
  uint64_t size = 0;
  for (const PlyProperty& property : properties) size += sizeOf(property.list.value_or(property.type));
  return size;
}

PlyHeader parsePlyHeader(std::span<const char> bytes) { return HeaderParser(bytes).parse(); }

}  // namespace asdfvk
