#pragma once

#include <functional>
#include <stop_token>

#include "core/error.h"

namespace asdfvk {

/// What a long computation listens to and tells, between chunks of about 50 to 100 ms.
struct RunControl {
  std::stop_token stop;                           ///< Asks the computation to end.
  std::function<void(double fraction)> progress;  ///< Called from the calling thread with 0..1; may be empty.

  /// Reports progress; throws Error{Cancelled} when a stop was requested.
  void checkpoint(double fraction) const {
    if (stop.stop_requested()) throw Error(ErrorKind::Cancelled, "cancelled");
    if (progress) progress(fraction);
  }

  /// For a part of the work, whose 0..1 is the whole's from..to. The part must not outlive this.
  [[nodiscard]] RunControl part(double from, double to) const {
    RunControl control{stop, {}};
    if (progress) control.progress = [this, from, to](double fraction) { progress(from + fraction * (to - from)); };
    return control;
  }
};

}  // namespace asdfvk
