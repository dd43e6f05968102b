#include "batch/progress.h"

#include <doctest/doctest.h>

#include <cmath>

#include "batch/input_list.h"

namespace asdfvk {
namespace {

MeshRecord withStatus(MeshStatus status) {
  MeshRecord record;
  record.status = status;
  record.faceCount = 1000;
  return record;
}

TEST_CASE("the time left is estimated from bytes; skipped meshes count for nothing") {
  BatchProgress progress{.meshCount = 4, .byteCount = 4 * 1'000'000};
  CHECK(std::isinf(progress.secondsLeft(1)));
  CHECK_EQ(progress.share(), 0);
  progress.count(withStatus(MeshStatus::Skipped), 1'000'000);
  CHECK(std::isinf(progress.secondsLeft(1)));
  CHECK_EQ(progress.share(), doctest::Approx(0.25));
  progress.count(withStatus(MeshStatus::Done), 1'000'000);
  CHECK_EQ(progress.secondsLeft(10), doctest::Approx(20));
  progress.count(withStatus(MeshStatus::Failed), 1'000'000);
  CHECK_EQ(progress.secondsLeft(10), doctest::Approx(5));
  CHECK_EQ(progressText(progress, 10), "3 of 4 meshes, 0.2 meshes/s, 5 s left, 1 skipped, 1 failed");
  progress.count(withStatus(MeshStatus::Done), 1'000'000);
  CHECK_EQ(progress.share(), 1);
  CHECK_EQ(progress.secondsLeft(10), 0);
  CHECK_EQ(summaryText(progress, 10), "2 done, 1 skipped, 1 failed; 10 s, 0.3 meshes/s, 0.0002 million faces/s");
}

TEST_CASE("a skipped mesh with a verdict of an earlier run is counted by this verdict") {
  BatchProgress progress{.meshCount = 3, .isCheck = true};
  MeshRecord thin = withStatus(MeshStatus::Skipped);
  thin.code = 6;
  thin.error = "tooThin";
  progress.count(thin, 0);
  progress.count(withStatus(MeshStatus::Skipped), 0);
  thin.status = MeshStatus::Failed;
  progress.count(thin, 0);
  CHECK_EQ(summaryText(progress, 2), "0 ok, 1 skipped, 2 thin; 2 s, 0.5 meshes/s, 0 million faces/s");
  CHECK_EQ(progress.finishedCount(), 3);
}

TEST_CASE("what was dropped and what did not begin is in the summary") {
  BatchProgress progress{.meshCount = 1234};
  progress.count(withStatus(MeshStatus::Dropped), 0);
  CHECK_EQ(summaryText(progress, 2), "0 done, 1 dropped, 1,233 not begun; 2 s");
}

TEST_CASE("durations have two units") {
  CHECK_EQ(durationText(0.4), "0 s");
  CHECK_EQ(durationText(59.6), "1 min 0 s");
  CHECK_EQ(durationText(155), "2 min 35 s");
  CHECK_EQ(durationText(3 * 3600 + 12 * 60 + 5), "3 h 12 min");
  CHECK_EQ(durationText(2 * 86400 + 4 * 3600), "2 d 4 h");
}

}  // namespace
}  // namespace asdfvk
