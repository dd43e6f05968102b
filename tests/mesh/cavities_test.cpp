#include "mesh/cavities.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "generate/block_solid.h"
#include "support/shapes.h"

// Each case is seen along the axes and turned, so that boxes overlap where parts do not, and in float32.

using namespace asdfvk;
using shapes::inverted;
using shapes::joined;

namespace {

using Indices = std::vector<uint32_t>;
using IsFilled = std::function<bool(uint32_t, uint32_t, uint32_t)>;

struct ExpectedCavity {
  std::vector<uint8_t> isCavity;
  Indices bodyOf;
};

Mesh bodyAt(const Vec3d& size, const Vec3d& centre) { return joined(Mesh{}, shapes::box(size), centre); }

/// The surface of the filled cells between the planes.
Mesh cells(const std::vector<double>& xs, const std::vector<double>& ys, const std::vector<double>& zs,
           const IsFilled& isFilled) {
  const auto count = [](const std::vector<double>& planes) { return static_cast<uint32_t>(planes.size() - 1); };
  BlockSolid solid;
  solid.addLattice(
      {count(xs), count(ys), count(zs)},
      [&](uint32_t i, uint32_t j, uint32_t k) {
        return Vec3d{xs[i], ys[j], zs[k]};
      },
      isFilled);
  return solid.surface();
}

Mesh turned(Mesh mesh, double yaw, double pitch) {
  for (Vec3d& v : mesh.vertices) {
    const double x = v.x * std::cos(yaw) - v.y * std::sin(yaw), y = v.x * std::sin(yaw) + v.y * std::cos(yaw);
    v = {x, y * std::cos(pitch) - v.z * std::sin(pitch), y * std::sin(pitch) + v.z * std::cos(pitch)};
    v = Vec3d(Vec3f(v));
  }
  return mesh;
}

void check(const Mesh& mesh, const ExpectedCavity& expected) {
  constexpr std::array<std::array<double, 2>, 4> kRotations{{{0, 0}, {0.5, 1.1}, {2.3, -0.4}, {0.785, 0.615}}};
  for (const auto& rotation : kRotations) {
    CAPTURE(rotation[0]);
    const Mesh placed = turned(mesh, rotation[0], rotation[1]);
    const Nesting nesting = findCavities(placed, findComponents(placed, surveyEdges(placed)));
    CHECK(nesting.isCavity == expected.isCavity);
    CHECK(nesting.bodyOf == expected.bodyOf);
  }
}

/// A block of side 10 with a cavity of side 4 in its middle.
Mesh hollowBlock() { return joined(shapes::box({10, 10, 10}), inverted(shapes::box({4, 4, 4}))); }

/// A cup around the cavity of the hollow block, whose rim is outside of the block.
Mesh cup() {
  return cells({-3, -2.5, 2.5, 3}, {-3, -2.5, 2.5, 3}, {-3, -2.5, 8},
               [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
}

}  // namespace

TEST_CASE("a cavity in a cage that crosses its body is of its body") {
  check(joined(hollowBlock(), cup()), {{0, 1, 0}, {0, 0, 2}});
  check(joined(cup(), hollowBlock()), {{0, 0, 1}, {0, 1, 1}});
}

TEST_CASE("a cavity that a bar crosses is a cavity") {
  const Mesh bar = shapes::box({1, 1, 20});
  // The bar goes through two corners of the cavity.
  check(joined(hollowBlock(), turned(bar, 0.785, 0.955)), {{0, 1, 0}, {0, 0, 2}});
  check(joined(hollowBlock(), bar, {1.2, 1.3, 0}), {{0, 1, 0}, {0, 0, 2}});
}

TEST_CASE("a bar between the arms of a profile, with both ends in them, is a body") {
  const Mesh profile =
      cells({-5, -2, 2, 5}, {-2, 2}, {-5, -2, 5}, [](uint32_t i, uint32_t, uint32_t k) { return i != 1 || k == 0; });
  const Mesh bar = shapes::box({9, 1, 1});
  check(joined(profile, bar, {0, 0, 2}), {{0, 0}, {0, 1}});
  check(joined(profile, bar, {0, 0, -3.5}), {{0, 1}, {0, 0}});  // In the foot of the profile.
}

TEST_CASE("a cavity wound as a body is a cavity beside a profile in whose box it is") {
  const Mesh block = joined(shapes::box({10, 10, 10}), shapes::box({4, 4, 4}));
  // The box of the profile has the top of the cavity.
  const Mesh profile =
      cells({-9, 6, 9}, {-9, 9}, {-9, -6, 2}, [](uint32_t i, uint32_t, uint32_t k) { return i == 1 || k == 0; });
  check(joined(block, profile), {{0, 1, 0}, {0, 0, 2}});
}

TEST_CASE("a cavity where two bodies cross is of one of them") {
  const Mesh bodies = joined(shapes::box({10, 4, 4}), bodyAt({4, 4.5, 12}, {1, 0.5, 0}));
  check(joined(bodies, inverted(shapes::box({1, 1, 1})), {1, 0, 0}), {{0, 0, 1}, {0, 1, 0}});
}

TEST_CASE("a body that fills its cavity, rests in it or is pressed into it is a body") {
  const auto inCavity = [](const Vec3d& size, const Vec3d& centre) {
    return joined(hollowBlock(), bodyAt(size, centre));
  };
  const ExpectedCavity expected{{0, 1, 0}, {0, 0, 2}};
  check(inCavity({4, 4, 4}, {}), expected);
  check(joined(hollowBlock(), shapes::box({4, 4, 4}, 3)), expected);
  check(inCavity({2, 2, 1}, {0, 0, -1.5}), expected);
  check(inCavity({2, 2, 1}, {0.5, -0.5, -1.6}), expected);
  check(inCavity({4.2, 1, 1}, {0.3, 0, 0}), expected);
  check(inCavity({3, 3, 3}, {0.2, 0.1, 0}), expected);
  // With a cavity of its own.
  check(joined(inCavity({4, 4, 4}, {}), inverted(shapes::box({2, 2, 2}))), {{0, 1, 0, 1}, {0, 0, 2, 2}});
}

TEST_CASE("a cavity is of the innermost of the bodies in each other") {
  Mesh mesh = joined(hollowBlock(), shapes::box({3, 3, 3}));
  mesh = joined(std::move(mesh), inverted(shapes::box({2, 2, 2})));
  mesh = joined(std::move(mesh), shapes::box({1, 1, 1}));
  // An L around all of it, beside it.
  const Mesh profile =
      cells({-9, 6, 9}, {-9, 9}, {-9, -6, 9}, [](uint32_t i, uint32_t, uint32_t k) { return i == 1 || k == 0; });
  check(mesh, {{0, 1, 0, 1, 0}, {0, 0, 2, 2, 4}});
  check(joined(profile, mesh), {{0, 0, 1, 0, 1, 0}, {0, 1, 1, 3, 3, 5}});
}
