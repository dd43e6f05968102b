#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "c/call_guard.h"

namespace asdfvk::c {

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
