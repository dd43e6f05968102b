#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "asdf_vk/session.h"
#include "pipeline/lazy_backend.h"

namespace asdfvk {

/// The state behind a Session.
class SessionState {
 public:
  SessionState(const SessionOptions& options, SessionOpening opening);

  /// The backend for a computation that traces so many rays: `backend`, or the CPU if the options need no backend, or
  /// if BackendChoice::Automatic can take a GPU but there are too few rays. Sets Report::leastRaysForGpu. Begins to
  /// open the backend.
  LazyBackend& backendFor(const Options& options, uint64_t rayCount, Report& report);

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

  /// The number of rays from which a GPU computes, if the session can take a GPU and has another choice.
  [[nodiscard]] std::optional<uint64_t> leastRays(const Options& options) const;

  SessionOptions options_;
  bool choosesByRays_;
  bool isUsed_;                       // Whether `backend` is open because of an earlier computation or the constructor.
  std::unique_ptr<LazyBackend> cpu_;  // For computations without rays or with few of them; null before the first one.
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
