#include "paper/laplacian.h"

#include <doctest/doctest.h>

#include <cmath>

namespace asdfvk::bench {
namespace {

/// Three faces in a row with the barycentres (1, 1), (2, 2) and (4, 2).
Mesh strip() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {3, 3, 0}, {6, 3, 0}};
  mesh.faces = {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}};
  return mesh;
}

TEST_CASE("the Laplacian weights neighbours by 1 / distance") {
  const Mesh mesh = strip();
  const std::vector<double> laplacian = absoluteLaplacian(mesh, std::vector<double>{1, 4, 2});
  CHECK_EQ(laplacian[0], doctest::Approx(3 / std::sqrt(2)));
  CHECK_EQ(laplacian[1], doctest::Approx(3 / std::sqrt(2) + 2.0 / 2));
  CHECK_EQ(laplacian[2], doctest::Approx(2.0 / 2));
}

TEST_CASE("the Laplacian of a constant is 0, and opposite differences cancel") {
  const Mesh mesh = strip();
  for (const double value : absoluteLaplacian(mesh, std::vector<double>{5, 5, 5})) CHECK_EQ(value, 0);
  const double step = std::sqrt(2) / 2;
  CHECK_EQ(absoluteLaplacian(mesh, std::vector<double>{5 - step, 5, 6})[1], doctest::Approx(0));
}

TEST_CASE("faces without a value have no Laplacian and weight 0 for their neighbours") {
  const std::vector<double> laplacian = absoluteLaplacian(strip(), std::vector<double>{1, 4, kNoValue});
  CHECK_EQ(laplacian[1], doctest::Approx(3 / std::sqrt(2)));
  CHECK(std::isnan(laplacian[2]));
}

TEST_CASE("a percentile is the value at the nearest rank") {
  CHECK_EQ(percentileOf({0, 1, 2, 4, 100, kNoValue}, 0.75), 4);
  CHECK_EQ(percentileOf({3, 1, 2}, 0), 1);
  CHECK_EQ(percentileOf({3, 1, 2}, 1), 3);
  CHECK(std::isnan(percentileOf({kNoValue}, 0.5)));
}

}  // namespace
}  // namespace asdfvk::bench
