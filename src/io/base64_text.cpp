#include "io/base64_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base64_stream.h"

namespace asdfvk {
namespace {

int valueOf(char c) {
  if ('A' <= c && c <= 'Z') return c - 'A';
  if ('a' <= c && c <= 'z') return c - 'a' + 26;
  if ('0' <= c && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::optional<std::vector<char>> base64Bytes(std::string_view text) {
  for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<char> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int bitCount = 0;
  for (const char c : text) {
    const int value = valueOf(c);
    if (value < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<uint32_t>(value)) & 0xffffu;
    bitCount += 6;
    if (bitCount < 8) continue;
    bitCount -= 8;
    bytes.push_back(static_cast<char>(bits >> bitCount & 0xffu));
  }
  return bytes;
}

std::string base64Text(std::span<const char> bytes) {
  constexpr size_t kGroup = 3;
  std::string text(4 * ((bytes.size() + kGroup - 1) / kGroup), '=');
  char* to = text.data();
  for (size_t i = 0; i < bytes.size(); i += kGroup, to += 4) {
    const size_t count = std::min(kGroup, bytes.size() - i);
    std::array<uint8_t, kGroup> group{};
    for (size_t k = 0; k < count; ++k) group[k] = static_cast<uint8_t>(bytes[i + k]);
    encodeBase64Group(to, group.data());
    for (size_t k = count + 1; k < 4; ++k) to[k] = '=';
  }
  return text;
}

}  // namespace asdfvk
