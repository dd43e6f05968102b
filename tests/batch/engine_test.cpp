#include "batch/engine.h"

#include <doctest/doctest.h>

#include <memory>
#include <mutex>
#include <set>

namespace asdfvk {
namespace {

/// Jobs of a batch that are computed in this process.
struct Batch {
  std::vector<Job> jobs;
  std::mutex mutex;
  std::vector<std::string> computed, readAhead;
  size_t openCount = 0;
  uint32_t sharingCount = 0;  ///< The number of computers that share the device.
  std::stop_source stop;

  /// Each mesh in one file of a byte.
  explicit Batch(const std::vector<std::string>& meshes) {
    for (const std::string& mesh : meshes) jobs.push_back({mesh, mesh + ".npy", 1});
  }
};

/// Drops *stop*, which requests a stop; its device is lost after *lose*.
class FakeComputer : public JobComputer {
 public:
  explicit FakeComputer(Batch& batch) : batch_(batch) {
    const std::lock_guard lock(batch_.mutex);
    ++batch.openCount;
  }
  [[nodiscard]] ComputerDescription describe() const override { return {"reference", "", true}; }
  [[nodiscard]] JobResult compute(const Job& job, const Job* next) override {
    const std::lock_guard lock(batch_.mutex);
    batch_.computed.push_back(job.input);
    if (next != nullptr) batch_.readAhead.push_back(next->input);
    JobResult result;
    result.record.input = job.input;
    if (job.input == "stop") {
      batch_.stop.request_stop();
      result.record.status = MeshStatus::Dropped;
    }
    isSpent_ = job.input == "lose";
    result.record.code = isSpent_ ? 3 : 0;
    return result;
  }
  [[nodiscard]] bool isSpent() const override { return isSpent_; }

 private:
  Batch& batch_;
  bool isSpent_ = false;
};

/// Returns the monitor after the run.
std::unique_ptr<Monitor> run(Batch& batch, size_t maxOpenCount = 100,
                             const EngineOptions& options = {.requestedAtOnce = 1}) {
  auto monitor = std::make_unique<Monitor>(MonitorOptions{.isQuiet = true}, batch.jobs);
  const EngineClient client{.findFinished = [](const Job& job) -> std::optional<JobResult> {
                              if (job.input != "finished") return std::nullopt;
                              JobResult result;
                              result.record.input = job.input;
                              result.record.status = MeshStatus::Skipped;
                              return result;
                            },
                            .open = [&]() -> std::unique_ptr<JobComputer> {
                              if (batch.openCount == maxOpenCount)
                                throw OpenFailure(3, "noDevice", "no device is left");
                              return std::make_unique<FakeComputer>(batch);
                            },
                            .shareDevice =
                                [&](uint32_t count) {
                                  batch.sharingCount = count;
                                  return true;
                                }};
  try {
    runJobs(batch.jobs, options, client, *monitor, batch.stop.get_token());
    monitor->finish();
  } catch (...) {
    monitor->finish();
    throw;
  }
  return monitor;
}

using Names = std::vector<std::string>;

TEST_CASE("jobs that are not finished are computed in their order by one computer, which may read the next one") {
  Batch batch({"a", "finished", "b", "c"});
  const std::unique_ptr<Monitor> monitor = run(batch);
  CHECK_EQ(batch.computed, Names{"a", "b", "c"});
  CHECK_EQ(batch.readAhead, Names{"b", "c"});
  CHECK_EQ(batch.openCount, 1);
  CHECK(monitor->unfinishedJobs().empty());
  CHECK_FALSE(monitor->hasUnfinished());
  CHECK_EQ(monitor->codes(), std::set<int>{0});
}

TEST_CASE("several jobs at once are computed in lanes, which read no file ahead; by default at most four") {
  for (const uint32_t requested : {0U, 3U, 6U}) {
    Batch batch(Names(40, "a"));
    for (Job& job : batch.jobs) job.byteCount = 1'000'000;
    batch.jobs[7].input = "finished";
    CHECK_FALSE(run(batch, 100, {.requestedAtOnce = requested, .threadCount = 8})->hasUnfinished());
    CHECK_EQ(batch.sharingCount, requested == 0 ? 4 : requested);
    CHECK_EQ(batch.computed.size(), 39);
    CHECK(batch.readAhead.empty());
    CHECK_LE(batch.openCount, batch.sharingCount);
  }
  Batch alone({"a", "b"});
  CHECK_FALSE(run(alone)->hasUnfinished());
  CHECK_EQ(alone.sharingCount, 0);
}

TEST_CASE("no computer is opened where all jobs are finished, and none after the last job") {
  Batch finished({"finished", "finished"});
  CHECK_FALSE(run(finished)->hasUnfinished());
  CHECK_EQ(finished.openCount, 0);
  Batch last({"a", "lose"});
  CHECK_FALSE(run(last)->hasUnfinished());
  CHECK_EQ(last.openCount, 1);
}

TEST_CASE("a computer whose device failed is replaced; where none can be opened, the other jobs have no result") {
  Batch batch({"a", "lose", "b"});
  CHECK_EQ(run(batch)->codes(), std::set<int>{0, 3});
  CHECK_EQ(batch.openCount, 2);
  Batch lost({"a", "lose", "b", "c"});
  CHECK_THROWS_AS((void)run(lost, 1), OpenFailure);
  CHECK_EQ(lost.computed, Names{"a", "lose"});
}

TEST_CASE("after a stop request no job begins") {
  Batch batch({"a", "stop", "b"});
  const std::unique_ptr<Monitor> monitor = run(batch);
  CHECK_EQ(batch.computed, Names{"a", "stop"});
  CHECK_EQ(monitor->unfinishedJobs(), std::vector<size_t>{2});
  CHECK(monitor->hasUnfinished());
}

}  // namespace
}  // namespace asdfvk
