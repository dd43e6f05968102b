#include "batch/lanes.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace asdfvk {
namespace {

class Lanes {
 public:
  Lanes(size_t jobCount, const LaneOptions& options, const LaneClient& client, const std::stop_token& stop)
      : jobCount_(jobCount), options_(options), client_(client), stop_(stop) {}

  std::optional<OpenFailure> run() {
    if (options_.laneCount == 1) {
      runLane(nullptr);
      return {};
    }
    std::unique_ptr<JobComputer> first = client_.open();
    {
      std::vector<std::jthread> others;
      try {
        while (others.size() + 1 < options_.laneCount) others.emplace_back([this] { runGuarded(nullptr); });
      } catch (const std::system_error&) {  // The system has no thread left.
      }
      runGuarded(std::move(first));
    }
    if (error_) std::rethrow_exception(error_);
    if (openFailure_ && hasJobs()) throw OpenFailure(*openFailure_);
    return openFailure_;
  }

 private:
  [[nodiscard]] bool hasJobs() const { return next_ < jobCount_ && !stop_.stop_requested(); }

  void runLane(std::unique_ptr<JobComputer> computer) {
    while (hasJobs()) {
      if (!computer) computer = client_.open();
      const size_t job = next_++;
      if (job >= jobCount_) return;
      client_.compute(*computer, job);
      if (computer->isSpent()) computer.reset();
    }
  }

  void runGuarded(std::unique_ptr<JobComputer> computer) {
    try {
      callWithThreads(options_.threadCount, [&] { runLane(std::move(computer)); });
    } catch (const OpenFailure& failure) {
      const std::lock_guard lock(mutex_);
      openFailure_.emplace(failure);
    } catch (...) {
      next_ = jobCount_;
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  const size_t jobCount_;
  const LaneOptions& options_;
  const LaneClient& client_;
  const std::stop_token& stop_;
  std::atomic<size_t> next_ = 0;
  std::mutex mutex_;
  std::optional<OpenFailure> openFailure_;
  std::exception_ptr error_;
};

}  // namespace

std::optional<OpenFailure> runInLanes(size_t jobCount, const LaneOptions& options, const LaneClient& client,
                                      const std::stop_token& stop) {
  return Lanes(jobCount, options, client, stop).run();
}

}  // namespace asdfvk
