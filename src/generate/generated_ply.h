#pragma once

#include <filesystem>

#include "generate/generated_shape.h"

namespace asdfvk {

/// Writes a binary little-endian PLY file, atomically. Vertices are float or double; the properties of faces are `list
/// uchar int vertex_indices`, `float diameter` and `int part`. "-" is standard output. Throws Error{Output}.
void writeGeneratedPly(const std::filesystem::path& path, const GeneratedShape& shape, bool doubleVertices);

}  // namespace asdfvk
