#pragma once

#include <cstdint>
#include <span>

#include "core/unset_vector.h"

namespace asdfvk {

/// Whether the bytes begin as a gzip file does (RFC 1952).
[[nodiscard]] bool isGzip(std::span<const char> bytes);

/// The greatest unpacked size: 20 times the packed size, and at least 1 GiB.
[[nodiscard]] uint64_t maxUnpackedSize(uint64_t packedSize);

/// Unpacks all members of a gzip file. Zero bytes may follow the last member. Throws Error{UnreadableInput} for other
/// bytes after the last member, and for a file that is truncated or damaged; Error{InputTooLarge} for more than
/// maxUnpackedSize() bytes.
[[nodiscard]] UnsetVector<char> unpackGzip(std::span<const char> bytes);

}  // namespace asdfvk
