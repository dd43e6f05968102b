#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/atomic_file.h"

namespace asdfvk {

/// Encodes bytes as one run of base64 (RFC 4648); finish() pads and ends it.
class Base64Stream {
 public:
  explicit Base64Stream(AtomicFile& file) : file_(file) {}

  template <typename T>
  void put(const T& value) {
    if (pending_.size() - used_ < sizeof(T)) encodeWholeGroups();
    std::memcpy(pending_.data() + used_, &value, sizeof(T));
    used_ += sizeof(T);
  }

  void finish();

 private:
  void encodeWholeGroups();

  AtomicFile& file_;
  std::array<uint8_t, 3 * 4096> pending_;
  size_t used_ = 0;
};

}  // namespace asdfvk
