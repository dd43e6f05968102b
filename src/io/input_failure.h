#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace asdfvk {

/// What every reader throws: Error{Input} with one line that says where and why. Lines count from 1, bytes from 0.
[[noreturn]] void failInput(std::string_view reason);
[[noreturn]] void failAtLine(uint64_t line, std::string_view reason);
[[noreturn]] void failAtByte(uint64_t byte, std::string_view reason);

/// Words of the file as a message can show them: shortened, and whatever is not printable ASCII replaced by '?'.
[[nodiscard]] std::string printable(std::string_view token);
/// The same in quotes.
[[nodiscard]] std::string quoted(std::string_view token);

}  // namespace asdfvk
