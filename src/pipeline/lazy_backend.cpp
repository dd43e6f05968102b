#include "pipeline/lazy_backend.h"

#include <chrono>
#include <exception>
#include <functional>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

constexpr auto kOpeningPollTime = std::chrono::milliseconds(20);

bool isReady(const std::shared_future<void>& work) {
  return !work.valid() || work.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// Calls `work` in a thread; if the system has no thread left, at the first wait.
std::shared_future<void> callInThread(std::function<void()> work) {
  try {
    return std::async(std::launch::async, work).share();
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, std::move(work)).share();
  }
}

}  // namespace

LazyBackend::LazyBackend(const SessionOptions& options, SessionOpening opening) : options_(options) {
  if (opening == SessionOpening::Now || !mayUseDevice(options.backend)) opened_ = openBackend(options);
}

void LazyBackend::begin() {
  if (hasBegun()) return;
  lavapipeThreads_.emplace();
  work_ = callInThread([this] { opened_ = openBackend(options_); });
}

bool LazyBackend::isDecided() const { return hasBegun() && isReady(work_); }
bool LazyBackend::isOpen() const { return isDecided() && opened_.backend != nullptr; }

NamedBackend& LazyBackend::open(const std::stop_token& stop) {
  begin();
  if (work_.valid()) {
    while (work_.wait_for(kOpeningPollTime) == std::future_status::timeout)
      if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
    lavapipeThreads_.reset();
    work_.get();
    work_ = {};
  }
  return opened_;
}

void LazyBackend::finish() noexcept {
  if (work_.valid()) work_.wait();
}

Backend& LazyBackend::openFor(SolverChoice solver, const std::stop_token& stop) {
  Backend& backend = *open(stop).backend;
  backend.requireSolver(solver);
  return backend;
}

bool LazyBackend::usesDevice() const {
  return isOpen() ? opened_.backend->hasDevice() : mayUseDevice(options_.backend);
}

BvhOptions LazyBackend::expectedBvhOptions() const {
  return isOpen() ? opened_.backend->bvhOptions() : BvhOptions{.maxLeafTriangleCount = kMaxWideLeafTriangleCount};
}

std::unique_ptr<EncodedScene> LazyBackend::encode(const TraceScene& scene) const {
  return usesDevice() ? encodeForVulkan(scene) : nullptr;
}

DeviceSeconds LazyBackend::deviceSeconds() {
  if (isOpen()) lastSeconds_ = opened_.backend->deviceSeconds().value_or(DeviceSeconds{});
  return lastSeconds_;
}

void LazyBackend::prepare(const KernelNeeds& needs) {
  if (!usesDevice()) return;
  work_ = callInThread([this, needs, earlier = work_] {
    if (earlier.valid()) earlier.get();
    try {
      opened_.backend->prepare(needs);
      if (needs.solves) (void)solver(opened_.backend->solverFor(needs.solver));
    } catch (const std::exception&) {
    }
  });
}

PoissonSolver& LazyBackend::solver(SolverChoice choice) {
  std::unique_ptr<PoissonSolver>& found = solvers_[choice];
  if (!found) found = opened_.backend->makeSolver(choice);
  return *found;
}

}  // namespace asdfvk
