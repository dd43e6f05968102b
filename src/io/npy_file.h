#pragma once

#include <cstdint>
#include <string>

#include "asdf_vk/field.h"
#include "core/byte_output.h"

namespace asdfvk {

class AtomicFile;

// NumPy's .npy, version 1.0: a header, then the entries of one field, little-endian; real numbers as float32.

/// Returns the header. Its size is a multiple of 64 bytes.
[[nodiscard]] std::string npyHeader(const Field& field);
[[nodiscard]] uint64_t npyEntriesSize(const Field& field);
/// Appends the entries [begin, end), which are below field.size().
void putNpyEntries(const Field& field, ByteBuffer& to, uint64_t begin, uint64_t end);
void writeNpyEntries(AtomicFile& file, const Field& field);

}  // namespace asdfvk
