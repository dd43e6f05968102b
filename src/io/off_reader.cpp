// The Object File Format of Geomview in ASCII: the optional keyword [ST][C][N]OFF, the counts, one vertex per line, and
// the faces. The numbers after the coordinates of a vertex (texture coordinates, a colour, a normal) must agree with
// the prefixes of the keyword, but are ignored. The colour of a face, up to four numbers, is ignored too.
#include <fmt/core.h>

#include <optional>

#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/text_scanner.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

/// The keyword of an OFF file, and the numbers after the coordinates of each vertex.
struct OffHeader {
  std::string_view keyword = "OFF";
  bool hasColours = false;          ///< A vertex has 3 or 4 numbers for a colour.
  bool hasNormals = false;          ///< A vertex has 3 numbers for a normal.
  bool hasTexture = false;          ///< A vertex has 2 numbers for texture coordinates.
  bool hasFourCoordinates = false;  ///< The keyword contains 4OFF, nOFF or 4nOFF.

  [[nodiscard]] bool allowsExtraCount(uint64_t count) const {
    const uint64_t fixed = (hasNormals ? 3u : 0u) + (hasTexture ? 2u : 0u);
    return hasColours ? count == fixed + 3 || count == fixed + 4 : count == fixed;
  }
};

/// Accepts a digit directly after the keyword ("OFF3 1 0" occurs in files), and prefixes in any order, because programs
/// write different orders.
std::optional<OffHeader> parseKeyword(std::string_view word) {
  const size_t at = word.find("OFF");
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = word.substr(at + 3);
  if (!rest.empty() && !(rest[0] >= '0' && rest[0] <= '9')) return std::nullopt;
  OffHeader header;
  header.keyword = word.substr(0, at + 3);
  for (std::string_view prefixes = word.substr(0, at); !prefixes.empty();) {
    bool* flag = nullptr;
    size_t length = 1;
    if (prefixes.starts_with("ST")) {
      flag = &header.hasTexture;
      length = 2;
    } else if (prefixes[0] == 'C') {
      flag = &header.hasColours;
    } else if (prefixes[0] == 'N') {
      flag = &header.hasNormals;
    } else if (prefixes[0] == '4' || prefixes[0] == 'n') {
      flag = &header.hasFourCoordinates;
    }
    if (flag == nullptr || (*flag && flag != &header.hasFourCoordinates)) return std::nullopt;
    *flag = true;
    prefixes.remove_prefix(length);
  }
  return header;
}

/// Reads the header up to the counts. A file without the keyword begins with its counts.
OffHeader readHeader(TextScanner& text) {
  TextScanner ahead = text;
  const std::string_view word = ahead.word("OFF");
  const std::optional<OffHeader> header = parseKeyword(word);
  if (!header) {
    if (word[0] >= '0' && word[0] <= '9') return {};
    failAtLine(ahead.line(), fmt::format("expected OFF or the vertex count, found {}", quoted(word)));
  }
  if (header->hasFourCoordinates)
    failAtLine(ahead.line(), fmt::format("{} does not have three coordinates per vertex", quoted(word)));
  static_cast<void>(text.atEnd());
  text.skipBytes(header->keyword.size());
  TextScanner next = text;
  if (!next.atLineEnd() && next.wordOnLine() == "BINARY")
    failAtLine(next.line(), "binary OFF is not supported; convert the mesh to PLY");
  return *header;
}

uint64_t readCount(TextScanner& text, std::string_view name) {
  const int64_t count = text.integer(name);
  if (count < 0) failAtLine(text.line(), fmt::format("{} is negative: {}", name, count));
  return static_cast<uint64_t>(count);
}

uint64_t skipNumbersOnLine(TextScanner& text, std::string_view expected) {
  uint64_t count = 0;
  for (; !text.atLineEnd(); ++count) static_cast<void>(text.number(expected));
  return count;
}

void readVertices(TextScanner& text, const OffHeader& header, uint64_t count, std::vector<Vec3d>& vertices) {
  vertices.reserve(count);
  for (uint64_t i = 0; i < count; ++i) {
    Vec3d& p = vertices.emplace_back();
    p.x = text.number("a vertex coordinate");
    p.y = text.number("a vertex coordinate");
    p.z = text.number("a vertex coordinate");
    const uint64_t extraCount = skipNumbersOnLine(text, "a number of a vertex");
    if (!header.allowsExtraCount(extraCount))
      failAtLine(text.line(), fmt::format("vertex {} has {} numbers after its coordinates, which contradicts the "
                                          "keyword {}; COFF has colours, NOFF normals, STOFF texture coordinates",
                                          i, extraCount, header.keyword));
  }
}

void readFaces(TextScanner& text, uint64_t count, uint64_t vertexCount, InputFaces& faces) {
  faces.reserve(count);
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t cornerCount = readCount(text, "the corner count of a face");
    if (cornerCount > text.remaining())
      failAtLine(text.line(), fmt::format("face {} with {} does not fit into the remaining {}; the file is truncated "
                                          "or the corner count is wrong",
                                          i, counted(cornerCount, "corner"), counted(text.remaining(), "byte")));
    corners.clear();
    for (uint64_t c = 0; c < cornerCount; ++c) {
      const int64_t index = text.integer("a vertex index");
      if (index < 0 || static_cast<uint64_t>(index) >= vertexCount)
        failAtLine(text.line(), fmt::format("vertex index {} of face {} is out of range; the mesh has {}", index, i,
                                            counted(vertexCount, "vertex", "vertices")));
      corners.push_back(static_cast<uint32_t>(index));
    }
    if (skipNumbersOnLine(text, "a colour number") > 4)
      failAtLine(text.line(), fmt::format("more than four numbers after the corners of face {}", i));
    faces.add(corners);
  }
}

Match detectOff(std::span<const char> bytes) {
  return parseKeyword(firstWord(bytes, '#')) ? Match::Certain : Match::None;
}

Mesh parseOff(const MeshSource& source) {
  TextScanner text(source.bytes, {.comment = '#'});
  const OffHeader header = readHeader(text);
  const uint64_t vertexCount = readCount(text, "the vertex count");
  const uint64_t faceCount = readCount(text, "the face count");
  if (!text.atLineEnd()) static_cast<void>(readCount(text, "the edge count"));
  text.requireLineEnd("the counts");
  // The shortest line of a vertex, "0 0 0", has six bytes with its line break; the shortest line of a face, "0", has
  // two. The last line may have no line break.
  const uint64_t remaining = text.remaining() + 1;
  if (vertexCount > remaining / 6 || faceCount > (remaining - 6 * vertexCount) / 2)
    failAtLine(text.line(), fmt::format("{} and {} do not fit into the remaining {}; "
                                        "the file is truncated or the counts are wrong",
                                        counted(vertexCount, "vertex", "vertices"), counted(faceCount, "face"),
                                        counted(text.remaining(), "byte")));
  requireAtMost(kMaxIndexCount, vertexCount, "vertices");
  Mesh mesh;
  InputFaces faces;
  readVertices(text, header, vertexCount, mesh.vertices);
  readFaces(text, faceCount, vertexCount, faces);
  text.requireEnd("the last face");
  faces.moveTo(mesh);
  return mesh;
}

}  // namespace

extern const FileFormat kOffFormat{
    .name = "off", .extensions = {"off", "coff", "noff"}, .detect = detectOff, .parseMesh = parseOff};

}  // namespace asdfvk
