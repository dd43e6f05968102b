// STL, in ASCII (stl_ascii.cpp) or binary (stl_binary.cpp). The reader ignores normals and attribute bytes: the order
// of the corners decides which side is outside.
#include "io/stl_reader.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "io/formats.h"
#include "io/stl_ascii.h"
#include "io/stl_binary.h"
#include "mesh/input_faces.h"

namespace asdfvk {

Mesh stlMesh(std::vector<Vec3d>&& vertices, std::vector<Face>&& triangles) {
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  InputFaces faces;
  faces.addTriangles(std::move(triangles));
  faces.moveTo(mesh);
  return mesh;
}

namespace {

Match detectStl(std::span<const char> bytes) {
  if (hasBinaryStlSize(bytes) || beginsWithSolid(bytes)) return Match::Certain;
  return isBinaryStl(bytes) ? Match::Possible : Match::None;
}

Mesh parseStl(const MeshSource& source) {
  const std::span<const char> bytes = source.bytes;
  // Binary files may also begin with "solid", but have a zero byte; a text has none.
  const std::string_view beginning(bytes.data(), std::min<size_t>(bytes.size(), 1024));
  const bool hasZeroByte = beginning.find('\0') != std::string_view::npos;
  if (hasBinaryStlSize(bytes) || hasZeroByte || !beginsWithSolid(bytes)) return parseBinaryStl(bytes);
  return parseAsciiStl(bytes);
}

}  // namespace

extern const FileFormat kStlFormat{
    .name = "stl", .extensions = {"stl", "stla", "stlb"}, .detect = detectStl, .parseMesh = parseStl};

}  // namespace asdfvk
