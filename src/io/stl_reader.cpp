// STL, binary and ASCII. It has no indices: corners at the same point become one vertex, or no face would have a
// neighbour. Normals and attribute bytes are passed over; the winding says what is outside.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "core/text.h"
#include "io/corner_welder.h"
#include "io/input_faces.h"
#include "io/input_failure.h"
#include "io/mesh_format.h"
#include "io/mesh_reader.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read by copying its bytes");

Mesh weldedMesh(CornerWelder& welder, std::vector<Face>&& triangles) {
  Mesh mesh;
  mesh.vertices = std::move(welder.points());
  InputFaces faces;
  faces.addTriangles(std::move(triangles));
  faces.moveTo(mesh);
  return mesh;
}

Mesh parseBinary(std::span<const char> bytes) {
  if (!isBinaryStlSize(bytes)) {
    if (bytes.size() < kStlHeaderSize)
      failInput(
          fmt::format("neither ASCII STL, as it does not begin with 'solid', nor binary STL, which has at least {} "
                      "bytes; this has {}",
                      kStlHeaderSize, bytes.size()));
    const uint64_t faceCount = binaryStlFaceCount(bytes);
    failInput(fmt::format(
        "binary STL of {} must have {} bytes; this has {} and is {}", counted(faceCount, "face"),
        kStlHeaderSize + faceCount * kStlFaceSize, bytes.size(),
        kStlHeaderSize + faceCount * kStlFaceSize > bytes.size() ? "cut short" : "followed by something else"));
  }
  const uint64_t faceCount = binaryStlFaceCount(bytes);
  CornerWelder welder(faceCount / 2);
  std::vector<Face> triangles(faceCount);
  for (uint64_t i = 0; i < faceCount; ++i) {
    constexpr size_t kNormalSize = 3 * sizeof(float);
    std::array<Vec3f, 3> corners;
    std::memcpy(corners.data(), bytes.data() + kStlHeaderSize + i * kStlFaceSize + kNormalSize, sizeof corners);
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
  if (!isKeyword(word, keyword))
    failAtLine(text.line(), fmt::format("'{}' should stand here, not {}", keyword, quoted(word)));
}

Face readFacet(TextScanner& text, CornerWelder& welder) {
  requireKeyword(text, "normal");
  // Some programs write words such as 1.#IND for the normal of a face without area.
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

/// One or more of: solid NAME, facets, endsolid NAME. The names may hold any words.
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
        failAtLine(text.line(), fmt::format("'facet' or 'endsolid' should stand here, not {}", quoted(word)));
      triangles.push_back(readFacet(text, welder));
    }
    text.skipLine();
  }
  return weldedMesh(welder, std::move(triangles));
}

}  // namespace

Mesh parseStl(std::span<const char> bytes) {
  // "solid" alone proves nothing, as binary files may begin with it too; a text holds no zero byte.
  const std::string_view beginning(bytes.data(), std::min<size_t>(bytes.size(), 1024));
  const bool hasZeroByte = beginning.find('\0') != std::string_view::npos;
  if (isBinaryStlSize(bytes) || hasZeroByte || !beginsWithSolid(bytes)) return parseBinary(bytes);
  return parseAscii(bytes);
}

}  // namespace asdfvk
