#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace asdfvk::fuzz {

/// What each harness does with an input: the reader either throws Error{Input} with one line, or returns a mesh whose
/// arrays fit together; and its memory never exceeds 64 times the input plus 256 KiB. Anything else ends the process.
int readOnce(Mesh (*parser)(std::span<const char>), const uint8_t* data, size_t size);

}  // namespace asdfvk::fuzz
