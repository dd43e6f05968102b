#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "generate/shapes.h"
#include "trace/sight_tracer.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

std::vector<uint8_t> trace(const SightTracer& tracer, const std::vector<LineSegment>& segments) {
  std::vector<uint8_t> isClear(segments.size(), 2);
  tracer.trace(segments, isClear);
  return isClear;
}

/// With ends in the box of the mesh, enlarged by a quarter.
std::vector<LineSegment> randomSegments(const TracedMesh& traced, size_t count) {
  Random random(11);
  const Vec3d centre = traced.geometry.bounds.centre(), half = traced.geometry.bounds.halfSize() * 1.25;
  const auto point = [&] {
    const auto coordinate = [&](double c, double h) { return c + h * (2 * random.real() - 1); };
    return Vec3d{coordinate(centre.x, half.x), coordinate(centre.y, half.y), coordinate(centre.z, half.z)};
  };
  std::vector<LineSegment> segments(count);
  for (LineSegment& segment : segments) {
    segment.from = point();
    segment.to = point();
  }
  return segments;
}

}  // namespace

TEST_CASE("lines of sight in and around a cube") {
  const TracedMesh cube(makeCube(12).mesh);  // Side 1, around the origin.
  const std::vector<LineSegment> segments{
      {{-0.4, 0.1, 0.2}, {0.4, 0.3, -0.1}},                            // Inside.
      {{-0.4, 0.1, 0.2}, {0.6, 0.3, -0.1}},                            // Through a side.
      {{-0.9, 0.1, 0.2}, {0.9, 0.3, -0.1}},                            // Through two.
      {{-0.9, 0.9, 0.2}, {0.9, 0.7, -0.1}},                            // Outside.
      {{-0.9, 0.1, 0.2}, {-0.51, 0.1, 0.2}},                           // Ends before a side.
      {{0.1, 0.2, 0.5}, {0.1, 0.2, -0.5}},                             // Ends on two sides.
      {{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}},                              // A point.
      {{0.1, 0.2, 0.3}, {std::nan(""), 0, 0}},                         // No segment.
      {{0.1, 0.2, 0.3}, {0.1, 0.2, 100}},      {{7, 0, 0}, {9, 0, 0}}  // Far away.
  };
  const std::vector<uint8_t> expected{1, 0, 0, 1, 1, 1, 1, 1, 0, 1};
  CHECK(trace(*makeReferenceSightTracer(cube.scene()), segments) == expected);
  CHECK(trace(*makeCpuSightTracer(cube.scene()), segments) == expected);
}

TEST_CASE("both tracers agree on a creature, in any unit, up to rays that graze") {
  for (const double scale : {1.0, 1e-5, 1e6}) {
    CAPTURE(scale);
    Mesh mesh = generateShape("hand", 3000).mesh;
    for (Vec3d& v : mesh.vertices) v = v * scale;
    const TracedMesh hand(mesh);
    const std::vector<LineSegment> segments = randomSegments(hand, 5000);
    const std::vector<uint8_t> reference = trace(*makeReferenceSightTracer(hand.scene()), segments);
    const auto clearCount = std::count(reference.begin(), reference.end(), 1);
    CHECK(clearCount > 500);
    CHECK(clearCount < 4500);
    const std::vector<uint8_t> fast = trace(*makeCpuSightTracer(hand.scene()), segments);
    size_t differentCount = 0;
    for (size_t i = 0; i < fast.size(); ++i) differentCount += fast[i] != reference[i] ? 1 : 0;
    CHECK(differentCount <= 2);
  }
}

TEST_CASE("lines of sight do not depend on the direction and the number of threads") {
  const TracedMesh animal(generateShape("animal", 2000).mesh);
  std::vector<LineSegment> segments = randomSegments(animal, 2000);
  const auto tracer = makeReferenceSightTracer(animal.scene());
  const std::vector<uint8_t> expected = trace(*tracer, segments);
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(trace(*tracer, segments) == expected);
  }
  for (LineSegment& segment : segments) std::swap(segment.from, segment.to);
  CHECK(trace(*tracer, segments) == expected);
}

TEST_CASE("without triangles every line of sight is clear") {
  const TracedMesh none(Mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}});
  const std::vector<LineSegment> segments{{{0, 0, 0}, {1, 1, 1}}};
  CHECK(trace(*makeReferenceSightTracer(none.scene()), segments) == std::vector<uint8_t>{1});
  CHECK(trace(*makeCpuSightTracer(none.scene()), segments) == std::vector<uint8_t>{1});
}
