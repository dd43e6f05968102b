#include "batch/lanes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <latch>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Only its end is used.
class SpentComputer : public JobComputer {
 public:
  explicit SpentComputer(bool isSpent) : isSpent_(isSpent) {}
  [[nodiscard]] ComputerDescription describe() const override { return {}; }
  [[nodiscard]] JobResult compute(const Job&, const Job*) override { return {}; }
  [[nodiscard]] bool isSpent() const override { return isSpent_; }

 private:
  bool isSpent_;
};

/// What lanes did.
struct LaneRun {
  std::mutex mutex;
  size_t openCount = 0;
  size_t maxOpenCount = 1000;
  bool isSpentAfterEachJob = false;
  std::function<void()> failsOpening;
  std::vector<size_t> begun;  ///< Jobs in the order in which they began.
  std::stop_source stop;

  /// Calls visit(job) in each job, without the lock.
  template <typename Visit>
  std::optional<OpenFailure> run(size_t jobCount, const LaneOptions& options, const Visit& visit) {
    const LaneClient client{.open =
                                [&] {
                                  const std::lock_guard lock(mutex);
                                  if (openCount == maxOpenCount) {
                                    if (failsOpening) failsOpening();
                                    throw OpenFailure(3, "noDevice", "no device is left");
                                  }
                                  ++openCount;
                                  return std::make_unique<SpentComputer>(isSpentAfterEachJob);
                                },
                            .compute =
                                [&](JobComputer&, size_t job) {
                                  {
                                    const std::lock_guard lock(mutex);
                                    begun.push_back(job);
                                  }
                                  visit(job);
                                }};
    return runInLanes(jobCount, options, client, stop.get_token());
  }
  [[nodiscard]] bool hasBegunAll(size_t jobCount) {
    std::sort(begun.begin(), begun.end());
    for (size_t i = 0; i < begun.size(); ++i)
      if (begun[i] != i) return false;
    return begun.size() == jobCount;
  }
};

/// A point that lanes reach together.
class Meeting {
 public:
  explicit Meeting(std::ptrdiff_t laneCount) : missing_(laneCount) {}
  /// Waits until all lanes have called this function; a minute at most, after which the test fails.
  void join() {
    missing_.count_down();
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!missing_.try_wait() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(missing_.try_wait());
  }

 private:
  std::latch missing_;
};

constexpr auto doNothing = [](size_t) {};

TEST_CASE("three lanes compute at the same time, each with a computer of its own, and each job once") {
  LaneRun lanes;
  Meeting ofLanes(3);
  CHECK_FALSE(lanes.run(12, {3, 1}, [&](size_t job) {
    if (job < 3) ofLanes.join();
  }));
  CHECK_EQ(lanes.openCount, 3);
  CHECK(lanes.hasBegunAll(12));
}

TEST_CASE("one lane computes the jobs in their order, in this thread") {
  LaneRun lanes;
  const std::thread::id caller = std::this_thread::get_id();
  CHECK_FALSE(lanes.run(5, {1, 1}, [&](size_t) { CHECK(std::this_thread::get_id() == caller); }));
  CHECK_EQ(lanes.begun, std::vector<size_t>{0, 1, 2, 3, 4});
  CHECK_EQ(lanes.openCount, 1);
}

TEST_CASE("loops of a lane use its share of the threads") {
  LaneRun lanes;
  std::atomic<size_t> otherCount = 0;
  (void)lanes.run(4, {2, 1}, [&](size_t) {
    CHECK_EQ(threadLimit(), 1);
    const std::thread::id own = std::this_thread::get_id();
    forEachTask(20, [&](size_t) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // Long enough for a further thread to begin a task.
      otherCount += std::this_thread::get_id() == own ? 0 : 1;
    });
  });
  CHECK_EQ(otherCount, 0);
}

TEST_CASE("a spent computer is replaced; where none is left, the error is thrown unless all jobs have begun") {
  LaneRun replaced;
  replaced.isSpentAfterEachJob = true;
  CHECK_FALSE(replaced.run(9, {2, 1}, doNothing));
  CHECK_GE(replaced.openCount, 9);  // At the end a lane may open one and find no job.
  CHECK(replaced.hasBegunAll(9));
  LaneRun lost;
  lost.isSpentAfterEachJob = true;
  lost.maxOpenCount = 4;
  CHECK_THROWS_AS((void)lost.run(9, {2, 1}, doNothing), OpenFailure);
  CHECK_EQ(lost.begun.size(), 4);
  std::latch hasFailed(1);
  LaneRun fewer;
  fewer.maxOpenCount = 1;
  fewer.failsOpening = [&] { hasFailed.count_down(); };
  const std::optional<OpenFailure> failure = fewer.run(9, {2, 1}, [&](size_t) { hasFailed.wait(); });
  CHECK(fewer.hasBegunAll(9));
  REQUIRE(failure);
  CHECK_EQ(failure->code, 3);
  LaneRun none;
  none.maxOpenCount = 0;
  for (const uint32_t laneCount : {1U, 2U}) CHECK_THROWS_AS((void)none.run(9, {laneCount, 1}, doNothing), OpenFailure);
  CHECK(none.begun.empty());
}

TEST_CASE("an error of one lane ends all lanes after their current jobs, and is thrown") {
  constexpr size_t kJobCount = 10'000;  // Each takes 5 ms.
  for (const uint32_t laneCount : {1U, 3U}) {
    LaneRun lanes;
    Meeting ofLanes(laneCount);
    const auto compute = [&](size_t job) {
      if (job < laneCount) ofLanes.join();
      if (job == 0) throw std::runtime_error("the log cannot be written");
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    };
    CHECK_THROWS_WITH_AS((void)lanes.run(kJobCount, {laneCount, 1}, compute), "the log cannot be written",
                         std::runtime_error);
    CHECK_GE(lanes.begun.size(), laneCount);
    CHECK_LT(lanes.begun.size(), kJobCount);
  }
}

TEST_CASE("after a stop request no lane begins a job") {
  LaneRun lanes;
  Meeting before(2), after(2);
  CHECK_FALSE(lanes.run(100, {2, 1}, [&](size_t) {
    before.join();
    lanes.stop.request_stop();
    after.join();
  }));
  CHECK_EQ(lanes.begun.size(), 2);
}

}  // namespace
}  // namespace asdfvk
