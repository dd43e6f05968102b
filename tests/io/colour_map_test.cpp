#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "io/colour_map.h"
#include "mesh/mesh.h"

using namespace asdfvk;

TEST_CASE("the colour range is the 1st to the 99th percentile of the finite values") {
  std::vector<double> values;
  for (int i = 1000; i >= 0; --i) values.push_back(i);
  values.push_back(kNoValue);
  values.push_back(std::numeric_limits<double>::infinity());
  const ColourRange range = percentileRange(values);
  CHECK(range.low == 10);
  CHECK(range.high == 990);
}

TEST_CASE("one outlier does not flatten the colours of the others") {
  std::vector<double> values{1e9};
  for (int i = 0; i < 200; ++i) values.push_back(i);
  const ColourRange range = percentileRange(values);
  CHECK(range.high < 200);
  CHECK(colourOf(0, range) != colourOf(100, range));
  CHECK(colourOf(1e9, range) == colourOf(range.high, range));
}

TEST_CASE("colours run from viridis' dark violet to its yellow, growing lighter all the way") {
  const ColourRange range{0, 1};
  CHECK(colourOf(-5, range) == Rgba{68, 1, 84, 255});
  CHECK(colourOf(0.5, range) == Rgba{33, 145, 140, 255});
  CHECK(colourOf(7, range) == Rgba{253, 231, 37, 255});
  double lightness = -1;
  for (int i = 0; i <= 100; ++i) {
    const Rgba colour = colourOf(i / 100.0, range);
    const double next = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
    CHECK(next > lightness);
    lightness = next;
  }
}

TEST_CASE("no value is grey, equal values have the middle colour, no finite value is no range") {
  CHECK(colourOf(kNoValue, {0, 1}) == Rgba{128, 128, 128, 255});
  const std::vector<double> equal(10, 3.5);
  CHECK(colourOf(3.5, percentileRange(equal)) == Rgba{33, 145, 140, 255});
  const std::vector<double> none(10, kNoValue);
  CHECK(percentileRange(none).low == 0);
  CHECK(percentileRange(none).high == 0);
  CHECK(percentileRange({}).high == 0);
}
