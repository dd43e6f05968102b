// PLY (Turk 1994): header, then rows of the elements in the order of the header.
#include "io/mesh_reader.h"
#include "io/ply_body.h"

namespace asdfvk {

Mesh parsePly(std::span<const char> bytes) {
  const PlyHeader header = parsePlyHeader(bytes);
  PlyTarget target;
  if (header.encoding == PlyEncoding::Ascii) {
    readPlyAscii(bytes, header, target);
  } else {
    readPlyBinary(bytes, header, target);
  }
  Mesh mesh;
  mesh.vertices = std::move(target.vertices);
  target.faces.moveTo(mesh);
  return mesh;
}

}  // namespace asdfvk
