#pragma once

#include <future>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>

#include "pipeline/backend.h"
#include "pipeline/lavapipe_threads.h"
#include "poisson/poisson_solver.h"

namespace asdfvk {

/// The backend of a session with its solvers. A thread opens the backend (SessionOpening::InThread) and makes the
/// kernels of a computation while the caller prepares the mesh. Not thread-safe: the thread uses only the backend and
/// the solvers.
class LazyBackend {
 public:
  /// SessionOpening::Now throws the errors of openBackend(); with SessionOpening::InThread, open() throws them.
  LazyBackend(const SessionOptions& options, SessionOpening opening);
  /// A backend that is open.
  explicit LazyBackend(NamedBackend opened) : opened_(std::move(opened)) {}
  /// Waits for the thread.
  ~LazyBackend() = default;
  LazyBackend(const LazyBackend&) = delete;
  LazyBackend& operator=(const LazyBackend&) = delete;

  /// Begins to open the backend in a thread, unless it is open or its opening has begun.
  void begin();
  [[nodiscard]] bool hasBegun() const { return work_.valid() || opened_.backend != nullptr; }
  /// Whether open() would not wait.
  [[nodiscard]] bool isDecided() const;
  /// Whether open() would neither wait nor throw.
  [[nodiscard]] bool isOpen() const;
  /// Calls begin() and waits for the thread. Throws the errors of openBackend(), the same at each call;
  /// Error{Cancelled}.
  NamedBackend& open(const std::stop_token& stop = {});
  /// Waits for the thread, also if it fails.
  void finish() noexcept;
  /// The open backend, which can run a solver. Throws the errors of open() and of Backend::requireSolver().
  Backend& openFor(SolverChoice solver, const std::stop_token& stop);
  [[nodiscard]] Backend& operator*() { return *open().backend; }
  [[nodiscard]] Backend* operator->() { return open().backend.get(); }

  /// Backend::bvhOptions(); before the backend is open, those of the first backend that the session options allow.
  [[nodiscard]] BvhOptions expectedBvhOptions() const;
  /// Encodes a scene for tracers of the backend that expectedBvhOptions() describes; null if its tracers encode scenes.
  [[nodiscard]] std::unique_ptr<EncodedScene> encode(const TraceScene& scene) const;

  /// Backend::deviceSeconds() when isOpen() was last true; without timestamps 0.
  [[nodiscard]] DeviceSeconds deviceSeconds();

  /// Makes kernels and solvers in the thread. After a failure, the computation makes them again.
  void prepare(const KernelNeeds& needs);
  /// The solver of a choice, which is created at its first use. Throws the errors of Backend::makeSolver().
  [[nodiscard]] PoissonSolver& solver(SolverChoice choice);

 private:
  /// Whether a device is expected, or is open.
  [[nodiscard]] bool usesDevice() const;

  SessionOptions options_;
  std::optional<LavapipeThreads> lavapipeThreads_;
  NamedBackend opened_;
  DeviceSeconds lastSeconds_;
  std::map<SolverChoice, std::unique_ptr<PoissonSolver>> solvers_;  // Destroyed before the device that they use.
  std::shared_future<void> work_;  // The last work of the thread; invalid without any. Its destructor waits.
};

}  // namespace asdfvk
