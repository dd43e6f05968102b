// STL, in ASCII or binary. A binary file is recognised by the exact size that its face count implies. STL has no
// indices. Corners at the same point become one vertex, because without common vertices no face would have a neighbour.
// The reader ignores normals and attribute bytes: the order of the corners decides which side is outside.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "core/text.h"
#include "io/corner_welder.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/text_scanner.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read by copying its bytes");

constexpr uint64_t kHeaderSize = 84;  // 80 arbitrary bytes, then the face count.
constexpr uint64_t kFaceSize = 50;    // The normal and the corners in float32, then two attribute bytes.

/// Precondition: at least kHeaderSize bytes.
uint64_t binaryFaceCount(std::span<const char> bytes) {
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderSize - sizeof count, sizeof count);
  return count;
}

/// Whether the size is exactly the size of a binary STL with this face count. A text never has this size, because four
/// printable bytes mean a count of more than 500 million faces.
bool hasBinarySize(std::span<const char> bytes) {
  return bytes.size() >= kHeaderSize && bytes.size() == kHeaderSize + binaryFaceCount(bytes) * kFaceSize;
}

bool beginsWithSolid(std::span<const char> bytes) { return lowerCase(firstWord(bytes).substr(0, 6)) == "solid"; }

Mesh weldedMesh(CornerWelder& welder, std::vector<Face>&& triangles) {
  Mesh mesh;
  mesh.vertices = std::move(welder.points());
  InputFaces faces;
  faces.addTriangles(std::move(triangles));
  faces.moveTo(mesh);
  return mesh;
}

Mesh parseBinary(std::span<const char> bytes) {
  if (!hasBinarySize(bytes)) {
    if (bytes.size() < kHeaderSize)
      failInput(
          fmt::format("neither ASCII STL, which begins with 'solid', nor binary STL, which has at least {} bytes; this "
                      "file has {}",
                      kHeaderSize, bytes.size()));
    const uint64_t faceCount = binaryFaceCount(bytes), expectedSize = kHeaderSize + faceCount * kFaceSize;
    failInput(fmt::format("binary STL with {} must have {} bytes; this file has {} and {}", counted(faceCount, "face"),
                          expectedSize, bytes.size(),
                          expectedSize > bytes.size() ? "is truncated" : "continues after the last face"));
  }
  const uint64_t faceCount = binaryFaceCount(bytes);
  CornerWelder welder(faceCount / 2);
  std::vector<Face> triangles(faceCount);
  for (uint64_t i = 0; i < faceCount; ++i) {
    constexpr size_t kNormalSize = 3 * sizeof(float);
    std::array<Vec3f, 3> corners;
    std::memcpy(corners.data(), bytes.data() + kHeaderSize + i * kFaceSize + kNormalSize, sizeof corners);
    for (size_t c = 0; c < 3; ++c) triangles[i][c] = welder.indexOf(static_cast<Vec3d>(corners[c]));
  }
  return weldedMesh(welder, std::move(triangles));
}

bool isKeyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

void requireKeyword(TextScanner& text, std::string_view keyword) {
  const std::string_view word = text.word(keyword);
  if (!isKeyword(word, keyword)) failAtLine(text.line(), fmt::format("expected '{}', found {}", keyword, quoted(word)));
}

Face readFacet(TextScanner& text, CornerWelder& welder) {
  requireKeyword(text, "normal");
  // The words of the normal may be anything, because some programs write 1.#IND for a face of zero area.
  for (int i = 0; i < 3; ++i) static_cast<void>(text.word("a number of the normal"));
  requireKeyword(text, "outer");
  requireKeyword(text, "loop");
  Face face;
  for (uint32_t& corner : face) {
    requireKeyword(text, "vertex");
    Vec3d p;
    for (size_t axis = 0; axis < 3; ++axis) p[axis] = text.number("a vertex coordinate");
    corner = welder.indexOf(p);
  }
  requireKeyword(text, "endloop");
  requireKeyword(text, "endfacet");
  return face;
}

/// One or more of: solid NAME, facets, endsolid NAME. A name is any text up to the end of the line.
Mesh parseAscii(std::span<const char> bytes) {
  TextScanner text(bytes);
  CornerWelder welder(0);
  std::vector<Face> triangles;
  while (!text.atEnd()) {
    requireKeyword(text, "solid");
    text.skipLine();
    for (;;) {
      const std::string_view word = text.word("'facet' or 'endsolid'");
      if (isKeyword(word, "endsolid")) break;
      if (!isKeyword(word, "facet"))
        failAtLine(text.line(), fmt::format("expected 'facet' or 'endsolid', found {}", quoted(word)));
      triangles.push_back(readFacet(text, welder));
    }
    text.skipLine();
  }
  return weldedMesh(welder, std::move(triangles));
}

Match detectStl(std::span<const char> bytes) {
  return hasBinarySize(bytes) || beginsWithSolid(bytes) ? Match::Certain : Match::None;
}

Mesh parseStl(const MeshSource& source) {
  const std::span<const char> bytes = source.bytes;
  // Binary files may also begin with "solid", but have a zero byte; a text has none.
  const std::string_view beginning(bytes.data(), std::min<size_t>(bytes.size(), 1024));
  const bool hasZeroByte = beginning.find('\0') != std::string_view::npos;
  if (hasBinarySize(bytes) || hasZeroByte || !beginsWithSolid(bytes)) return parseBinary(bytes);
  return parseAscii(bytes);
}

}  // namespace

extern const FileFormat kStlFormat{
    .name = "stl", .extensions = {"stl", "stla", "stlb"}, .detect = detectStl, .parseMesh = parseStl};

}  // namespace asdfvk
