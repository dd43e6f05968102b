#include "io/utf16_text.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

/// The code units after the byte order mark. Precondition: at least two bytes.
class Utf16Units {
 public:
  explicit Utf16Units(std::span<const char> bytes) : bytes_(bytes.subspan(2)), isBig_(bytes[0] == '\xfe') {}

  [[nodiscard]] size_t count() const { return bytes_.size() / 2; }
  [[nodiscard]] uint32_t operator[](size_t i) const {
    const auto first = static_cast<unsigned char>(bytes_[2 * i]),
               second = static_cast<unsigned char>(bytes_[2 * i + 1]);
    return isBig_ ? first << 8u | second : second << 8u | first;
  }

 private:
  std::span<const char> bytes_;
  bool isBig_;
};

bool isSurrogate(uint32_t unit, uint32_t first) { return (unit & 0xfc00u) == first; }

void appendUtf8(std::string& text, uint32_t codePoint) {
  const auto tail = [&](uint32_t shift) { text += static_cast<char>(0x80u | (codePoint >> shift & 0x3fu)); };
  if (codePoint < 0x80) {
    text += static_cast<char>(codePoint);
  } else if (codePoint < 0x800) {
    text += static_cast<char>(0xc0u | codePoint >> 6u);
    tail(0);
  } else if (codePoint < 0x10000) {
    text += static_cast<char>(0xe0u | codePoint >> 12u);
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xf0u | codePoint >> 18u);
    tail(12), tail(6), tail(0);
  }
}

}  // namespace

bool isUtf16Text(std::span<const char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  if (bytes.size() < 4 || !(text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))) return false;
  constexpr size_t kTestedCount = 1024;
  const Utf16Units units(bytes.first(std::min(bytes.size(), 2 + 2 * kTestedCount)));
  for (size_t i = 0; i < units.count(); ++i)
    if (units[i] < ' ' && (units[i] < '\t' || units[i] > '\r')) return false;
  return true;
}

std::string utf8Of(std::span<const char> utf16) {
  if (utf16.size() % 2 != 0)
    failInput("is a text in UTF-16 with an odd number of bytes; it is truncated; copy or export it again");
  const Utf16Units units(utf16);
  constexpr uint32_t kHigh = 0xd800, kLow = 0xdc00, kReplacement = 0xfffd;
  std::string text;
  text.reserve(units.count());
  for (size_t i = 0; i < units.count(); ++i) {
    uint32_t codePoint = units[i];
    if (isSurrogate(codePoint, kHigh) && i + 1 < units.count() && isSurrogate(units[i + 1], kLow))
      codePoint = 0x10000u + ((codePoint - kHigh) << 10u) + (units[++i] - kLow);
    else if (isSurrogate(codePoint, kHigh) || isSurrogate(codePoint, kLow))
      codePoint = kReplacement;
    appendUtf8(text, codePoint);
  }
  return text;
}

}  // namespace asdfvk
