#include "batch/worker_pool.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <map>
#include <system_error>
#include <thread>

#include "cli/scratch_folder.h"
#include "core/stopwatch.h"

namespace asdfvk {
namespace {

/// Functions of a shell that speak the messages of a MessageChannel.
const std::string kMessages =
    "get() { local n; read n && LC_ALL=C read -r -N $n \"$1\"; };"
    " put() { printf '%d\\n%s' ${#1} \"$1\"; };";

/// A worker in the language of the shell: answers each message with "done MESSAGE"; some make it misbehave.
const std::vector<std::string> kWorker{
    "/bin/bash", "-c",
    kMessages +
        " get greeting; put ready; while get job; do case $job in"
        " crash) kill -SEGV $$;; leave) exit 3;; hang) exec sleep 1000;;"
        " grow*|swell) x=x; while :; do x=$x$x; done;; slow) sleep 0.3; put 'done slow';;"
        " *) put \"done $job\";; esac; done"};

struct Ends {
  std::map<size_t, JobOutcome> outcomes;
  size_t readyCount = 0;
  std::string reason;
};

Ends runWorkers(const std::vector<std::string>& jobs, WorkerPoolOptions options = {}, const std::stop_token& stop = {},
                const std::function<void()>& atFinish = {}, uint32_t allowedCount = 100) {
  Ends ends;
  if (options.program.empty()) {
    options.program = kWorker.front();
    options.arguments = kWorker;
  }
  options.greeting = "hello";
  const WorkerPoolClient client{
      .request = [&](size_t job, uint32_t attempt) { return jobs[job] + (attempt == 1 ? "" : " again"); },
      .ready =
          [&](const std::string& answer) {
            CHECK_EQ(answer, "ready");
            ++ends.readyCount;
            return allowedCount;
          },
      .finished =
          [&](const JobOutcome& outcome) {
            CHECK(ends.outcomes.emplace(outcome.job, outcome).second);
            if (atFinish) atFinish();
            return outcome.answer != "done last";
          }};
  ends.reason = runOnWorkers(jobs.size(), options, client, stop);
  return ends;
}

TEST_CASE("each job is answered once, by as many workers as requested") {
  std::vector<std::string> jobs;
  for (int i = 0; i < 50; ++i) jobs.push_back(std::to_string(i));
  for (const uint32_t workerCount : {1U, 3U}) {
    const Ends ends = runWorkers(jobs, {.workerCount = workerCount});
    REQUIRE_EQ(ends.outcomes.size(), 50);
    for (const auto& [job, outcome] : ends.outcomes) {
      CHECK(outcome.end == JobEnd::Answered);
      CHECK_EQ(outcome.answer, "done " + std::to_string(job));
    }
    CHECK_LE(ends.readyCount, workerCount);
  }
}

TEST_CASE("a worker that crashes or leaves fails its job only, and is replaced") {
  const Ends ends = runWorkers({"a", "crash", "b", "leave", "c"});
  REQUIRE_EQ(ends.outcomes.size(), 5);
  CHECK_EQ(ends.readyCount, 3);
  CHECK(ends.outcomes.at(1).end == JobEnd::Crashed);
  CHECK_EQ(textOf(ends.outcomes.at(1).workerEnd), "ended by signal 11 (Segmentation fault)");
  CHECK_EQ(textOf(ends.outcomes.at(3).workerEnd), "ended with exit code 3");
  for (const size_t good : {0, 2, 4}) CHECK(ends.outcomes.at(good).end == JobEnd::Answered);
}

TEST_CASE("a worker that hangs is killed at the time limit") {
  const Stopwatch watch;
  const Ends ends = runWorkers({"a", "hang", "b"}, {.timeoutSeconds = 2});
  CHECK(ends.outcomes.at(1).end == JobEnd::TimedOut);
  CHECK_GE(ends.outcomes.at(1).seconds, 2);
  CHECK(ends.outcomes.at(2).end == JobEnd::Answered);
  CHECK_LT(watch.seconds(), 60);
}

TEST_CASE("a worker that grows is killed at the memory limit") {
  constexpr uint64_t kLimit = 64 << 20;
  const Ends ends = runWorkers({"a", "grow", "b"}, {.memoryBytes = kLimit});
  CHECK(ends.outcomes.at(1).end == JobEnd::MemoryExceeded);
  CHECK_GT(ends.outcomes.at(1).peakBytes, kLimit);
  CHECK_EQ(ends.outcomes.at(1).attempt, 2);
  CHECK(ends.outcomes.at(0).end == JobEnd::Answered);
  CHECK(ends.outcomes.at(2).end == JobEnd::Answered);
}

/// A worker that appends the begin and the end of each job to a file, with the number of workers at this time.
std::vector<std::string> tellingWorker(const std::string& file) {
  return {"/bin/bash", "-c",
          kMessages + " tell() { set -- \"$1\" $(cat /proc/$PPID/task/$PPID/children); echo \"$1 $(($# - 1))\" >> " +
              file +
              "; }; get greeting; put ready; while get job; do tell \"begin $job\"; case $job in"
              " die*) kill -KILL $$;; once) kill -KILL $$;; *) sleep 0.1;; esac; tell \"end $job\"; put \"done $job\";"
              " done"};
}

TEST_CASE("a job whose worker was killed for memory is tried once more at the end, while no other worker exists") {
  const test::ScratchFolder folder;
  const std::vector<std::string> worker = tellingWorker(folder / "told");
  const Ends ends = runWorkers({"once", "a", "b", "die", "c", "d", "e", "f"},
                               {.program = worker.front(), .arguments = worker, .workerCount = 3});
  REQUIRE_EQ(ends.outcomes.size(), 8);
  CHECK_EQ(ends.outcomes.at(0).answer, "done once again");
  CHECK_EQ(ends.outcomes.at(0).attempt, 2);
  CHECK(ends.outcomes.at(3).end == JobEnd::Crashed);
  CHECK_EQ(ends.outcomes.at(3).workerEnd.signal, SIGKILL);
  CHECK_EQ(ends.outcomes.at(3).attempt, 2);
  for (const size_t other : {1, 2, 4, 5, 6, 7}) CHECK_EQ(ends.outcomes.at(other).attempt, 1);
  const std::string told = folder.read("told");
  INFO(told);
  CHECK(told.ends_with("begin once again 1\nend once again 1\nbegin die again 1\n"));
  CHECK_GT(told.find("begin once again"), told.rfind("end f"));
}

TEST_CASE("at the memory limit a job is tried again, other crashes are not") {
  const Ends ends =
      runWorkers({"swell", "crash", "leave", "hang", "a"}, {.timeoutSeconds = 4, .memoryBytes = 64 << 20});
  REQUIRE_EQ(ends.outcomes.size(), 5);
  CHECK_EQ(ends.outcomes.at(0).answer, "done swell again");
  CHECK_EQ(ends.outcomes.at(0).attempt, 2);
  for (const size_t other : {1, 2, 3, 4}) CHECK_EQ(ends.outcomes.at(other).attempt, 1);
}

TEST_CASE("after a stop request no second attempt begins, and the job is dropped") {
  std::stop_source source;
  const std::vector<std::string> worker{
      "/bin/bash", "-c",
      kMessages + " get g; put ready; get job; [ $job = slow ] && sleep 0.3 && put ok; kill -KILL $$"};
  const Ends ends = runWorkers({"die", "slow"}, {.program = worker.front(), .arguments = worker, .workerCount = 1},
                               source.get_token(), [&] { source.request_stop(); });
  REQUIRE_EQ(ends.outcomes.size(), 2);
  CHECK(ends.outcomes.at(1).end == JobEnd::Answered);
  CHECK(ends.outcomes.at(0).end == JobEnd::Dropped);
}

TEST_CASE("after a stop request no job begins, and a worker that ignores it is killed") {
  std::stop_source source;
  // The first worker takes "slow" and "b"; the second one begins "hang" meanwhile.
  const Ends ends = runWorkers({"slow", "hang", "slow", "b", "c"}, {.workerCount = 2, .graceSeconds = 0.5},
                               source.get_token(), [&, count = 0]() mutable {
                                 if (++count == 2) source.request_stop();
                               });
  CHECK(ends.outcomes.at(0).end == JobEnd::Answered);
  REQUIRE_EQ(ends.outcomes.count(1), 1);
  CHECK(ends.outcomes.at(1).end == JobEnd::Dropped);
  CHECK_EQ(ends.outcomes.count(4), 0);
}

TEST_CASE("a worker that takes no further jobs is replaced") {
  const Ends ends = runWorkers({"a", "last", "b", "last", "c"});
  REQUIRE_EQ(ends.outcomes.size(), 5);
  CHECK_EQ(ends.readyCount, 3);
  CHECK_NE(ends.outcomes.at(0).worker, ends.outcomes.at(2).worker);
  for (const auto& [job, outcome] : ends.outcomes) CHECK(outcome.end == JobEnd::Answered);
}

TEST_CASE("a ready worker limits the number of workers, and one of no use ends the run") {
  std::vector<std::string> jobs(20, "slow");
  CHECK_LE(runWorkers(jobs, {.workerCount = 8}, {}, {}, 3).readyCount, 3);
  const Ends ends = runWorkers(jobs, {.workerCount = 8}, {}, {}, 0);
  CHECK_EQ(ends.readyCount, 1);
  CHECK(ends.outcomes.empty());
}

TEST_CASE("a worker that kept much memory is replaced before the next job") {
  const std::vector<std::string> worker{
      "/bin/bash", "-c",
      kMessages +
          " get greeting; put ready; while get job; do"
          " [ $job = keep ] && for ((i = 0; i < 50; ++i)); do printf -v x$i %1000000s; done; put $job; done"};
  const Ends ends =
      runWorkers({"a", "keep", "b"}, {.program = worker.front(), .arguments = worker, .memoryBytes = 80'000'000});
  REQUIRE_EQ(ends.outcomes.size(), 3);
  CHECK(ends.outcomes.at(1).end == JobEnd::Answered);
  CHECK_EQ(ends.outcomes.at(0).worker, ends.outcomes.at(1).worker);
  CHECK_NE(ends.outcomes.at(1).worker, ends.outcomes.at(2).worker);
  CHECK(ends.outcomes.at(2).end == JobEnd::Answered);
}

TEST_CASE("workers that cannot start, end or hang before they are ready end the run with the reason") {
  const auto reasonOf = [](const std::vector<std::string>& command) {
    const Ends ends = runWorkers(
        {"a", "b"}, {.program = command.front(), .arguments = command, .workerCount = 2, .startSeconds = 0.2});
    CHECK(ends.outcomes.empty());
    return ends.reason;
  };
  CHECK_EQ(reasonOf({"/bin/false"}), "ended with exit code 1");
  CHECK_EQ(reasonOf({"/bin/sleep", "1000"}), "not ready after 0.2 s");
  CHECK_THROWS_AS(reasonOf({"/missing"}), std::system_error);
}

TEST_CASE("jobs that arrive later begin when they have arrived") {
  std::array<int, 2> ends{};
  REQUIRE_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
  std::atomic<size_t> arrivedCount = 1;
  const std::jthread source([&] {
    for (int i = 0; i < 4; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      arrivedCount += i < 3 ? 1 : 100;  // The last step is the end.
      CHECK_EQ(::write(ends[1], "x", 1), 1);
    }
  });
  size_t finishedCount = 0;
  const auto next = [&](size_t job) {
    char ignored = 0;
    while (::read(ends[0], &ignored, 1) == 1) {
    }
    if (job < std::min<size_t>(arrivedCount, 4)) return JobSupply::State::Ready;
    return arrivedCount > 4 ? JobSupply::State::Ended : JobSupply::State::Later;
  };
  const WorkerPoolClient client{.request = [](size_t job, uint32_t) { return std::to_string(job); },
                                .ready = [](const std::string&) { return 2U; },
                                .finished =
                                    [&](const JobOutcome& outcome) {
                                      CHECK_EQ(outcome.answer, "done " + std::to_string(outcome.job));
                                      ++finishedCount;
                                      return true;
                                    }};
  const WorkerPoolOptions options{
      .program = kWorker.front(), .arguments = kWorker, .greeting = "hello", .workerCount = 2};
  CHECK_EQ(runOnWorkers({next, ends[0]}, options, client, {}), "");
  CHECK_EQ(finishedCount, 4);
  for (const int end : ends) ::close(end);
}

TEST_CASE("a job that is tried again does not wait for jobs that wait for its result") {
  std::map<size_t, std::string> answers;
  const auto next = [&](size_t job) {
    if (job == 6) return JobSupply::State::Ended;
    return job < 3 || answers.contains(0) ? JobSupply::State::Ready : JobSupply::State::Later;
  };
  const WorkerPoolClient client{.request =
                                    [](size_t job, uint32_t attempt) {
                                      return job == 0 && attempt == 1 ? std::string("grow")
                                                                      : fmt::format("{} {}", job, attempt);
                                    },
                                .ready = [](const std::string&) { return 2U; },
                                .finished =
                                    [&](const JobOutcome& outcome) {
                                      CHECK(answers.emplace(outcome.job, outcome.answer).second);
                                      return true;
                                    },
                                .retried = [](const JobOutcome& outcome) { CHECK_EQ(outcome.job, 0); }};
  const WorkerPoolOptions options{.program = kWorker.front(),
                                  .arguments = kWorker,
                                  .greeting = "hello",
                                  .workerCount = 2,
                                  .memoryBytes = uint64_t{50} << 20};
  CHECK_EQ(runOnWorkers({next, -1}, options, client, {}), "");
  const std::map<size_t, std::string> expected{{0, "done 0 2"}, {1, "done 1 1"}, {2, "done 2 1"},
                                               {3, "done 3 1"}, {4, "done 4 1"}, {5, "done 5 1"}};
  CHECK_EQ(answers, expected);
}

}  // namespace
}  // namespace asdfvk
