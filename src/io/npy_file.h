#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "asdf_vk/field.h"

namespace asdfvk {

// NumPy's .npy, version 1.0: a header, then the entries of one field, little-endian; real numbers as float32.

/// Returns the header. Its size is a multiple of 64 bytes.
[[nodiscard]] std::string npyHeader(const Field& field);
[[nodiscard]] uint64_t npyEntriesSize(const Field& field);
void putNpyEntries(const Field& field, const std::function<void(std::span<const char>)>& put);

}  // namespace asdfvk
