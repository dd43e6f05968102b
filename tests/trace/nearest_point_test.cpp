#include "trace/nearest_point.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/box3.h"
#include "core/random.h"
#include "generate/thickness_parts.h"
#include "support/shapes.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

const auto anyFace = [](uint32_t face) { return face; };

/// Distance from a triangle: that from its plane where the foot is inside by barycentric coordinates, else from its
/// edges.
double distanceFrom(const std::array<Vec3d, 3>& corners, const Vec3d& p) {
  const auto& [a, b, c] = corners;
  const Vec3d u = b - a, v = c - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  const double s = (vv * dot(w, u) - uv * dot(w, v)) / determinant, t = (uu * dot(w, v) - uv * dot(w, u)) / determinant;
  if (s >= 0 && t >= 0 && s + t <= 1) return length(w - s * u - t * v);
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d from = p - corners[k], edge = corners[(k + 1) % 3] - corners[k];
    least = std::min(least, length(from - std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0) * edge));
  }
  return least;
}

double distanceFrom(const TracedMesh& traced, uint32_t face, const Vec3d& p) {
  return distanceFrom(triangleOf(traced.scene(), face).corners, p);
}

class RandomPoints {
 public:
  Vec3d next(double limit) { return {within(limit), within(limit), within(limit)}; }

 private:
  double within(double limit) { return limit * (2 * random_.real() - 1); }
  Random random_{7};
};

}  // namespace

TEST_CASE("the nearest point is that of brute force, with all faces or some") {
  RandomPoints points;
  for (const Mesh& mesh : {shapes::soup(120, 4), shapes::jittered(shapes::icosphere(2), 0.05, 2), shapes::cube(),
                           makeThicknessPart("sharp-thread").solid.surface()}) {
    const TracedMesh traced(mesh);
    for (const uint32_t step : {1u, 3u}) {
      const auto faceOf = [&](uint32_t face) { return face % step == 0 ? face : kNoFace; };
      for (int i = 0; i < 150; ++i) {
        const Vec3d p = points.next(i % 3 == 0 ? 3 : 1);
        double expected = std::numeric_limits<double>::infinity();
        for (uint32_t face = 0; face < mesh.faces.size(); face += step)
          expected = std::min(expected, distanceFrom(traced, face, p));
        const SurfacePoint found = nearestSurfacePoint(traced.scene(), p, 0, faceOf);
        CHECK(found.distance == doctest::Approx(expected).epsilon(1e-9));
        REQUIRE(found.face % step == 0);
        CHECK(length(p - found.point) == doctest::Approx(expected).epsilon(1e-9));
        CHECK(distanceFrom(traced, found.face, found.point) < 1e-9);
        const Vec3d& normal = traced.geometry.normals[found.face];
        CHECK(found.side * found.distance == doctest::Approx(dot(p - found.point, normal)).epsilon(1e-6));
        for (const double factor : {1.0, 1.5}) {
          const SurfacePoint bounded = nearestSurfacePoint(traced.scene(), p, 0, faceOf, factor * found.distance);
          CHECK(bounded.face == found.face);
          CHECK(bounded.distance == found.distance);
          CHECK(bounded.point == found.point);
        }
      }
    }
  }
}

TEST_CASE("with a distance that is enough, any nearer point, or the nearest one") {
  const TracedMesh traced(shapes::jittered(shapes::icosphere(2), 0.05, 2));
  RandomPoints points;
  int earlyCount = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3d p = points.next(1);
    const double nearest = nearestSurfacePoint(traced.scene(), p, 0, anyFace).distance;
    const double found = nearestSurfacePoint(traced.scene(), p, 0.3, anyFace).distance;
    if (nearest >= 0.3) CHECK(found == nearest);
    if (nearest < 0.3) CHECK(found < 0.3);
    CHECK(found >= nearest - 1e-12);
    earlyCount += found > nearest + 1e-9 ? 1 : 0;
  }
  CHECK(earlyCount > 0);
}

TEST_CASE("the side is negative inside and positive outside, also beside edges and vertices") {
  // In the frame of the part: 40 x 30 x 10 with a pocket.
  const TracedMesh pocket(makeThicknessPart("pocket").solid.surface());
  const Normalization& unit = pocket.bvh.normalization;
  const auto isInside = [](const Vec3d& p) {
    const auto isBetween = [](double x, double low, double high) { return low < x && x < high; };
    return isBetween(p.x, 0, 40) && isBetween(p.y, 0, 30) && isBetween(p.z, 0, 10) &&
           !(isBetween(p.x, 10, 30) && isBetween(p.y, 8, 22) && p.z > 0.6);
  };
  RandomPoints points;
  int insideCount = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p = points.next(22) + Vec3d{20, 15, 5};
    const SurfacePoint found = nearestSurfacePoint(pocket.scene(), unit.toNormalized(p), 0, anyFace);
    CHECK((found.side < 0) == isInside(p));
    insideCount += isInside(p) ? 1 : 0;
  }
  CHECK(insideCount > 100);
  // Beside a sharp edge, points that are outside of one wall only.
  const TracedMesh knife(makeThicknessPart("knife").solid.surface());
  for (int i = 0; i < 300; ++i) {
    const Vec3d p = points.next(3) + Vec3d{0, 10, 0};
    const SurfacePoint found = nearestSurfacePoint(knife.scene(), knife.bvh.normalization.toNormalized(p), 0, anyFace);
    CHECK((found.side < 0) == (p.z > 0 && p.z < p.x / 12));
  }
}

TEST_CASE("without a face that counts there is no point") {
  const TracedMesh traced(shapes::cube());
  const SurfacePoint none = nearestSurfacePoint(traced.scene(), {}, 0, [](uint32_t) { return kNoFace; });
  CHECK(none.face == kNoFace);
  CHECK(std::isinf(none.distance));
  const TracedMesh line(Mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}});
  CHECK(nearestSurfacePoint(line.scene(), {}, 0, anyFace).face == kNoFace);
}

TEST_CASE("the distance from a box is 0 inside and that from its sides, edges and corners outside") {
  BvhNode node;
  node.min = {-1, -2, -3};
  node.max = {1, 2, 3};
  CHECK(squaredDistanceToBox(node, {0.5, -1, 2}) == 0);
  CHECK(squaredDistanceToBox(node, {1, 2, 3}) == 0);
  CHECK(squaredDistanceToBox(node, {3, 0, 0}) == 4);
  CHECK(squaredDistanceToBox(node, {-2, 0, -5}) == 5);
  CHECK(squaredDistanceToBox(node, {2, 4, 6}) == 14);
}
