#pragma once

#include <filesystem>

#include "generate/generated_shape.h"

namespace asdfvk {

/// Writes binary little-endian PLY, atomically: vertices as float or double, faces as
/// `uchar int vertex_indices`, `float diameter`, `int part`. "-" is standard output. Throws Error{Output}.
void writeGeneratedPly(const std::filesystem::path& path, const GeneratedShape& shape, bool doubleVertices);

}  // namespace asdfvk
