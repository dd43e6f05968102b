#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace asdfvk {

/// What every reader throws: Error{Input} with one line that says where and why. Lines count from 1, bytes from 0.
[[noreturn]] void failInput(std::string_view reason);
[[noreturn]] void failAtLine(uint64_t line, std::string_view reason);
[[noreturn]] void failAtByte(uint64_t byte, std::string_view reason);

/// `token` in quotes for a message: shortened, and whatever is not printable ASCII replaced by '?'.
[[nodiscard]] std::string quoted(std::string_view token);

}  // namespace asdfvk
