#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace asdfvk {

/// A broken precondition or invariant: an error of the program, not of its input.
class CheckFailure : public std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] void failCheck(const char* file, int line, const char* text);
/// Appends " (LEFT against RIGHT)" to the message.
[[noreturn]] void failCheck(const char* file, int line, const char* text, const std::string& left,
                            const std::string& right);

[[nodiscard]] std::string checkedNumber(int64_t value);
[[nodiscard]] std::string checkedNumber(uint64_t value);
[[nodiscard]] std::string checkedNumber(double value);

template <typename T>
[[nodiscard]] std::string checkedText(T value) {
  static_assert(std::is_arithmetic_v<T>);
  if constexpr (std::is_floating_point_v<T>)
    return checkedNumber(static_cast<double>(value));
  else if constexpr (std::is_signed_v<T>)
    return checkedNumber(static_cast<int64_t>(value));
  else
    return checkedNumber(static_cast<uint64_t>(value));
}

}  // namespace asdfvk

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
      ::asdfvk::failCheck(__FILE__, __LINE__, #left " " #op " " #right, ::asdfvk::checkedText(asdfvkLeft), \
                          ::asdfvk::checkedText(asdfvkRight));                                             \
  } while (false)
