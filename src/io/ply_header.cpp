#include "io/ply_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/text.h"
#include "io/input_failure.h"
#include "io/text_scanner.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

std::optional<PlyType> plyTypeNamed(std::string_view word) {
  struct Name {
    std::string_view word;
    PlyType type;
  };
  constexpr auto kNames = std::to_array<Name>({
      {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::UInt8},
      {"uint8", PlyType::UInt8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
      {"ushort", PlyType::UInt16},  {"uint16", PlyType::UInt16},   {"int", PlyType::Int32},
      {"int32", PlyType::Int32},    {"uint", PlyType::UInt32},     {"uint32", PlyType::UInt32},
      {"int64", PlyType::Int64},    {"long", PlyType::Int64},      {"uint64", PlyType::UInt64},
      {"ulong", PlyType::UInt64},   {"float", PlyType::Float32},   {"float32", PlyType::Float32},
      {"double", PlyType::Float64}, {"float64", PlyType::Float64},
  });
  if (word.ends_with("_t")) word.remove_suffix(2);
  const auto found = std::find_if(kNames.begin(), kNames.end(), [&](const Name& name) { return name.word == word; });
  return found == kNames.end() ? std::nullopt : std::optional(found->type);
}

PlyType typeOf(std::string_view word, uint64_t line) {
  const std::optional<PlyType> type = plyTypeNamed(word);
  if (!type) failAtLine(line, fmt::format("{} is not a PLY type", quoted(word)));
  return *type;
}

void setOnce(size_t& property, size_t value, const PlyElement& element) {
  if (property != kNoProperty)
    failInput(fmt::format("element {} has two properties for {}", quoted(element.name),
                          quoted(element.properties[value].name)));
  property = value;
}

void findCoordinates(PlyElement& element) {
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  for (size_t i = 0; i < element.properties.size(); ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      if (element.properties[i].name == kNames[axis]) setOnce(element.coordinates[axis], i, element);
  for (size_t axis = 0; axis < 3; ++axis) {
    if (element.coordinates[axis] == kNoProperty)
      failInput(fmt::format("element 'vertex' has no property {}", kNames[axis]));
    if (element.properties[element.coordinates[axis]].list)
      failInput(fmt::format("property {} of element 'vertex' is a list; it must be a number", kNames[axis]));
  }
}

void findIndices(PlyElement& element) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const std::string_view name = element.properties[i].name;
    if (name == "vertex_indices" || name == "vertex_index") setOnce(element.indices, i, element);
  }
  if (element.indices == kNoProperty)
    failInput(fmt::format("element {} has no list vertex_indices", quoted(element.name)));
  const PlyProperty& property = element.properties[element.indices];
  if (!property.list || !isInteger(property.type))
    failInput(fmt::format("property {} of element {} must be a list of integers", quoted(property.name),
                          quoted(element.name)));
}

