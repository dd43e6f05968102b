#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "core/atomic_file.h"

namespace asdfvk {

/// Encodes three bytes as four characters of base64.
inline void encodeBase64Group(char* to, const uint8_t* from) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  to[0] = kDigits[from[0] >> 2];
  to[1] = kDigits[(from[0] & 3u) << 4 | from[1] >> 4];
  to[2] = kDigits[(from[1] & 15u) << 2 | from[2] >> 6];
  to[3] = kDigits[from[2] & 63u];
}

/// Writes bytes to a file as one base64 text (RFC 4648). finish() writes the last bytes and the padding.
class Base64Stream {
 public:
  explicit Base64Stream(AtomicFile& file) : file_(file) {}

  template <typename T>
  void put(const T& value) {
    if (pending_.size() - used_ < sizeof(T)) encodeWholeGroups();
    std::memcpy(pending_.data() + used_, &value, sizeof(T));
    used_ += sizeof(T);
  }

  void write(std::span<const uint8_t> bytes) {
    while (!bytes.empty()) {
      if (used_ == pending_.size()) encodeWholeGroups();
      const size_t step = std::min(bytes.size(), pending_.size() - used_);
      std::memcpy(pending_.data() + used_, bytes.data(), step);
      used_ += step;
      bytes = bytes.subspan(step);
    }
  }

  void finish() {
    encodeWholeGroups();
    if (used_ == 0) return;
    std::array<uint8_t, 3> last{};
    std::memcpy(last.data(), pending_.data(), used_);
    char* const to = file_.reserve(4);
    encodeBase64Group(to, last.data());
    for (size_t i = used_ + 1; i < 4; ++i) to[i] = '=';
    file_.advance(4);
    used_ = 0;
  }

 private:
  void encodeWholeGroups() {
    static_assert(sizeof(pending_) / 3 * 4 <= AtomicFile::kMaxReserve);
    const size_t groups = used_ / 3;
    char* const to = file_.reserve(4 * groups);
    for (size_t g = 0; g < groups; ++g) encodeBase64Group(to + 4 * g, pending_.data() + 3 * g);
    file_.advance(4 * groups);
    std::memmove(pending_.data(), pending_.data() + 3 * groups, used_ - 3 * groups);
    used_ -= 3 * groups;
  }

  AtomicFile& file_;
  std::array<uint8_t, 3 * 4096> pending_;
  size_t used_ = 0;
};

}  // namespace asdfvk
