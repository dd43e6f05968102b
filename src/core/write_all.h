#pragma once

#include <unistd.h>

#include <cerrno>
#include <string_view>

namespace asdfvk {

/// Writes all bytes to a file descriptor. Continues after a short write and after a signal. Returns 0 or errno; after a
/// failure some of the bytes may have been written.
[[nodiscard]] inline int writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return 0;
}

}  // namespace asdfvk
