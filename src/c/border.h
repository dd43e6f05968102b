#pragma once

#include <cfenv>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>

#include "asdf_vk/asdf_vk_c.h"
#include "asdf_vk/error.h"
#include "asdf_vk/run_control.h"
#include "core/function_ref.h"

/// Conversions between C and C++, which every function of asdf_vk_c.h uses.
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
  /// Allocated by control(), because the constructor must not throw.
  std::stop_source source_{std::nostopstate};
};

/// Returns a number that no handle of any type had before.
[[nodiscard]] uintptr_t nextHandle();
[[noreturn]] void failHandle(const void* handle, const char* type);

/// The objects of a type, by handle. A handle is a unique number instead of an address, so that destroyed handles and
/// handles of another type are recognised.
template <typename Object>
class Handles {
 public:
  explicit Handles(const char* type) : type_(type) {}

  [[nodiscard]] Object* add(std::shared_ptr<Object> object) {
    auto* const handle = reinterpret_cast<Object*>(nextHandle());  // NOLINT(performance-no-int-to-ptr)
    const std::scoped_lock lock(mutex_);
    objects_.emplace(handle, std::move(object));
    return handle;
  }
  /// Throws Error{InvalidArgument} if the handle is null, destroyed or of another type.
  [[nodiscard]] std::shared_ptr<Object> get(const Object* handle) {
    const std::scoped_lock lock(mutex_);
    const auto found = objects_.find(handle);
    if (found == objects_.end()) failHandle(handle, type_);
    return found->second;
  }
  void destroy(const Object* handle) {
    (void)guarded([&] {
      std::shared_ptr<Object> object;  // Destroyed after the lock is released.
      const std::scoped_lock lock(mutex_);
      const auto found = objects_.find(handle);
      if (found == objects_.end()) return;
      object = std::move(found->second);
      objects_.erase(found);
    });
  }

 private:
  const char* type_;
  std::mutex mutex_;
  std::map<const Object*, std::shared_ptr<Object>> objects_;
};

/// The table of all handles of a type. The table is never destroyed, because its objects hold devices, which may be
/// unusable at the end of the process.
template <typename Object>
[[nodiscard]] Handles<Object>& handles() {
  static auto* const table = new Handles<Object>(Object::kType);
  return *table;
}

}  // namespace asdfvk::c
