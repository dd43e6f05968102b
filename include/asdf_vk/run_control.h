#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>

#include "asdf_vk/api.h"

namespace asdfvk {

enum class Stage;  // report.h

/// Cancellation and progress of a computation. Both are polled between chunks of rays of about 50 to 100 ms, between
/// iterations of the solver, and between the other stages, each of which runs to its end.
struct RunControl {
  std::stop_token stop;                           ///< A requested stop ends the computation with Error{Cancelled}.
  std::function<void(double fraction)> progress;  ///< Called from the calling thread with 0 to 1; may be empty.
  std::function<void(Stage stage)> stageBegan;    ///< Called when another stage begins or goes on; may be empty.

  /// Reports progress. Throws Error{Cancelled} when a stop was requested.
  ASDFVK_API void checkpoint(double fraction) const;
  /// A control with the cancellation only, for steps that report no progress.
  [[nodiscard]] RunControl withoutProgress() const { return {stop, {}, {}}; }
  /// Control for a part of the work: maps the progress 0..1 of the part to from..to of the whole. The part must not
  /// outlive this object.
  [[nodiscard]] ASDFVK_API RunControl part(double from, double to) const;
};

/// Limits the CPU threads of the library in this process while it exists, and those of the CPU device lavapipe in
/// sessions that are opened meanwhile (unless LP_NUM_THREADS is set). Results do not depend on it.
class ASDFVK_API ThreadLimit {
 public:
  /// threadCount: 1 or more; 0 is the number of cores. Of several limits the least applies.
  explicit ThreadLimit(uint32_t threadCount);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