/// Sets the roles of the elements that form the mesh; returns the vertex count.
uint64_t assignRoles(std::span<PlyElement> elements) {
  const PlyElement* vertices = nullptr;
  const PlyElement* faces = nullptr;
  const PlyElement* strips = nullptr;
  const auto assign = [](const PlyElement*& slot, PlyElement& element, PlyRole role) {
    if (slot != nullptr) failInput(fmt::format("the header has two elements {}", quoted(element.name)));
    slot = &element;
    element.role = role;
    role == PlyRole::Vertices ? findCoordinates(element) : findIndices(element);
  };
  for (PlyElement& element : elements) {
    if (element.name == "vertex") assign(vertices, element, PlyRole::Vertices);
    if (element.name == "face") assign(faces, element, PlyRole::Faces);
    if (element.name == "tristrips") assign(strips, element, PlyRole::Strips);
  }
  if (vertices == nullptr) failInput("has no element 'vertex'");
  if (faces == nullptr && strips == nullptr)
    failInput(
        fmt::format("has {} and no element 'face': a point cloud, not a mesh", counted(vertices->count, "point")));
  requireAtMost(kMaxIndexCount, vertices->count, "vertices");
  return vertices->count;
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
  /// Returns false at end_header.
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
      while (!text_.wordOnLine().empty()) {
      }
    } else {
      skipUnknownLine(keyword);
    }
    return true;
  }

  /// Skips a line that the format does not define, such as a comment without the keyword. Refuses a line that may be a
  /// misspelt property, or a misspelt element because properties follow.
  void skipUnknownLine(std::string_view keyword) {
    if (!unknown_) unknown_ = {text_.line(), keyword};
    ++unknownLineCount_;
    const std::string_view second = text_.wordOnLine();
    if (second == "list" || plyTypeNamed(second)) failAtUnknownLine();
    while (!text_.wordOnLine().empty()) {
    }
  }

  [[noreturn]] void failAtUnknownLine() const {
    failAtLine(unknown_->first, fmt::format("{} is not a PLY header keyword", quoted(unknown_->second)));
  }

  std::string_view wordOnLine(std::string_view expected) {
    const std::string_view word = text_.wordOnLine();
    if (word.empty()) failAtLine(text_.line(), fmt::format("{} is missing", expected));
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
      failAtLine(text_.line(), fmt::format("{} is not a PLY encoding", quoted(encoding)));
    }
    const std::string_view version = wordOnLine("the version");
    if (version == "1.1")
      header_.skipped.emplace_back("version number 1.1 (the only version of PLY is 1.0)");
    else if (version != "1.0")
      failAtLine(text_.line(), fmt::format("PLY version {} is not supported", quoted(version)));
  }

  void parseElement() {
    unknown_.reset();
    PlyElement& element = header_.elements.emplace_back();
    element.name = wordOnLine("the name of the element");
    if (text_.atLineEnd()) failAtLine(text_.line(), "the count of the element is missing");
    const int64_t count = text_.integer("the count of the element");
    if (count < 0) failAtLine(text_.line(), fmt::format("the count of the element is negative: {}", count));
    element.count = static_cast<uint64_t>(count);
  }

  void parseProperty() {
    if (unknown_) failAtUnknownLine();
    if (header_.elements.empty()) failAtLine(text_.line(), "a property before the first element");
    PlyElement& element = header_.elements.back();
    PlyProperty& property = element.properties.emplace_back();
    property.offset = element.rowSize;
    std::string_view type = wordOnLine("the type of the property");
    if (type == "list") {
      property.list = typeOf(wordOnLine("the type of the list length"), text_.line());
      if (!isInteger(*property.list)) failAtLine(text_.line(), "the length of a list must have an integer type");
      type = wordOnLine("the type of the list items");
    }
    property.type = typeOf(type, text_.line());
    property.name = wordOnLine("the name of the property");
    element.rowSize += sizeOf(property.list.value_or(property.type));
    element.listCount += property.list ? 1 : 0;
  }

  void finish() {
    if (!hasFormat_) failAtLine(text_.line(), "the header ends without a format line");
    const uint64_t length = breakLength();
    header_.bodyOffset = static_cast<uint64_t>(text_.position() - bytes_.data()) + length;
    header_.bodyLine = text_.line() + (length > 0 ? 1 : 0);
    header_.vertexCount = assignRoles(header_.elements);
    if (unknownLineCount_ > 0) header_.skipped.push_back(counted(unknownLineCount_, "unknown header line"));
  }

  /// Returns the number of bytes of the next line break. If lines end with CR alone, an LF after end_header belongs to
  /// the body.
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
  uint64_t unknownLineCount_ = 0;
  /// Line and first word of the first unknown line since the last element.
  std::optional<std::pair<uint64_t, std::string_view>> unknown_;
};

}  // namespace

PlyHeader parsePlyHeader(std::span<const char> bytes) { return HeaderParser(bytes).parse(); }

}  // namespace asdfvk
