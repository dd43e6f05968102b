#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "poisson/poisson_system.h"
#include "sample_problems.h"

using namespace asdfvk;

namespace {

/// Three faces in a row at distances 2 and 5. The second and third are turned by `degrees` about y and lie `rise`
/// higher.
HandGraph roof(double degrees, double rise) {
  HandGraph hand({{0, 0, 0}, {2, 0, rise}, {2, 5, rise}}, {{0, 1}, {1, 2}});
  const double angle = degrees * std::numbers::pi / 180;
  hand.geometry.normals[1] = hand.geometry.normals[2] = {-std::sin(angle), 0, std::cos(angle)};
  return hand;
}

}  // namespace

TEST_CASE("Distance weights are 1 / distance, as in the paper") {
  const HandGraph hand = roof(30, 0);
  CHECK(distanceWeights(hand.graph, hand.geometry) == UnsetVector<double>{0.5, 0.5, 0.2, 0.2});
}

TEST_CASE("Feature weights are 1/2 at 3 degrees on a concave and at 8 on a convex edge, and 1 on a flat one") {
  struct Expected {
    double degrees, rise, weight;
  };
  for (const auto& [angle, rise, weight] : {Expected{3, 0.01, 0.5},
                                            {6, 0.01, 0.2},
                                            {90, 3, 1.0 / 901},
                                            {-8, -0.01, 0.5},
                                            {-16, -0.01, 0.2},
                                            {-80, -3, 1.0 / 101},
                                            {0, 0, 1}}) {
    const double degrees = angle;
    CAPTURE(degrees);
    const HandGraph hand = roof(degrees, rise);
    const UnsetVector<double> weights = featureWeights(arcAngles(hand.graph, hand.geometry));
    CHECK(weights[0] == doctest::Approx(weight));
    CHECK(weights[1] == weights[0]);
    CHECK(weights[2] == 1);
  }
}

TEST_CASE("an edge of a degenerate face has the Feature weight of a flat one") {
  HandGraph hand = roof(90, 3);
  hand.geometry.areas[1] = 0;
  hand.geometry.normals[1] = {};
  CHECK(featureWeights(arcAngles(hand.graph, hand.geometry)) == UnsetVector<double>{1, 1, 1, 1});
}

TEST_CASE("weights are positive, finite and have the same bits in both directions, for any mesh and unit") {
  for (SampleProblem& problem : sampleProblems())
    for (ArcWeights kind : kArcWeights)
      for (double unit : {1.0, 0x1p-1000, 0x1p1000}) {
        CAPTURE(problem.name);
        CAPTURE(unit);
        FaceGeometry geometry = problem.geometry;
        for (Vec3d& p : geometry.barycentres) p = p * unit;
        geometry.bounds = {};
        for (const Vec3d& p : geometry.barycentres) geometry.bounds.add(p);
        const DualGraph& graph = problem.graph;
        const UnsetVector<double> weights = weightsOf(kind, graph, geometry);
        REQUIRE(weights.size() == graph.neighbours.size());
        for (uint32_t f = 0; f < graph.faceCount(); ++f)
          for (uint32_t arc = graph.offsets[f]; arc < graph.offsets[f + 1]; ++arc) {
            const uint32_t g = graph.neighbours[arc];
            const auto back = std::lower_bound(graph.neighbours.begin() + graph.offsets[g],
                                               graph.neighbours.begin() + graph.offsets[g + 1], f);
            REQUIRE(weights[arc] > 0);
            REQUIRE(std::isfinite(weights[arc]));
            REQUIRE(weights[arc] == weights[static_cast<size_t>(back - graph.neighbours.begin())]);
          }
      }
}

TEST_CASE("the weight of a distance that overflows is positive") {
  const HandGraph hand({{-1.7e308, 0, 0}, {1.7e308, 0, 0}}, {{0, 1}});
  CHECK(distanceWeights(hand.graph, hand.geometry)[0] > 0);
}

TEST_CASE("the divergence is the sum computed by hand, over the neighbours with a value") {
  const HandGraph hand({{0, 0, 0}, {2, 0, 0}, {2, 5, 0}, {2, 0, 4}}, {{0, 1}, {1, 2}, {1, 3}});
  const UnsetVector<double> weights = distanceWeights(hand.graph, hand.geometry);
  CHECK(divergenceOf(hand.graph, weights, std::vector<double>{1, 3, 8, 7}) ==
        std::vector<double>{-1, 0.5 * 2 + 0.2 * -5 + 0.25 * -4, 1, 1});
  CHECK(divergenceOf(hand.graph, weights, std::vector<double>{1, 3, kNoValue, 7}) == std::vector<double>{-1, 0, 0, 1});
  CHECK(divergenceOf(hand.graph, weights, std::vector<double>{1, kNoValue, 2, 7}) == std::vector<double>{0, 0, 0, 0});
}
