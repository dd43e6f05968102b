#include "io/input_failure.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {

void failInput(std::string_view reason) { throw Error(ErrorCode::UnreadableInput, std::string(reason)); }

void failAtLine(uint64_t line, std::string_view reason) { failInput(fmt::format("line {}: {}", line, reason)); }

void failAtByte(uint64_t byte, std::string_view reason) { failInput(fmt::format("byte {}: {}", byte, reason)); }

std::string printable(std::string_view token) {
  constexpr size_t kMaxShown = 60;
  std::string shown;
  for (const char c : token.substr(0, kMaxShown)) shown += c >= ' ' && c <= '~' ? c : '?';
  if (token.size() > kMaxShown) shown += "...";
  return shown;
}

std::string quoted(std::string_view token) { return fmt::format("'{}'", printable(token)); }

}  // namespace asdfvk
