#include <doctest/doctest.h>

#include <cmath>

#include "core/random.h"
#include "support/shapes.h"
#include "trace/nearest_hit.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

// Rays aimed exactly at vertices and at points of edges, where a careless test falls between two triangles.
class LeakHunt {
 public:
  explicit LeakHunt(const Mesh& mesh) : traced_(mesh) {}

  void shootFrom(const Vec3d& origin) {
    for (const Face& face : traced_.mesh.faces) {
      for (size_t k = 0; k < 3; ++k) {
        const Vec3d &a = traced_.mesh.vertices[face[k]], &b = traced_.mesh.vertices[face[(k + 1) % 3]];
        shoot(origin, a);
        for (const double s : {0.5, 0.25, 1.0 / 3, 1e-9}) shoot(origin, a + (b - a) * s);
      }
    }
  }

  // Axis-parallel rays run along edges and along the sides of boxes where the mesh is a grid.
  void shootAlongAxes(const Vec3d& origin) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Vec3d direction;
        for (size_t k = 0; k < 3; ++k) direction[k] = k == axis ? sign : std::copysign(0.0, sign);
        count(origin, direction);
      }
    }
  }

  size_t rayCount = 0, leakCount = 0;

 private:
  void shoot(const Vec3d& origin, const Vec3d& target) { count(origin, (target - origin) / length(target - origin)); }

  void count(const Vec3d& origin, const Vec3d& direction) {
    ++rayCount;
    const Vec3d start = traced_.bvh.normalization.toNormalized(origin);
    if (nearestHit(traced_.bvh, traced_.mesh, start, direction, kNoFace).face == kNoFace) ++leakCount;
  }

  TracedMesh traced_;
};

}  // namespace

TEST_CASE("no ray from inside leaks through a vertex or an edge of a closed mesh") {
  Random random(23);
  for (const Mesh& mesh :
       {shapes::icosphere(3), shapes::jittered(shapes::icosphere(3), 0.02, 1), shapes::box({2, 2, 2}, 8),
        shapes::scaledAndShifted(shapes::box({2, 2, 2}, 7), 0.1, {}), shapes::cylinder(1, 2, 40, 10)}) {
    LeakHunt hunt(mesh);
    for (int i = 0; i < 6; ++i)
      hunt.shootFrom({0.6 * (random.real() - 0.5) * 0.1, 0.6 * (random.real() - 0.5) * 0.1, 0.05 * random.real()});
    hunt.shootFrom({0, 0, 0});
    CHECK(hunt.rayCount > 10000);
    CHECK(hunt.leakCount == 0);
  }
}

TEST_CASE("no axis-parallel ray leaks out of a grid, along the edges and box sides of which it runs") {
  for (const double scale : {1.0, 0.1, 1.0 / 3}) {
    LeakHunt hunt(shapes::scaledAndShifted(shapes::box({2, 2, 2}, 8), scale, {}));
    for (int x = -3; x <= 3; ++x)
      for (int y = -3; y <= 3; ++y)
        for (int z = -3; z <= 3; ++z) hunt.shootAlongAxes(Vec3d{0.25 * x, 0.25 * y, 0.25 * z} * scale);
    CHECK(hunt.rayCount == 7 * 7 * 7 * 6);
    CHECK(hunt.leakCount == 0);
  }
}

TEST_CASE("a miss has no face and no distance") {
  const TracedMesh traced(shapes::icosphere(2));
  for (const Vec3d& direction : {Vec3d{1, 0, 0}, Vec3d{0, 0.6, 0.8}}) {
    const RayHit outwards = nearestHit(traced.bvh, traced.mesh, direction * 1.0001, direction, kNoFace);
    CHECK(outwards.face == kNoFace);
    CHECK(outwards.distance == kNoHit);
  }
}

TEST_CASE("a hit is reported where the target is") {
  const TracedMesh traced(shapes::icosphere(3));
  const Vec3d origin = {0.1, -0.2, 0.05};
  for (const Vec3d& vertex : traced.mesh.vertices) {
    const double distance = length(vertex - origin);
    const RayHit hit = nearestHit(traced.bvh, traced.mesh, traced.bvh.normalization.toNormalized(origin),
                                  (vertex - origin) / distance, kNoFace);
    CHECK(traced.bvh.normalization.toMeshLength(hit.distance) == doctest::Approx(distance).epsilon(1e-12));
  }
}

TEST_CASE("among equally near faces the lowest wins, whatever the order of the faces") {
  // All the faces round a vertex are hit at the same place; rotating the list changes the tree but not the rule.
  Mesh mesh = shapes::box({2, 2, 2}, 4);
  for (int turn = 0; turn < 5; ++turn) {
    const TracedMesh traced(mesh);
    const RayHit hit = nearestHit(traced.bvh, traced.mesh, {0, 0, 0}, {0, 0, 1}, kNoFace);
    REQUIRE(hit.face != kNoFace);
    uint32_t lowest = kNoFace;
    for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
      bool touches = false;
      for (const uint32_t v : mesh.faces[f]) touches |= mesh.vertices[v] == Vec3d{0, 0, 1};
      if (touches) lowest = std::min(lowest, f);
    }
    CHECK(hit.face == lowest);
    std::rotate(mesh.faces.begin(), mesh.faces.begin() + 37, mesh.faces.end());
  }
}
