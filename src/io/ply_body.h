#pragma once

#include <span>

#include "io/input_faces.h"
#include "io/ply_header.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// What a PLY file's rows become.
struct PlyTarget {
  std::vector<Vec3d> vertices;
  InputFaces faces;
};

/// Reads the rows behind the header. `bytes` is the whole file. Throws Error{Input} naming the line (ASCII) or the byte
/// (binary); no memory is taken for an element before its count has been held against what is left of the file.
void readPlyAscii(std::span<const char> bytes, const PlyHeader& header, PlyTarget& target);
void readPlyBinary(std::span<const char> bytes, const PlyHeader& header, PlyTarget& target);

}  // namespace asdfvk
