#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "asdf_vk/session.h"
#include "pipeline/lazy_backend.h"

namespace asdfvk {

/// The state behind a Session.
class SessionState {
 public:
  SessionState(const SessionOptions& options, SessionOpening opening)
      : backend(std::make_unique<LazyBackend>(options, opening)), options_(options) {}

  /// Calls compute(control). If the device fails, is lost or is out of memory, and another backend may be used, calls
  /// compute() again with the other backend; the progress never decreases. The session continues with the other
  /// backend, unless this mesh needed more memory than the device has. mayReplace: whether the computation needs no
  /// device.
  template <typename Compute>
  auto compute(bool mayReplace, const RunControl& control, const Compute& compute);

  /// Warnings for each computation on a backend that replaces another one.
  [[nodiscard]] const std::vector<Warning>& warnings() const { return warnings_; }

  std::unique_ptr<LazyBackend> backend;  ///< Never null.

 private:
  /// Opens the next backend of BackendChoice::Automatic. Returns false if there is none, or if the options request the
  /// current backend.
  bool replaceBackend(const Error& failure);
  /// Ends a replacement that was for one mesh only.
  void returnToDevice();

  struct Return {
    SessionState& state;
    ~Return() { state.returnToDevice(); }
  };

  SessionOptions options_;
  std::vector<Warning> warnings_;
  std::vector<std::unique_ptr<LazyBackend>> replaced_;  // Kept: tracers of scenes may refer to them.
  bool lacksMemory_ = false;                            // Whether the last of `replaced_` lacked memory for this mesh.
};

template <typename Compute>
auto SessionState::compute(bool mayReplace, const RunControl& control, const Compute& compute) {
  const Return returning{*this};
  double done = 0;
  RunControl watched = control;
  if (control.progress)
    watched.progress = [&](double fraction) {
      done = std::max(done, fraction);  // A solver of the CPU that replaces a solver of the device begins anew.
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
