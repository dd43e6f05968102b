#include "core/background_task.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <stdexcept>

#include "core/parallel.h"

using namespace asdfvk;

TEST_CASE("a background task ends in wait(), on one thread and on two") {
  for (const size_t threadCount : {1u, 2u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threadCount);
    int fromTask = 0;
    uint64_t fromBody = 0;
    BackgroundTask task([&] { fromTask = 7; });
    callIsolated([&] { fromBody = countInParallel(100'000, [](uint32_t i) { return i % 2 == 0; }); });
    task.wait();
    CHECK(fromTask == 7);
    CHECK(fromBody == 50'000);
  }
}

TEST_CASE("wait() throws what the task throws, and an exception of the body ends after the task") {
  BackgroundTask failing([] { throw std::runtime_error("of the task"); });
  CHECK_THROWS_WITH(failing.wait(), "of the task");
  int fromTask = 0;
  const auto run = [&] {
    BackgroundTask task([&] { fromTask = 7; });
    callIsolated([] { throw std::runtime_error("of the body"); });
  };
  CHECK_THROWS_WITH(run(), "of the body");
  CHECK(fromTask == 7);
  const auto runBoth = [] {
    BackgroundTask task([] { throw std::runtime_error("of the task"); });
    callIsolated([] { throw std::runtime_error("of the body"); });
  };
  CHECK_THROWS_WITH(runBoth(), "of the body");
}
