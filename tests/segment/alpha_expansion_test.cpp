#include "segment/alpha_expansion.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "core/check.h"
#include "sample_problems.h"
#include "slow_expansion.h"
#include "support/require_failure.h"

using namespace asdfvk;

namespace {

using Labels = std::vector<uint32_t>;
constexpr double kForbidden = std::numeric_limits<double>::infinity();

struct OwnedProblem {
  uint32_t labelCount;
  std::vector<double> dataCosts;
  std::vector<LabelEdge> edges;

  [[nodiscard]] LabelProblem view() const { return {labelCount, dataCosts, edges}; }
};

/// Whole numbers; labels are forbidden with the probability `forbidden`, but label 0 never.
OwnedProblem randomProblem(uint32_t faceCount, uint32_t labelCount, uint32_t edgeCount, double forbidden,
                           uint64_t seed) {
  Random random(seed);
  OwnedProblem problem{labelCount, {}, {}};
  for (uint32_t face = 0; face < faceCount; ++face)
    for (uint32_t label = 0; label < labelCount; ++label)
      problem.dataCosts.push_back(label > 0 && random.real() < forbidden ? kForbidden : random.index(8));
  for (uint32_t edge = 0; edge < edgeCount; ++edge) {
    const uint32_t f = random.index(faceCount);
    problem.edges.push_back({f, (f + 1 + random.index(faceCount - 1)) % faceCount, double(random.index(5))});
  }
  return problem;
}

/// The labels after giving `label` to the best set of faces, of equal sets the one with the fewest faces.
Labels bestExpansion(const LabelProblem& problem, const Labels& labels, uint32_t label) {
  Labels best = labels;
  double least = labelEnergy(problem, labels);
  int count = 0;
  for (uint32_t set = 1; set < 1u << labels.size(); ++set) {
    Labels changed = labels;
    int changedCount = 0;
    for (uint32_t face = 0; face < labels.size(); ++face)
      if ((set >> face & 1) != 0 && labels[face] != label) {
        changed[face] = label;
        ++changedCount;
      }
    const double energy = labelEnergy(problem, changed);
    if (energy < least || (energy == least && changedCount < count)) {
      best = changed;
      least = energy;
      count = changedCount;
    }
  }
  return best;
}

Labels allowedLabels(const LabelProblem& problem, uint64_t seed) {
  Random random(seed);
  Labels labels(problem.faceCount());
  for (uint32_t face = 0; face < labels.size(); ++face) {
    labels[face] = random.index(problem.labelCount);
    if (std::isinf(problem.dataCost(face, labels[face]))) labels[face] = 0;
  }
  return labels;
}

}  // namespace

TEST_CASE("the energy is the sum of data costs and cut edges") {
  const OwnedProblem problem{2, {1, 2, 4, 8}, {{0, 1, 16}, {1, 0, 32}}};
  CHECK(labelEnergy(problem.view(), Labels{0, 0}) == 5);
  CHECK(labelEnergy(problem.view(), Labels{0, 1}) == 1 + 8 + 48);
}

TEST_CASE("one expansion is the best of all sets of faces, with the fewest changes") {
  AlphaExpansion expansion;  // Reused throughout.
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    CAPTURE(seed);
    const uint32_t faceCount = 2 + static_cast<uint32_t>(seed % 7);
    const OwnedProblem problem = randomProblem(faceCount, 3, static_cast<uint32_t>(seed % 13), 0.2 * (seed % 3), seed);
    Labels labels = allowedLabels(problem.view(), seed);
    const Labels expected = bestExpansion(problem.view(), labels, 0);
    const double energy = expansion.minimize(problem.view(), labels, {.expandedLabelCount = 1, .maxRoundCount = 1});
    REQUIRE(labels == expected);
    REQUIRE(energy == labelEnergy(problem.view(), labels));
  }
}

TEST_CASE("all labels: the labels of the slow twin with auxiliary nodes and Dinic's flow") {
  AlphaExpansion expansion;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const OwnedProblem problem = randomProblem(60, 2 + static_cast<uint32_t>(seed % 9), 100, 0.15 * (seed % 3), seed);
    Labels labels = allowedLabels(problem.view(), seed), slow = labels, first = labels;
    const double energy = expansion.minimize(problem.view(), labels);
    test::minimizeSlowly(problem.view(), slow, problem.labelCount);
    REQUIRE(labels == slow);
    REQUIRE(energy == labelEnergy(problem.view(), slow));
    REQUIRE(energy <= expansion.minimize(problem.view(), first, {.expandedLabelCount = 1}));
  }
}

