// The Object File Format of Geomview: [ST][C][N]OFF, counts, a vertex per line, faces. What the prefixes add to a
// vertex (texture coordinates, a colour, a normal) and the colour behind a face are passed over.
#include <fmt/format.h>

#include <optional>

#include "core/text.h"
#include "io/input_faces.h"
#include "io/input_failure.h"
#include "io/mesh_reader.h"
#include "io/off_header.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

uint64_t readCount(TextScanner& text, std::string_view what) {
  const int64_t count = text.integer(what);
  if (count < 0) failAtLine(text.line(), fmt::format("{} is negative: {}", what, count));
  return static_cast<uint64_t>(count);
}

/// Passes over the numbers that are left on the line and returns how many there were.
uint64_t skipNumbersOnLine(TextScanner& text, std::string_view what) {
  uint64_t count = 0;
  for (; !text.atLineEnd(); ++count) static_cast<void>(text.number(what));
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
      failAtLine(text.line(), fmt::format("vertex {} has {} numbers behind its coordinates, which does not fit the "
                                          "header {}; COFF announces colours, NOFF normals, STOFF texture coordinates",
                                          i, extraCount, header.keyword));
  }
}

void readFaces(TextScanner& text, uint64_t count, uint64_t vertexCount, InputFaces& faces) {
  faces.reserve(count);
  std::vector<uint32_t> corners;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t cornerCount = readCount(text, "the corner count of a face");
    if (cornerCount > text.remaining())
      failAtLine(text.line(), fmt::format("face {} claims {}, but the file has only {} more; it is cut short", i,
                                          counted(cornerCount, "corner"), counted(text.remaining(), "byte")));
    corners.clear();
    for (uint64_t c = 0; c < cornerCount; ++c) {
      const int64_t index = text.integer("a vertex index");
      if (index < 0 || static_cast<uint64_t>(index) >= vertexCount)
        failAtLine(text.line(), fmt::format("vertex index {} of face {} is out of range; the mesh has {}", index, i,
                                            counted(vertexCount, "vertex", "vertices")));
      corners.push_back(static_cast<uint32_t>(index));
    }
    if (skipNumbersOnLine(text, "a colour number") > 4)
      failAtLine(text.line(), fmt::format("more than a colour stands behind face {}", i));
    faces.add(corners);
  }
}

}  // namespace

Mesh parseOff(std::span<const char> bytes) {
  TextScanner text(bytes, {.comment = '#'});
  const OffHeader header = readOffHeader(text);
  const uint64_t vertexCount = readCount(text, "the vertex count");
  const uint64_t faceCount = readCount(text, "the face count");
  if (!text.atLineEnd()) static_cast<void>(readCount(text, "the edge count"));
  text.requireLineEnd("the counts");
  // A vertex takes at least the six bytes of "0 0 0\n", a face the two of "0\n"; the last line may lack its end.
  const uint64_t left = text.remaining() + 1;
  if (vertexCount > left / 6 || faceCount > (left - 6 * vertexCount) / 2)
    failAtLine(text.line(), fmt::format("{} and {} do not fit into the {} left; "
                                        "the file is cut short or its counts are wrong",
                                        counted(vertexCount, "vertex", "vertices"), counted(faceCount, "face"),
                                        counted(text.remaining(), "byte")));
  requireIndexableVertexCount(vertexCount);
  Mesh mesh;
  InputFaces faces;
  readVertices(text, header, vertexCount, mesh.vertices);
  readFaces(text, faceCount, vertexCount, faces);
  if (!text.atEnd())
    failAtLine(text.line(), fmt::format("{} stands behind the last face", quoted(text.word("the end"))));
  faces.moveTo(mesh);
  return mesh;
}

}  // namespace asdfvk
