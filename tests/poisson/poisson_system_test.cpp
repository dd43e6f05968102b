#include <doctest/doctest.h>

#include "fixtures.h"
#include "poisson/poisson_system.h"

using namespace asdfvk;

namespace {

PoissonSystem build(const HandGraph& hand, const std::vector<double>& values) {
  return distanceSystem(hand.graph, hand.geometry, values);
}

}  // namespace

TEST_CASE("rows, entries and right-hand side are those computed by hand") {
  // 0 (constraint 5) -- 1 -- 2 -- 3 (constraint 2), and an arc 1 -- 3; distances 1, 2, 4, and 6 for 1 -- 3.
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}, {1, 3}});
  const PoissonSystem system = distanceSystem(hand.graph, hand.geometry, std::vector<double>{5, kNoValue, kNoValue, 2},
                                              std::vector<double>{-27, -1.5, 0.75, -27});
  CHECK(system.faces == std::vector<uint32_t>{1, 2});
  CHECK(system.rowOffsets == std::vector<uint32_t>{0, 1, 2});
  CHECK(system.columns == UnsetVector<uint32_t>{1, 0});
  CHECK(system.entries == UnsetVector<double>{-0.5, -0.5});
  CHECK(system.diagonal[0] == doctest::Approx(1 + 0.5 + 1.0 / 6));
  CHECK(system.diagonal[1] == doctest::Approx(0.5 + 0.25));
  CHECK(system.rightHandSide[0] == doctest::Approx(5.0 + 2.0 / 6 - 3 * 0.5));
  CHECK(system.rightHandSide[1] == doctest::Approx(0.25 * 2 + 3 * 0.25));
  CHECK(system.constraintMean == doctest::Approx(3.5));
}

TEST_CASE(
    "two arcs between the same faces are one entry of twice the weight; an arc from a face to itself is ignored") {
  const HandGraph hand({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, {{0, 1}, {1, 2}, {1, 2}, {2, 2}});
  const PoissonSystem system = build(hand, {1, kNoValue, kNoValue});
  CHECK(system.columns == UnsetVector<uint32_t>{1, 0});
  CHECK(system.entries == UnsetVector<double>{-1, -1});
  CHECK(system.diagonal == UnsetVector<double>{1.5, 1});
  CHECK(system.rightHandSide == UnsetVector<double>{0.5, 0});
}

TEST_CASE("faces that no path connects to a constraint are not unknowns") {
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {6, 0, 0}, {9, 0, 0}}, {{0, 1}, {2, 3}});
  const PoissonSystem system = build(hand, {kNoValue, 4, kNoValue, kNoValue, kNoValue});
  CHECK(system.faces == std::vector<uint32_t>{0});
  CHECK(system.columns.empty());
}

TEST_CASE("without a constraint there is no unknown") {
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}}, {{0, 1}});
  const PoissonSystem system = build(hand, {kNoValue, kNoValue});
  CHECK(system.unknownCount() == 0);
  CHECK(system.rowOffsets == std::vector<uint32_t>{0});
  CHECK(system.constraintMean == 0);
  CHECK(relativeResidual(system, {}) == 0);
}

TEST_CASE("a mesh with constraints at all faces and an empty mesh have no unknown") {
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}}, {{0, 1}});
  CHECK(build(hand, {1, 2}).unknownCount() == 0);
  CHECK(build(HandGraph({}, {}), {}).unknownCount() == 0);
}

TEST_CASE("coincident barycentres keep the matrix finite: distances below 1e-9 of the diagonal are replaced") {
  const HandGraph hand({{0, 0, 0}, {0, 0, 0}, {0, 3, 4}}, {{0, 1}, {1, 2}});
  const PoissonSystem system = build(hand, {1, kNoValue, 3});
  CHECK(system.diagonal[0] == doctest::Approx(1 / (1e-9 * 5) + 1.0 / 5));
  const HandGraph point({{7, 7, 7}, {7, 7, 7}}, {{0, 1}});
  CHECK(std::isfinite(build(point, {1, kNoValue}).diagonal[0]));
}

TEST_CASE("a change of unit multiplies the entries by its factor") {
  const std::vector<Vec3d> unit{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}};
  const std::vector<double> values{1, kNoValue, kNoValue};
  const PoissonSystem reference = build(HandGraph(unit, {{0, 1}, {1, 2}}), values);
  for (double factor : {0x1p-600, 0x1p600}) {
    std::vector<Vec3d> scaled;
    for (const Vec3d& p : unit) scaled.push_back(p * factor);
    const PoissonSystem system = build(HandGraph(scaled, {{0, 1}, {1, 2}}), values);
    for (size_t i = 0; i < 2; ++i) {
      CHECK(system.entries[i] * factor == doctest::Approx(reference.entries[i]));
      CHECK(system.diagonal[i] * factor == doctest::Approx(reference.diagonal[i]));
    }
  }
}

TEST_CASE("the relative residual is the one computed by hand") {
  // The equation is 2 u = 6: one unknown between two constraints at distance 1.
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1}, {1, 2}});
  const PoissonSystem system = build(hand, {2, kNoValue, 4});
  CHECK(relativeResidual(system, std::vector<double>{3}) == 0);
  CHECK(relativeResidual(system, std::vector<double>{0}) == doctest::Approx(1));
  CHECK(relativeResidual(system, std::vector<double>{1.5}) == doctest::Approx(0.5));
}

TEST_CASE("a divergence of NaN counts as 0") {
  const HandGraph hand({{0, 0, 0}, {1, 0, 0}}, {{0, 1}});
  const PoissonSystem system =
      distanceSystem(hand.graph, hand.geometry, std::vector<double>{2, kNoValue}, std::vector<double>{0, kNoValue});
  CHECK(system.rightHandSide == UnsetVector<double>{2});
}
