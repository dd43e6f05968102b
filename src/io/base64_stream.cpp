#include "io/base64_stream.h"

#include <string_view>

namespace asdfvk {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void encodeGroup(char* to, const uint8_t* from) {
  to[0] = kDigits[from[0] >> 2];
  to[1] = kDigits[(from[0] & 3u) << 4 | from[1] >> 4];
  to[2] = kDigits[(from[1] & 15u) << 2 | from[2] >> 6];
  to[3] = kDigits[from[2] & 63u];
}

}  // namespace

void Base64Stream::encodeWholeGroups() {
  static_assert(sizeof(pending_) / 3 * 4 <= AtomicFile::kMaxReserve);
  const size_t groups = used_ / 3;
  char* const to = file_.reserve(4 * groups);
  for (size_t g = 0; g < groups; ++g) encodeGroup(to + 4 * g, pending_.data() + 3 * g);
  file_.advance(4 * groups);
  std::memmove(pending_.data(), pending_.data() + 3 * groups, used_ - 3 * groups);
  used_ -= 3 * groups;
}

void Base64Stream::finish() {
  encodeWholeGroups();
  if (used_ == 0) return;
  std::array<uint8_t, 3> last{};
  std::memcpy(last.data(), pending_.data(), used_);
  char* const to = file_.reserve(4);
  encodeGroup(to, last.data());
  for (size_t i = used_ + 1; i < 4; ++i) to[i] = '=';
  file_.advance(4);
  used_ = 0;
}

}  // namespace asdfvk
