#include "seeds/dart_throwing.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "seeds/surface.h"

using namespace asdfvk;

TEST_CASE("darts leave gaps where more than the requested number fit at the start radius") {
  const Surface surface(strip(100));
  const UnsetVector<float> lengths = arcLengths(arcAngles(surface.graph, surface.geometry));
  const auto thrown = [&](uint64_t count, float startRadius) {
    SurfaceDistances distances(surface.graph, lengths);
    distances.add({}, startRadius);
    return throwDarts({0, 10, 1, 20, 30}, count, startRadius, distances);
  };
  for (const uint64_t count : {2u, 3u}) {
    CAPTURE(count);
    const ThrownDarts darts = thrown(count, 5);
    CHECK(darts.leaveGaps);
    CHECK(std::equal(darts.faces.begin(), darts.faces.end(), std::vector<uint32_t>{0, 10, 20}.begin()));
  }
  CHECK(thrown(4, 5).faces == std::vector<uint32_t>{0, 10, 20, 30});
  CHECK_FALSE(thrown(4, 5).leaveGaps);
  // The fifth dart is at a smaller radius.
  CHECK(thrown(5, 5).faces == std::vector<uint32_t>{0, 10, 20, 30, 1});
  CHECK_FALSE(thrown(5, 5).leaveGaps);
  CHECK_FALSE(thrown(2, SurfaceDistances::kUnreached).leaveGaps);
}
