#pragma once

#include <fmt/format.h>

#include <stdexcept>

namespace asdfvk {

/// A broken precondition or invariant: an error of the program, not of its input.
class CheckFailure : public std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace asdfvk

/// Throws CheckFailure unless `condition` holds. Always on.
#define ASDFVK_CHECK(condition)                                                                               \
  do {                                                                                                        \
    if (!(condition)) throw ::asdfvk::CheckFailure(fmt::format("{}:{}: {}", __FILE__, __LINE__, #condition)); \
  } while (false)

/// Throws CheckFailure unless `left op right`; the message prints both values. For example ASDFVK_CHECK_OP(a, <=, b).
#define ASDFVK_CHECK_OP(left, op, right)                                                                          \
  do {                                                                                                            \
    const auto& asdfvkLeft = (left);                                                                              \
    const auto& asdfvkRight = (right);                                                                            \
    if (!(asdfvkLeft op asdfvkRight))                                                                             \
      throw ::asdfvk::CheckFailure(fmt::format("{}:{}: {} {} {} ({} against {})", __FILE__, __LINE__, #left, #op, \
                                               #right, asdfvkLeft, asdfvkRight));                                 \
  } while (false)
