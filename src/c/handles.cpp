#include "c/handles.h"

#include <fmt/core.h>

#include <atomic>

#include "asdf_vk/error.h"

namespace asdfvk::c {

uintptr_t nextHandle() {
  constexpr uintptr_t kStep = 16;
  static std::atomic<uintptr_t> last{0};
  return last += kStep;
}

void failHandle(const void* handle, const char* type) {
  throw Error(ErrorCode::InvalidArgument,
              handle == nullptr
                  ? fmt::format("the {} is null", type)
                  : fmt::format("the handle is not a handle of a {}, or the {} was destroyed", type, type));
}

}  // namespace asdfvk::c
