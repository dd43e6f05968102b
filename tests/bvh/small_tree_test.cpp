#include "bvh/small_tree.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/random.h"

using namespace asdfvk;

namespace {

/// Unit squares at random places, or on a lattice, where many boxes are equally near.
std::vector<SplitTriangle> randomTriangles(size_t count, bool onLattice, Random& random) {
  const auto coordinate = [&] { return static_cast<float>(onLattice ? random.index(3) : random.real()); };
  std::vector<SplitTriangle> triangles;
  for (uint32_t i = 0; i < count; ++i) {
    const float x = coordinate(), y = coordinate(), z = coordinate();
    triangles.emplace_back(SplitBox{{x, y, z, 0}, {-x - 1, -y - 1, -z, 0}}, i);
  }
  return triangles;
}

}  // namespace

TEST_CASE("small trees end, hold every triangle, and are the same on every instruction set") {
  Random random(4);
  for (uint32_t count = 1; count <= kMaxSmallTreeCount; ++count)
    for (int round = 0; round < 300; ++round) {
      CAPTURE(count);
      CAPTURE(round);
      const std::vector<SplitTriangle> triangles = randomTriangles(count, round % 3 == 0, random);
      const SmallTree plain(triangles, 3, InstructionSet::Baseline), wide(triangles, 3);
      REQUIRE(plain.root() == 2 * count - 2);
      REQUIRE(wide.root() == plain.root());
      CHECK(plain[plain.root()].triangleCount == count);
      for (uint32_t node = count; node <= plain.root(); ++node) {
        CHECK(plain[node].left == wide[node].left);
        CHECK(plain[node].right == wide[node].right);
        CHECK(plain[node].isLeaf == wide[node].isLeaf);
      }
    }
}
