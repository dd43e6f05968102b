#include "trace/adaptive_chunks.h"

#include <doctest/doctest.h>

#include <vector>

#include "asdf_vk/error.h"

using namespace asdfvk;

namespace {

/// What a caller of forEachChunkInFlight() observes.
struct Log {
  std::vector<size_t> begins, ends;
  size_t inFlightCount = 0, maxInFlightCount = 0, waitCount = 0;
};

/// maxCount: of the items that start() submits.
void run(Log& log, size_t count, const RunControl& control = {}, size_t maxCount = 1000) {
  forEachChunkInFlight<2>(
      count, ChunkSize(10, 1000), control,
      [&](size_t slot, size_t begin, size_t end) {
        CHECK(slot == log.begins.size() % 2);
        log.begins.push_back(begin);
        log.maxInFlightCount = std::max(log.maxInFlightCount, ++log.inFlightCount);
        return std::min(end, begin + maxCount);
      },
      [&](size_t slot) {
        CHECK(slot == log.waitCount % 2);
        ++log.waitCount;
      },
      [&](size_t, size_t begin, size_t end) {
        CHECK(begin == log.begins[log.ends.size()]);
        CHECK(end - begin <= maxCount);
        CHECK(log.waitCount == log.ends.size() + 1);
        log.ends.push_back(end);
        --log.inFlightCount;
      });
}

}  // namespace

TEST_CASE("ranges in flight cover all items once, in order, two at a time") {
  for (const size_t count : {0u, 1u, 10u, 11u, 5000u}) {
    CAPTURE(count);
    Log log, ofParts;
    run(ofParts, count, {}, 7);
    CHECK(ofParts.ends.size() == (count + 6) / 7);
    run(log, count);
    REQUIRE(log.begins.size() == log.ends.size());
    for (size_t i = 0; i < log.begins.size(); ++i) CHECK(log.begins[i] == (i == 0 ? 0 : log.ends[i - 1]));
    if (count > 0) CHECK(log.ends.back() == count);
    CHECK(log.maxInFlightCount == std::min<size_t>(log.begins.size(), 2));
    CHECK(log.inFlightCount == 0);
  }
}

TEST_CASE("the progress of ranges in flight counts finished ones, and a stop starts no further one") {
  Log log;
  std::stop_source stop;
  std::vector<double> fractions;
  const RunControl control{stop.get_token(), [&](double fraction) {
                             CHECK(fraction == doctest::Approx(log.ends.empty() ? 0 : log.ends.back() / 5000.0));
                             fractions.push_back(fraction);
                             if (fractions.size() == 3) stop.request_stop();
                           }};
  CHECK_THROWS_AS(run(log, 5000, control), Error);
  CHECK(fractions.size() == 3);
  CHECK(log.ends.size() == 3);  // The next checkpoint after the request ends the run.
  CHECK(log.begins.size() == 4);
}

TEST_CASE("chunks grow and shrink towards their time, within bounds") {
  ChunkSize chunk(1000, 1'000'000);
  chunk.adapt(1000, ChunkSize::kTargetSeconds / 1000);
  CHECK(chunk.current() == 4000);
  chunk.adapt(4000, ChunkSize::kTargetSeconds * 2);
  CHECK(chunk.current() == doctest::Approx(2000).epsilon(0.01));
  for (int i = 0; i < 20; ++i) chunk.adapt(chunk.current(), 1e-9);
  CHECK(chunk.current() == 1'000'000);
  for (int i = 0; i < 20; ++i) chunk.adapt(chunk.current(), 100);
  CHECK(chunk.current() == ChunkSize::kMin);
}
