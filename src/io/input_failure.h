#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace asdfvk {

// Every reader throws Error{UnreadableInput} with one line: the place and the reason. Lines are numbered from 1, bytes
// from 0.
[[noreturn]] void failInput(std::string_view reason);
[[noreturn]] void failAtLine(uint64_t line, std::string_view reason);
[[noreturn]] void failAtByte(uint64_t byte, std::string_view reason);

/// Returns a text of the file in a form for messages: at most 60 characters; bytes other than printable ASCII are
/// replaced by '?'.
[[nodiscard]] std::string printable(std::string_view token);
/// Returns printable(token) in quotes.
[[nodiscard]] std::string quoted(std::string_view token);

}  // namespace asdfvk
