#include "batch/worker_pool.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <thread>

#include "core/stopwatch.h"

namespace asdfvk {
namespace {

/// A worker in the language of the shell: answers each line with "done LINE"; some lines make it misbehave.
const std::vector<std::string> kWorker{"/bin/bash", "-c",
                                       "read greeting; echo ready; while read task; do case $task in"
                                       " crash) kill -SEGV $$;; leave) exit 3;; hang) exec sleep 1000;;"
                                       " grow) x=x; while :; do x=$x$x; done;; slow) sleep 0.3; echo done slow;;"
                                       " *) echo \"done $task\";; esac; done"};

struct Ends {
  std::map<size_t, TaskOutcome> outcomes;
  size_t readyCount = 0;
  std::string reason;
};

Ends runTasks(const std::vector<std::string>& tasks, WorkerPoolOptions options = {}, const std::stop_token& stop = {},
              const std::function<void()>& atFinish = {}, uint32_t allowedCount = 100) {
  Ends ends;
  if (options.program.empty()) {
    options.program = kWorker.front();
    options.arguments = kWorker;
  }
  options.greeting = "hello";
  const WorkerPoolClient client{.request = [&](size_t task) { return tasks[task]; },
                                .ready =
                                    [&](const std::string& answer) {
                                      CHECK_EQ(answer, "ready");
                                      ++ends.readyCount;
                                      return allowedCount;
                                    },
                                .finished =
                                    [&](const TaskOutcome& outcome) {
                                      CHECK(ends.outcomes.emplace(outcome.task, outcome).second);
                                      if (atFinish) atFinish();
                                      return outcome.answer != "done last";
                                    }};
  ends.reason = runOnWorkers(tasks.size(), options, client, stop);
  return ends;
}

TEST_CASE("each task is answered once, by as many workers as requested") {
  std::vector<std::string> tasks;
  for (int i = 0; i < 50; ++i) tasks.push_back(std::to_string(i));
  for (const uint32_t workerCount : {1U, 3U}) {
    const Ends ends = runTasks(tasks, {.workerCount = workerCount});
    REQUIRE_EQ(ends.outcomes.size(), 50);
    for (const auto& [task, outcome] : ends.outcomes) {
      CHECK(outcome.end == TaskEnd::Answered);
      CHECK_EQ(outcome.answer, "done " + std::to_string(task));
    }
    CHECK_LE(ends.readyCount, workerCount);
  }
}

TEST_CASE("a worker that crashes or leaves fails its task only, and is replaced") {
  const Ends ends = runTasks({"a", "crash", "b", "leave", "c"});
  REQUIRE_EQ(ends.outcomes.size(), 5);
  CHECK_EQ(ends.readyCount, 3);
  CHECK(ends.outcomes.at(1).end == TaskEnd::Crashed);
  CHECK_EQ(textOf(ends.outcomes.at(1).workerEnd), "ended by signal 11 (Segmentation fault)");
  CHECK_EQ(textOf(ends.outcomes.at(3).workerEnd), "ended with exit code 3");
  for (const size_t good : {0, 2, 4}) CHECK(ends.outcomes.at(good).end == TaskEnd::Answered);
}

TEST_CASE("a worker that hangs is killed at the time limit") {
  const Stopwatch watch;
  const Ends ends = runTasks({"a", "hang", "b"}, {.timeoutSeconds = 2});
  CHECK(ends.outcomes.at(1).end == TaskEnd::TimedOut);
  CHECK_GE(ends.outcomes.at(1).seconds, 2);
  CHECK(ends.outcomes.at(2).end == TaskEnd::Answered);
  CHECK_LT(watch.seconds(), 60);
}

TEST_CASE("a worker that grows is killed at the memory limit") {
  constexpr uint64_t kLimit = 64 << 20;
  const Ends ends = runTasks({"a", "grow", "b"}, {.memoryBytes = kLimit});
  CHECK(ends.outcomes.at(1).end == TaskEnd::MemoryExceeded);
  CHECK_GT(ends.outcomes.at(1).peakBytes, kLimit);
  CHECK(ends.outcomes.at(0).end == TaskEnd::Answered);
  CHECK(ends.outcomes.at(2).end == TaskEnd::Answered);
}

TEST_CASE("after a stop request no task begins, and a worker that ignores it is killed") {
  std::stop_source source;
  // The first worker takes "slow" and "b"; the second one begins "hang" meanwhile.
  const Ends ends = runTasks({"slow", "hang", "slow", "b", "c"}, {.workerCount = 2, .graceSeconds = 0.5},
                             source.get_token(), [&, count = 0]() mutable {
                               if (++count == 2) source.request_stop();
                             });
  CHECK(ends.outcomes.at(0).end == TaskEnd::Answered);
  REQUIRE_EQ(ends.outcomes.count(1), 1);
  CHECK(ends.outcomes.at(1).end == TaskEnd::Dropped);
  CHECK_EQ(ends.outcomes.count(4), 0);
}

TEST_CASE("a worker that takes no further tasks is replaced") {
  const Ends ends = runTasks({"a", "last", "b", "last", "c"});
  REQUIRE_EQ(ends.outcomes.size(), 5);
  CHECK_EQ(ends.readyCount, 3);
  CHECK_NE(ends.outcomes.at(0).worker, ends.outcomes.at(2).worker);
  for (const auto& [task, outcome] : ends.outcomes) CHECK(outcome.end == TaskEnd::Answered);
}

TEST_CASE("a ready worker limits the number of workers, and one of no use ends the run") {
  std::vector<std::string> tasks(20, "slow");
  CHECK_LE(runTasks(tasks, {.workerCount = 8}, {}, {}, 3).readyCount, 3);
  const Ends ends = runTasks(tasks, {.workerCount = 8}, {}, {}, 0);
  CHECK_EQ(ends.readyCount, 1);
  CHECK(ends.outcomes.empty());
}

TEST_CASE("a worker that kept much memory is replaced before the next task") {
  const std::vector<std::string> worker{"/bin/bash", "-c",
                                        "read greeting; echo ready; while read task; do "
                                        "[ $task = keep ] && printf -v x %50000000s; echo $task; done"};
  const Ends ends =
      runTasks({"a", "keep", "b"}, {.program = worker.front(), .arguments = worker, .memoryBytes = 80'000'000});
  REQUIRE_EQ(ends.outcomes.size(), 3);
  CHECK_EQ(ends.outcomes.at(0).worker, ends.outcomes.at(1).worker);
  CHECK_NE(ends.outcomes.at(1).worker, ends.outcomes.at(2).worker);
  CHECK(ends.outcomes.at(2).end == TaskEnd::Answered);
}

TEST_CASE("workers that cannot start, end or hang before they are ready end the run with the reason") {
  const auto reasonOf = [](const std::vector<std::string>& command) {
    const Ends ends =
        runTasks({"a", "b"}, {.program = command.front(), .arguments = command, .workerCount = 2, .startSeconds = 0.2});
    CHECK(ends.outcomes.empty());
    return ends.reason;
  };
  CHECK_EQ(reasonOf({"/bin/false"}), "ended with exit code 1");
  CHECK_EQ(reasonOf({"/bin/sleep", "1000"}), "not ready after 0.2 s");
  CHECK_THROWS_AS(reasonOf({"/missing"}), std::system_error);
}

}  // namespace
}  // namespace asdfvk