TEST_CASE("a forbidden label is never given") {
  // A chain whose middle face would join its neighbours.
  const OwnedProblem problem{2, {9, 0, 0, kForbidden, 9, 0}, {{0, 1, 5}, {1, 2, 5}}};
  Labels labels{1, 0, 1};
  CHECK(AlphaExpansion().minimize(problem.view(), labels) == 10);
  CHECK(labels == Labels{1, 0, 1});
}

TEST_CASE("a forbidden label at the start fails a check") {
  const OwnedProblem problem{2, {0, kForbidden}, {}};
  Labels labels{1};
  CHECK_THROWS_AS(AlphaExpansion().minimize(problem.view(), labels), CheckFailure);
}

TEST_CASE("a face whose gain is only a rounding error keeps its label") {
  // The gain of face 0 is 0.3 - 0.6 + 0.1 + 0.2, which is above 0 by rounding. Face 3 has a real gain.
  const OwnedProblem problem{2, {0.6, 0.3, 0, 9, 0, 9, 0, 5}, {{0, 1, 0.1}, {0, 2, 0.2}}};
  REQUIRE(0.3 - 0.6 + 0.1 + 0.2 > 0);
  Labels labels{1, 0, 0, 1};
  static_cast<void>(AlphaExpansion().minimize(problem.view(), labels));
  CHECK(labels == Labels{1, 0, 0, 0});
}

TEST_CASE("only the labels below the limit are expanded, and rounds are limited") {
  const OwnedProblem problem{3, {9, 0, 5, 9, 5, 0}, {}};
  Labels labels{2, 1};
  CHECK(AlphaExpansion().minimize(problem.view(), labels, {.expandedLabelCount = 1}) == 10);
  CHECK(labels == Labels{2, 1});
  CHECK(AlphaExpansion().minimize(problem.view(), labels, {.maxRoundCount = 0}) == 10);
  CHECK(AlphaExpansion().minimize(problem.view(), labels, {.maxRoundCount = 1}) == 0);
  CHECK(labels == Labels{1, 2});
}

TEST_CASE("a list of the allowed labels gives the same as a table of all") {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const OwnedProblem problem = randomProblem(40, 6, 120, 0.7, seed);
    std::vector<uint32_t> firstChoices{0};
    std::vector<LabelProblem::Choice> choices;
    for (uint32_t face = 0; face < 40; ++face) {
      for (uint32_t label = 6; label-- > 0;)
        if (const double cost = problem.view().dataCost(face, label); std::isfinite(cost))
          choices.push_back({label, cost});
      firstChoices.push_back(static_cast<uint32_t>(choices.size()));
    }
    const LabelProblem list{6, {}, problem.edges, firstChoices, choices};
    CHECK(list.faceCount() == problem.view().faceCount());
    Labels expected(40, 0), labels(40, 0);
    const double energy = AlphaExpansion().minimize(problem.view(), expected);
    CHECK(AlphaExpansion().minimize(list, labels) == energy);
    CHECK(labels == expected);
  }
}

TEST_CASE("a requested stop ends the expansion") {
  std::stop_source source;
  source.request_stop();
  const std::vector<double> costs{0, 1, 1, 0};
  const std::vector<LabelEdge> edges{{0, 1, 1}};
  std::vector<uint32_t> labels{1, 0};
  test::requireFailure(
      [&] {
        AlphaExpansion().minimize({2, costs, edges}, labels, {}, {source.get_token(), {}});
      },
      ErrorCode::Cancelled);
}

TEST_CASE("no faces and no edges") {
  AlphaExpansion expansion;
  CHECK(expansion.minimize({3, {}, {}}, {}) == 0);
  const OwnedProblem problem{2, {3, 1}, {}};
  Labels labels{0};
  CHECK(expansion.minimize(problem.view(), labels) == 1);
  CHECK(labels == Labels{1});
}
