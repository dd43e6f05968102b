#include "paper/plots/label_places.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "core/random.h"

namespace asdfvk::bench {
namespace {

TEST_CASE("labels with room stay where they want to be") {
  CHECK_EQ(placeLabels({30, 10, 50}, 15, 0, 100), std::vector<double>{30, 10, 50});
  CHECK(placeLabels({}, 15, 0, 100).empty());
}

TEST_CASE("labels that collide stand around their middle, and off the ends") {
  CHECK_EQ(placeLabels({50, 50}, 10, 0, 100), std::vector<double>{45, 55});
  CHECK_EQ(placeLabels({0, 0, 0}, 10, 0, 100), std::vector<double>{0, 10, 20});
  CHECK_EQ(placeLabels({100, 99}, 10, 0, 100), std::vector<double>{100, 90});
  CHECK_EQ(placeLabels({120}, 10, 0, 100), std::vector<double>{100});
}

TEST_CASE("without room for the distance, labels are even") {
  CHECK_EQ(placeLabels({3, 3, 3, 3, 3}, 40, 0, 100), std::vector<double>{0, 25, 50, 75, 100});
}

TEST_CASE("no two labels are near, all are within, and their order is kept") {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    const auto count = static_cast<size_t>(1 + random.real() * 12);
    std::vector<double> wished(count);
    for (double& wish : wished) wish = random.real() * 200;
    const double distance = random.real() * 30;
    const std::vector<double> places = placeLabels(wished, distance, 0, 200);
    const double least = std::min(distance, count > 1 ? 200 / static_cast<double>(count - 1) : distance);
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return wished[a] < wished[b]; });
    for (size_t i = 0; i < count; ++i) {
      CHECK_GE(places[order[i]], -1e-9);
      CHECK_LE(places[order[i]], 200 + 1e-9);
      if (i > 0) CHECK_GE(places[order[i]] - places[order[i - 1]], least - 1e-9);
    }
  }
}

}  // namespace
}  // namespace asdfvk::bench
