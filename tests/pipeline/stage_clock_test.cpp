#include "pipeline/stage_clock.h"

#include <doctest/doctest.h>

#include <vector>

#include <chrono>
#include <numeric>
#include <thread>

#include "core/stopwatch.h"

using namespace asdfvk;

namespace {

constexpr double kPause = 0.02;

void waitOnce() { std::this_thread::sleep_for(std::chrono::duration<double>(kPause)); }

double sumOf(const StageSeconds& seconds) {
  return std::accumulate(seconds.seconds.begin(), seconds.seconds.end(), 0.0);
}

}  // namespace

TEST_CASE("a nested scope pauses the enclosing one, so that no time is counted twice") {
  const Stopwatch watch;
  StageSeconds seconds;
  StageClock clock(seconds);
  {
    const auto trace = clock.time(Stage::Trace);
    waitOnce();
    {
      const auto sample = clock.time(Stage::Sample);
      waitOnce();
      waitOnce();
      {
        const auto solve = clock.time(Stage::Solve);
        waitOnce();
      }
    }
    waitOnce();
  }
  CHECK(seconds[Stage::Trace] >= 2 * kPause);
  CHECK(seconds[Stage::Sample] >= 2 * kPause);
  CHECK(seconds[Stage::Solve] >= kPause);
  CHECK(seconds[Stage::Bvh] == 0);
  // If a scope counted those inside of it, the sum would exceed the elapsed time by 4 pauses.
  CHECK(sumOf(seconds) <= watch.seconds() + 1e-9);
}

TEST_CASE("time outside of all scopes belongs to no stage") {
  StageSeconds seconds;
  StageClock clock(seconds);
  waitOnce();
  { const auto scope = clock.time(Stage::Trace); }
  waitOnce();
  CHECK(seconds[Stage::Trace] < kPause);
  CHECK(sumOf(seconds) == seconds[Stage::Trace]);
}

TEST_CASE("a stage inside of itself is counted once, and the times of its scopes are added") {
  const Stopwatch watch;
  StageSeconds seconds;
  StageClock clock(seconds);
  for (int i = 0; i < 2; ++i) {
    const auto outer = clock.time(Stage::Trace);
    const auto inner = clock.time(Stage::Trace);
    waitOnce();
  }
  CHECK(seconds[Stage::Trace] >= 2 * kPause);
  CHECK(seconds[Stage::Trace] <= watch.seconds() + 1e-9);
}

TEST_CASE("transferred seconds leave one stage and arrive at another") {
  StageSeconds seconds;
  StageClock clock(seconds);
  seconds[Stage::Upload] = 3;
  seconds[Stage::Encode] = 1;
  clock.transfer(Stage::Upload, Stage::Encode, 0.5);
  CHECK(seconds[Stage::Upload] == 2.5);
  CHECK(seconds[Stage::Encode] == 1.5);
  CHECK(sumOf(seconds) == 4);
}

TEST_CASE("an exception ends its scope, and the enclosing one continues") {
  StageSeconds seconds;
  StageClock clock(seconds);
  {
    const auto outer = clock.time(Stage::Trace);
    try {
      const auto inner = clock.time(Stage::Solve);
      throw 1;
    } catch (int) {
    }
    waitOnce();
  }
  CHECK(seconds[Stage::Trace] >= kPause);
  CHECK(seconds[Stage::Solve] < kPause);
}

TEST_CASE("a clock calls back for each stage that begins or goes on") {
  StageSeconds seconds;
  std::vector<Stage> stages;
  StageClock clock(seconds, [&](Stage stage) { stages.push_back(stage); });
  {
    const auto outer = clock.time(Stage::Solve);
    { const auto same = clock.time(Stage::Solve); }
    { const auto inner = clock.time(Stage::Predict); }
  }
  CHECK(stages == std::vector{Stage::Solve, Stage::Predict, Stage::Solve});
}
