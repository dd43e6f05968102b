#pragma once

#include <cfenv>
#include <cstring>
#include <stop_token>

#include "asdf_vk/asdf_vk_c.h"
#include "asdf_vk/run_control.h"
#include "core/function_ref.h"

/// What every function of asdf_vk_c.h needs: guarded(), in which its body runs, the check of its arguments, and the
/// progress function of the caller.
namespace asdfvk::c {

/// Calls `body` on this thread, in the default floating-point environment on all threads of its parallel loops, and
/// restores the caller's environment. An exception becomes the returned status and the last error of the thread.
asdf_vk_status guarded(FunctionRef<void()> body) noexcept;

/// Throws Error{InvalidArgument} for null. name: the argument in the message, for example "the output".
void requireArgument(const void* pointer, const char* name);

/// The number of an enumerator. A caller in C may pass any number. Reading a number without an enumerator as an
/// enumeration is undefined behaviour in C++.
template <typename Enum>
[[nodiscard]] int numberOf(const Enum& enumerator) {
  int number = 0;
  static_assert(sizeof number == sizeof enumerator);
  std::memcpy(&number, &enumerator, sizeof number);
  return number;
}

/// The progress function of a caller as a RunControl. The function is called in the floating-point environment in which
/// this object was constructed. Preconditions: the object is constructed before guarded() changes the environment; the
/// object outlives the control.
class ProgressCall {
 public:
  ProgressCall(asdf_vk_progress callback, void* user) : callback_(callback), user_(user) { std::fegetenv(&callers_); }
  [[nodiscard]] RunControl control();

 private:
  void call();

  asdf_vk_progress callback_;
  void* user_;
  std::fenv_t callers_{};
  double fraction_ = 0;
  const char* stage_ = "";
  /// control() allocates the state of the source, because the constructor must not throw.
  std::stop_source source_{std::nostopstate};
};

}  // namespace asdfvk::c
