#pragma once

#include <functional>
#include <stop_token>

#include "asdf_vk/api.h"

namespace asdfvk {

/// Cancellation and progress of a computation. Polled between chunks of rays of about 50 to 100 ms, between iterations
/// of the solver, and between the other stages, each of which runs to its end.
struct RunControl {
  std::stop_token stop;                           ///< A requested stop ends the computation with Error{Cancelled}.
  std::function<void(double fraction)> progress;  ///< Called from the calling thread with 0 to 1; may be empty.

  /// Reports progress. Throws Error{Cancelled} when a stop was requested.
  ASDFVK_API void checkpoint(double fraction) const;
  /// Cancellation only, for steps that report no progress.
  [[nodiscard]] RunControl withoutProgress() const { return {stop, {}}; }
  /// Control for a part of the work: maps the progress 0..1 of the part to from..to of the whole. The part must not
  /// outlive this object.
  [[nodiscard]] ASDFVK_API RunControl part(double from, double to) const;
};

}  // namespace asdfvk
