#include "segment/rand_index.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/random.h"

using namespace asdfvk;

namespace {

using Labels = std::vector<uint32_t>;

Labels randomLabels(uint64_t seed, size_t count, double labelCount) {
  Random random(seed);
  Labels labels(count);
  for (uint32_t& label : labels) label = static_cast<uint32_t>(random.real() * labelCount);
  return labels;
}

}  // namespace

TEST_CASE("the Rand index is the share of pairs treated alike") {
  const Labels a = randomLabels(1, 60, 4), b = randomLabels(2, 60, 7);
  double alike = 0, all = 0;
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = i + 1; j < a.size(); ++j) {
      alike += (a[i] == a[j]) == (b[i] == b[j]) ? 1 : 0;
      all += 1;
    }
  CHECK(randIndex(a, b) == doctest::Approx(alike / all));
  CHECK(randIndex(b, a) == doctest::Approx(alike / all));
}

TEST_CASE("a weight is a number of equal items") {
  const Labels a = randomLabels(3, 40, 3), b = randomLabels(4, 40, 3);
  std::vector<float> weights(40);
  Labels manyA, manyB;
  for (size_t i = 0; i < a.size(); ++i) {
    weights[i] = static_cast<float>(i % 4);
    for (size_t copy = 0; copy < 50 * (i % 4); ++copy) {
      manyA.push_back(a[i]);
      manyB.push_back(b[i]);
    }
  }
  CHECK(randIndex(a, b, weights) == doctest::Approx(randIndex(manyA, manyB)).epsilon(1e-3));
}

TEST_CASE("equal divisions, renumbered ones, nothing, and one item have the index 1") {
  const Labels a = randomLabels(5, 30, 4);
  Labels renumbered = a;
  for (uint32_t& label : renumbered) label = 9 - label;
  CHECK(randIndex(a, a) == 1);
  CHECK(randIndex(a, renumbered) == 1);
  CHECK(randIndex(Labels{}, Labels{}) == 1);
  CHECK(randIndex(Labels{3}, Labels{5}) == 1);
  CHECK(randIndex(a, a, std::vector<float>(30, 0.0f)) == 1);
  CHECK(randIndex(Labels{0, 0}, Labels{0, 1}) == 0);
}
