#include "trace/cpu/ray_walk.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "generate/shapes.h"
#include "support/shapes.h"
#include "trace/nearest_hit.h"
#include "trace_results.h"

using namespace asdfvk;

namespace {

std::vector<InstructionSet> walkInstructionSets() {
  if (widestInstructionSet() == InstructionSet::Baseline) return {InstructionSet::Baseline};
  return {InstructionSet::Baseline, widestInstructionSet()};
}

/// Rays between random points of the box; some of them are parallel to an axis or to two.
std::vector<RayGroup> randomGroups(size_t count) {
  Random random(7);
  const auto coordinate = [&] { return static_cast<float>(2 * random.real() - 1); };
  std::vector<RayGroup> groups(count);
  for (RayGroup& group : groups) {
    group.active = ~0U;
    group.begins.fill(0x1p-20F);
    group.ends.fill(std::numeric_limits<float>::max());
    group.skipped.fill(kNoFace);
    for (size_t ray = 0; ray < RayGroup::kWidth; ++ray) {
      Vec3d direction{coordinate(), coordinate(), coordinate()};
      if (ray % 8 == 1) direction.x = 0;
      if (ray % 8 == 2) direction.y = direction.z = -0.0;
      direction = direction / length(direction);
      for (size_t axis = 0; axis < 3; ++axis) {
        group.origins[axis][ray] = coordinate();
        group.directions[axis][ray] = static_cast<float>(direction[axis]);
      }
    }
  }
  return groups;
}

Vec3d vectorOf(const std::array<RayGroup::Floats, 3>& rows, size_t ray) {
  return {rows[0][ray], rows[1][ray], rows[2][ray]};
}

}  // namespace

TEST_CASE("the walk of the CPU finds the nearest hits of the reference, with the same bits on every instruction set") {
  for (const Mesh& mesh : {generateShape("animal", 3000).mesh, shapes::soup(800, 3), shapes::box({1, 2, 3}, 4)}) {
    const TracedMesh traced(mesh);
    const LaneBvh bvh = encodeLaneBvh(traced.bvh, traced.mesh);
    const std::vector<RayGroup> groups = randomGroups(300);
    std::vector<RayGroup> results[2];
    for (const InstructionSet instructionSet : walkInstructionSets()) {
      RayWalk walk(bvh, nullptr, instructionSet);
      std::vector<RayGroup>& own = results[instructionSet == InstructionSet::Baseline ? 0 : 1] = groups;
      for (RayGroup& group : own) walk.findNearest(group);
      size_t wrongCount = 0;
      for (const RayGroup& nearest : own) {
        RayGroup any = nearest;
        walk.findAny(any);
        for (size_t ray = 0; ray < RayGroup::kWidth; ++ray)
          wrongCount += (any.primitives[ray] == kNoFace) != (nearest.primitives[ray] == kNoFace) ||
                        any.distances[ray] < nearest.distances[ray];
      }
      CHECK(wrongCount == 0);
    }
    size_t differing = 0, hitCount = 0;
    for (size_t i = 0; i < groups.size(); ++i)
      for (size_t ray = 0; ray < RayGroup::kWidth; ++ray) {
        const RayGroup& group = results[0][i];
        const RayHit expected = nearestHit(traced.bvh, traced.mesh, vectorOf(group.origins, ray),
                                           vectorOf(group.directions, ray), kNoFace, double{0x1p-20F});
        const uint32_t primitive = group.primitives[ray];
        const uint32_t face = primitive == kNoFace ? kNoFace : traced.bvh.primitiveFaces[primitive];
        hitCount += face == kNoFace ? 0 : 1;
        differing +=
            face != expected.face || (face != kNoFace && std::abs(group.distances[ray] - expected.distance) > 1e-5);
        if (results[1].empty()) continue;
        CHECK(results[1][i].primitives[ray] == primitive);
        CHECK(std::bit_cast<uint32_t>(results[1][i].distances[ray]) == std::bit_cast<uint32_t>(group.distances[ray]));
      }
    CHECK(hitCount > 800);
    CHECK(differing <= 3);
  }
}

TEST_CASE("rays that are not active, skip a face, end before a face or begin behind it do not hit it") {
  const TracedMesh traced(shapes::box({2, 2, 2}));
  const LaneBvh bvh = encodeLaneBvh(traced.bvh, traced.mesh);
  RayWalk walk(bvh);
  RayGroup group = randomGroups(1).front();
  for (size_t ray = 0; ray < RayGroup::kWidth; ++ray)
    for (size_t axis = 0; axis < 3; ++axis) {
      group.origins[axis][ray] = axis == 2 ? 0.0F : 0.1F + 0.2F * static_cast<float>(axis);
      group.directions[axis][ray] = axis == 2 ? 1.0F : 0.0F;
    }
  walk.findNearest(group);
  const uint32_t top = group.primitives[0];
  const float distance = group.distances[0];
  REQUIRE(top != kNoFace);
  for (size_t first = 0; first < RayGroup::kWidth; first += 8) {
    group.active &= ~(0b10U << first);
    group.skipped[first + 2] = top;
    group.ends[first + 3] = 0.99F * distance;
    group.begins[first + 4] = 1.01F * distance;
    group.ends[first + 5] = 1.01F * distance;
  }
  for (const bool isAny : {false, true}) {
    if (isAny)
      walk.findAny(group);
    else
      walk.findNearest(group);
    for (size_t ray = 0; ray < RayGroup::kWidth; ++ray) {
      CAPTURE(ray);
      const bool isHit = ray % 8 == 0 || ray % 8 >= 5;
      CHECK(group.primitives[ray] == (isHit ? top : kNoFace));
      CHECK(group.distances[ray] == (isHit ? distance : std::numeric_limits<float>::infinity()));
    }
  }
}
