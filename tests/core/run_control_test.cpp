#include "asdf_vk/run_control.h"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <vector>

#include "asdf_vk/error.h"

using namespace asdfvk;

TEST_CASE("a checkpoint reports progress, or nothing without a callback") {
  CHECK_NOTHROW(RunControl{}.checkpoint(0.5));
  std::vector<double> fractions;
  RunControl control;
  control.progress = [&](double fraction) { fractions.push_back(fraction); };
  control.checkpoint(0.25);
  control.checkpoint(1);
  CHECK(fractions == std::vector<double>{0.25, 1});
}

TEST_CASE("a checkpoint after a stop request throws Cancelled and reports nothing") {
  std::stop_source source;
  bool wasCalled = false;
  const RunControl control{source.get_token(), [&](double) { wasCalled = true; }};
  source.request_stop();
  try {
    control.checkpoint(0.5);
    FAIL("no exception");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
  CHECK_FALSE(wasCalled);
}

TEST_CASE("a limit of threads holds while it exists, and the least of several") {
  using oneapi::tbb::global_control;
  const auto active = [] { return global_control::active_value(global_control::max_allowed_parallelism); };
  const size_t before = active();
  {
    const ThreadLimit one(1);
    CHECK(active() == 1);
    const ThreadLimit many(7);
    CHECK(active() == 1);
    const ThreadLimit none(0);
    CHECK(active() == 1);
  }
  CHECK(active() == before);
}
