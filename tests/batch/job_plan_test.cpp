#include "batch/engine.h"

#include <doctest/doctest.h>

#include <numeric>

namespace asdfvk {
namespace {

using Indices = std::vector<size_t>;

std::vector<JobPhase> planned(const std::vector<Job>& jobs, uint32_t requested, uint32_t threadCount) {
  Indices all(jobs.size());
  std::iota(all.begin(), all.end(), size_t{0});
  return planJobs(jobs, all, requested, threadCount);
}

TEST_CASE("many small meshes are computed at once, large ones one after another before them") {
  std::vector<Job> jobs(20, Job{"a", "b", 1'000'000});
  CHECK_EQ(planned(jobs, 0, 4).front().atOnce, 4);
  CHECK_EQ(planned(jobs, 0, 4).front().threadCount, 1);
  CHECK_EQ(planned(jobs, 0, 1).front().atOnce, 1);
  CHECK_EQ(planned(jobs, 0, 64).front().atOnce, 5);  // Each opens a device.
  CHECK_EQ(planned(jobs, 3, 8).front().atOnce, 3);
  CHECK_EQ(planned(jobs, 3, 8).front().threadCount, 2);
  jobs[7].byteCount = uint64_t{1} << 30;
  const std::vector<JobPhase> phases = planned(jobs, 0, 4);
  REQUIRE_EQ(phases.size(), 2);
  CHECK_EQ(phases[0].jobs, Indices{7});
  CHECK_EQ(phases[0].threadCount, 4);
  CHECK_EQ(phases[1].jobs.size(), 19);
  CHECK_EQ(phases[1].atOnce, 4);
  CHECK(planJobs(jobs, {}, 0, 4).empty());
  CHECK_EQ(planJobs(jobs, {3, 7}, 2, 4).front().jobs, Indices{3, 7});
  jobs.resize(2);
  CHECK_EQ(planned(jobs, 0, 4).size(), 1);
  CHECK_EQ(planned(jobs, 0, 4).front().threadCount, 4);
}

TEST_CASE("few bytes are computed in this process, unless workers are requested") {
  const std::vector<Job> tiny(20, Job{"a", "b", 1000}), many(200, Job{"a", "b", 1000});
  CHECK_EQ(planned(tiny, 0, 4).front().atOnce, 1);
  CHECK_EQ(planned(tiny, 2, 4).front().atOnce, 2);
  CHECK_EQ(planned(many, 0, 4).front().atOnce, 3);
}

TEST_CASE("a stream is never computed together with other meshes, also where this is requested") {
  std::vector<Job> jobs(10, Job{"a", "b", 1'000'000});
  jobs[4].isStream = true;
  for (const uint32_t requested : {0U, 2U}) {
    const std::vector<JobPhase> phases = planned(jobs, requested, 2);
    REQUIRE_EQ(phases.size(), 2);
    CHECK_EQ(phases[0].jobs, Indices{4});
    CHECK_EQ(phases[0].atOnce, 1);
    CHECK_EQ(phases[1].jobs.size(), 9);
    CHECK_EQ(phases[1].atOnce, 2);
  }
  CHECK_EQ(planned(jobs, 1, 2).size(), 1);
}

}  // namespace
}  // namespace asdfvk
