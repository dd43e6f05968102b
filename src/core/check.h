#pragma once

#include <concepts>
#include <stdexcept>
#include <string>

namespace asdfvk {

/// A broken precondition or invariant: an error of the program, not of its input.
class CheckFailure : public std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] void failCheck(const char* file, int line, const char* text);
/// Appends " (LEFT against RIGHT)" to the message.
[[noreturn]] void failCheck(const char* file, int line, const char* text, const std::string& left,
                            const std::string& right);

/// The number for a message.
[[nodiscard]] std::string checkedNumber(double number);
template <std::integral T>
[[nodiscard]] std::string checkedNumber(T number) {
  return std::to_string(number);
}

/// Throws CheckFailure unless `condition` holds, also in release builds.
#define ASDFVK_CHECK(condition)                                            \
  do {                                                                     \
    if (!(condition)) ::asdfvk::failCheck(__FILE__, __LINE__, #condition); \
  } while (false)

/// Like ASDFVK_CHECK for `left op right`, with both numbers in the message: ASDFVK_CHECK_OP(a, <=, b).
#define ASDFVK_CHECK_OP(left, op, right)                                                                   \
  do {                                                                                                     \
    const auto& asdfvkLeft = (left);                                                                       \
    const auto& asdfvkRight = (right);                                                                     \
    if (!(asdfvkLeft op asdfvkRight))                                                                      \
      ::asdfvk::failCheck(__FILE__, __LINE__, #left " " #op " " #right, asdfvk::checkedNumber(asdfvkLeft), \
                          asdfvk::checkedNumber(asdfvkRight));                                             \
  } while (false)

}  // namespace asdfvk
