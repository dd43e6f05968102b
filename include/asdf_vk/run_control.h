#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>

#include "asdf_vk/api.h"

namespace asdfvk {

enum class Stage;  // report.h

/// Cancellation and progress of a computation. A computation reports progress and polls for a stop between stages,
/// between iterations of the solver, and between chunks of rays (about 50 to 100 ms each).
struct RunControl {
  std::stop_token stop;  ///< A stop request ends the computation with Error{Cancelled}.
  /// Called in the thread of the caller with 0 to 1; may be empty. Must not use the session of its computation, and
  /// should not wait for a computation of another thread, which may wait for this one.
  std::function<void(double fraction)> progress;
  std::function<void(Stage stage)> stageBegan;  ///< Called when a stage begins or continues; may be empty.

  /// Reports progress. Throws Error{Cancelled} if a stop was requested.
  ASDFVK_API void checkpoint(double fraction) const;
  /// Returns a control with the cancellation only, for steps that report no progress.
  [[nodiscard]] RunControl withoutProgress() const { return {stop, {}, {}}; }
  /// Returns a control for a part of the work. Its progress 0 to 1 is reported as `from` to `to` of the whole work. The
  /// returned control must not outlive this object.
  [[nodiscard]] ASDFVK_API RunControl part(double from, double to) const;
};

/// Limits the CPU threads of the library in this process while the object exists. If LP_NUM_THREADS is not set, the
/// limit also applies to the CPU device lavapipe, in sessions that are opened while the object exists. Results do not
/// depend on the limit.
class ASDFVK_API ThreadLimit {
 public:
  /// threadCount: 1 or more; 0: the number of cores. If several limits exist, the least one applies.
  explicit ThreadLimit(uint32_t threadCount);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
