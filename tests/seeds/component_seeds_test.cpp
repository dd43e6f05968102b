#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "seeds/component_seeds.h"

using namespace asdfvk;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<uint32_t> allFaces(size_t count) {
  std::vector<uint32_t> faces(count);
  std::iota(faces.begin(), faces.end(), 0u);
  return faces;
}

}  // namespace

TEST_CASE("a component in which a seed has a value gets no further seeds") {
  const std::vector<uint32_t> componentOf{0, 0, 0};
  const std::vector<double> values{kNone, 2.0, kNone};
  const std::vector<uint32_t> untried{0, 2};
  CHECK(ComponentSeeds(componentOf, values, untried, 1).next(values).empty());
}

TEST_CASE("an empty mesh gets no further seeds") { CHECK(ComponentSeeds({}, {}, {}, 1).next({}).empty()); }

TEST_CASE("the first batch has one face of each component without a value") {
  const std::vector<uint32_t> componentOf{0, 1, 0, 2, 1, 2, 2};
  std::vector<double> values(7, kNone);
  values[0] = 1.5;
  ComponentSeeds further(componentOf, values, std::vector<uint32_t>{1, 2, 3, 4, 5, 6}, 1);
  const auto batch = further.next(values);
  REQUIRE(batch.size() == 2);
  std::set<uint32_t> components{componentOf[batch[0]], componentOf[batch[1]]};
  CHECK(components == std::set<uint32_t>{1, 2});
}

TEST_CASE("a component gets no further seeds once one of its faces has a value") {
  std::vector<uint32_t> componentOf(20, 0);
  std::fill(componentOf.begin() + 10, componentOf.end(), 1);
  std::vector<double> values(20, kNone);
  ComponentSeeds further(componentOf, values, allFaces(20), 4);
  for (uint32_t face : further.next(values))
    if (componentOf[face] == 0) values[face] = 1;
  const auto second = further.next(values);
  CHECK(second.size() == 2);
  for (uint32_t face : second) {
    CHECK(componentOf[face] == 1);
    values[face] = 1;
  }
  CHECK(further.next(values).empty());
}

TEST_CASE("a component of 100,000 faces without any value takes 17 batches, and each face is tried once") {
  const size_t faceCount = 100'000;
  const std::vector<uint32_t> componentOf(faceCount, 0);
  const std::vector<double> values(faceCount, kNone);
  ComponentSeeds further(componentOf, values, allFaces(faceCount), 9);
  std::vector<uint32_t> tried;
  int rounds = 0;
  for (auto batch = further.next(values); !batch.empty(); batch = further.next(values)) {
    if (rounds < 16) CHECK(batch.size() == size_t{1} << rounds);
    CHECK(std::is_sorted(batch.begin(), batch.end()));
    tried.insert(tried.end(), batch.begin(), batch.end());
    ++rounds;
  }
  CHECK(rounds == 17);
  std::sort(tried.begin(), tried.end());
  CHECK(tried == allFaces(faceCount));
}

TEST_CASE("only untried faces that can cast rays are returned") {
  const std::vector<uint32_t> componentOf(6, 0);
  const std::vector<double> values(6, kNone);
  ComponentSeeds further(componentOf, values, std::vector<uint32_t>{1, 4}, 2);
  std::vector<uint32_t> tried;
  for (auto batch = further.next(values); !batch.empty(); batch = further.next(values))
    tried.insert(tried.end(), batch.begin(), batch.end());
  std::sort(tried.begin(), tried.end());
  CHECK(tried == std::vector<uint32_t>{1, 4});
}

TEST_CASE("the first face depends on the random seed and is reproducible") {
  const std::vector<uint32_t> componentOf(1000, 0);
  const std::vector<double> values(1000, kNone);
  std::set<uint32_t> firsts;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto first = ComponentSeeds(componentOf, values, allFaces(1000), seed).next(values);
    CHECK(first == ComponentSeeds(componentOf, values, allFaces(1000), seed).next(values));
    firsts.insert(first.at(0));
  }
  CHECK(firsts.size() > 15);
}
