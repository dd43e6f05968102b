#pragma once

#include <algorithm>
#include <vector>

#include "pipeline/backend.h"
#include "pipeline/computation.h"

namespace asdfvk {

/// Session::state_.
class SessionState {
 public:
  explicit SessionState(const SessionOptions& options) : named(openBackend(options)), options_(options) {}

  /// Calls compute(control). Where the device fails, is lost or is out of memory, and another backend may be used,
  /// compute() is called again with that one; the progress never decreases. The session continues with it, unless this
  /// mesh needed more memory than the device has. mayReplace: whether the computation needs no device.
  template <typename Compute>
  auto compute(bool mayReplace, const RunControl& control, const Compute& compute);

  /// For each computation on a backend that replaces another one.
  [[nodiscard]] const std::vector<Warning>& warnings() const { return warnings_; }

  NamedBackend named;
  Solvers solvers;  ///< Destroyed before the device that they use.

 private:
  /// Opens the next backend of "auto". Returns false where there is none, or where the options request this one.
  bool replaceBackend(const Error& failure);
  /// Ends a replacement for one mesh.
  void returnToDevice();

  struct Return {
    SessionState& state;
    ~Return() { state.returnToDevice(); }
  };

  SessionOptions options_;
  std::vector<Warning> warnings_;
  std::vector<NamedBackend> replaced_;  // Kept: tracers of scenes may refer to them.
  bool lacksMemory_ = false;            // The last of them did, for this mesh.
};

template <typename Compute>
auto SessionState::compute(bool mayReplace, const RunControl& control, const Compute& compute) {
  const Return returning{*this};
  double done = 0;
  RunControl watched = control;
  if (control.progress)
    watched.progress = [&](double fraction) {
      done = std::max(done, fraction);  // A solver that replaces one on the device begins anew.
      control.progress(done);
    };
  while (true) {
    const double begin = done;
    RunControl rest = watched.part(begin, 1);
    rest.stageBegan = control.stageBegan;
    try {
      return compute(rest);
    } catch (const Error& error) {
      if (!mayReplace || !replaceBackend(error)) throw;
    }
  }
}

}  // namespace asdfvk
