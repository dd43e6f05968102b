#include "c/call_guard.h"

#include <fmt/core.h>
#include <unistd.h>

#include <exception>
#include <new>
#include <string>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "core/error_kind.h"
#include "core/parallel.h"
#include "core/text.h"

namespace asdfvk::c {
namespace {

/// Sets a floating-point environment; the destructor restores the previous one, status flags included.
class FloatingPointScope {
 public:
  explicit FloatingPointScope(const std::fenv_t* environment) {
    std::fegetenv(&before_);
    std::fesetenv(environment);
  }
  ~FloatingPointScope() { std::fesetenv(&before_); }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  std::fenv_t before_{};
};

struct LastError {
  std::string message;
  const char* name = "";
};

LastError& lastError() {
  thread_local LastError last;
  return last;
}

asdf_vk_status keepError(asdf_vk_status status, const char* name, const char* message) noexcept {
  LastError& last = lastError();
  last.name = name;
  try {
    last.message = oneLine(message);
  } catch (const std::bad_alloc&) {
    last.message.clear();
  }
  return status;
}

asdf_vk_status keepCurrentError() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return keepError(static_cast<asdf_vk_status>(rowOf(error.kind()).code), nameOf(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return keepError(ASDF_VK_INPUT, nameOf(ErrorCode::InputTooLarge), "not enough memory for this mesh");
  } catch (const std::exception& error) {
    return keepError(ASDF_VK_INTERNAL, "internal", error.what());
  } catch (...) {
    return keepError(ASDF_VK_INTERNAL, "internal", "unknown error");
  }
}

/// Throws Error{ForkedProcess} after a fork: a call would wait forever for threads of the parent process.
void requireSameProcess() {
  static const pid_t first = getpid();
  if (getpid() != first)
    throw Error(
        ErrorCode::ForkedProcess,
        "this process was forked after the first use of asdf-vk; fork before the first use, or start a new program");
}

}  // namespace

asdf_vk_status guarded(FunctionRef<void()> body) noexcept {
  const FloatingPointScope scope(FE_DFL_ENV);
  try {
    requireSameProcess();
    // Each thread of a TBB arena has the floating-point environment in which the arena was created. callWithThreads()
    // creates a new arena, because the calling thread's arena may have been created in another environment.
    callWithThreads(static_cast<uint32_t>(defaultThreadCount()), body);
    return ASDF_VK_OK;
  } catch (...) {
    return keepCurrentError();
  }
}

void requireArgument(const void* pointer, const char* name) {
  if (pointer == nullptr)
    throw Error(ErrorCode::InvalidArgument, fmt::format("a null pointer was passed for {}", name));
}

RunControl ProgressCall::control() {
  if (callback_ == nullptr) return {};
  source_ = std::stop_source();
  return {source_.get_token(),
          [this](double fraction) {
            fraction_ = fraction;
            call();
          },
          [this](Stage stage) {
            stage_ = nameOf(stage);
            call();
          }};
}

void ProgressCall::call() {
  const FloatingPointScope scope(&callers_);
  if (!source_.stop_requested() && callback_(fraction_, stage_, user_) != 0) source_.request_stop();
}

}  // namespace asdfvk::c

extern "C" {

const char* asdf_vk_last_error(void) { return asdfvk::c::lastError().message.c_str(); }
const char* asdf_vk_last_error_name(void) { return asdfvk::c::lastError().name; }

}  // extern "C"
