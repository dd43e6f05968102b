#include "bvh/sah.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"

using namespace asdfvk;

namespace {

/// Boxes of size 0.1. lowerOf(i): the lower corner of box i; its last lane must be 0.
template <typename LowerOf>
std::vector<SplitTriangle> boxes(uint32_t count, const LowerOf& lowerOf) {
  std::vector<SplitTriangle> triangles;
  for (uint32_t i = 0; i < count; ++i) {
    const Float4 lower = lowerOf(i);
    triangles.emplace_back(SplitBox{lower, -(lower + Float4{0.1f, 0.1f, 0.1f, 0})}, i);
  }
  return triangles;
}

std::vector<uint32_t> facesOf(const std::vector<SplitTriangle>& triangles) {
  std::vector<uint32_t> faces;
  for (const SplitTriangle& triangle : triangles) faces.push_back(triangle.face());
  return faces;
}

}  // namespace

TEST_CASE("two clusters are split between them, whatever the order of their triangles") {
  // More than the number of triangles in a sample. Every fifth triangle belongs to the cluster on the left.
  std::vector<SplitTriangle> triangles = boxes(5000, [](uint32_t i) {
    const float offset = 0.0001f * static_cast<float>(i);
    return i % 5 == 0 ? Float4{offset, 0, 0, 0} : Float4{10 + offset, offset, 0, 0};
  });
  const size_t leftCount = splitBySah(triangles, 16);
  REQUIRE(leftCount == 1000);
  const std::vector<uint32_t> faces = facesOf(triangles);
  CHECK(std::all_of(faces.begin(), faces.begin() + 1000, [](uint32_t face) { return face % 5 == 0; }));
  CHECK(std::none_of(faces.begin() + 1000, faces.end(), [](uint32_t face) { return face % 5 == 0; }));
}

TEST_CASE("triangles with equal centres are neither split nor reordered") {
  std::vector<SplitTriangle> triangles = boxes(40, [](uint32_t) { return Float4{1, 2, 3, 0}; });
  const std::vector<uint32_t> faces = facesOf(triangles);
  CHECK(splitBySah(triangles, 16) == 0);
  CHECK(facesOf(triangles) == faces);
}

TEST_CASE("splits are the same on every instruction set") {
  Random random(7);
  for (const uint32_t count : {2u, 9u, 64u, 1000u, 5000u})
    for (const uint32_t binCount : {2u, 16u, 32u}) {
      CAPTURE(count);
      CAPTURE(binCount);
      std::vector<SplitTriangle> plain = boxes(count, [&](uint32_t) {
        return Float4{static_cast<float>(random.real()), static_cast<float>(random.real()), 0.5f, 0};
      });
      std::vector<SplitTriangle> wide = plain;
      const size_t leftCount = splitBySah(plain, binCount, InstructionSet::Baseline);
      CHECK(leftCount > 0);
      CHECK(leftCount < count);
      CHECK(splitBySah(wide, binCount) == leftCount);
      CHECK(facesOf(wide) == facesOf(plain));
    }
}
