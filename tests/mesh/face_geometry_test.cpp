#include "mesh/face_geometry.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include "core/random.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

Mesh triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return {{a, b, c}, {{0, 1, 2}}, {}}; }

double distance(const Vec3d& a, const Vec3d& b) { return length(a - b); }

Box3d box(const Vec3d& min, const Vec3d& max) {
  Box3d result;
  result.add(min);
  result.add(max);
  return result;
}

}  // namespace

TEST_CASE("an empty mesh has no geometry and an empty box") {
  const FaceGeometry geometry = computeFaceGeometry({});
  CHECK(geometry.areas.empty());
  CHECK(geometry.bounds.isEmpty());
}

TEST_CASE("normal, area and barycentre hold at any scale") {
  for (const double scale : {1e-150, 1e-30, 1.0, 1e3, 1e30, 1e150}) {
    CAPTURE(scale);
    const FaceGeometry geometry = computeFaceGeometry(triangle({0, 0, 0}, {3 * scale, 0, 0}, {0, 6 * scale, 0}));
    CHECK(distance(geometry.normals[0], {0, 0, 1}) < 1e-15);
    CHECK(geometry.areas[0] / scale / scale == doctest::Approx(9).epsilon(1e-12));
    CHECK(distance(geometry.barycentres[0] / scale, {1, 2, 0}) < 1e-14);
    CHECK(geometry.bounds.max.y == 6 * scale);
  }
}

TEST_CASE("an area beyond the range of a double is neither degenerate nor infinite") {
  for (const double scale : {1e-200, 1e-300, 1e200, 1e300}) {
    CAPTURE(scale);
    const FaceGeometry geometry = computeFaceGeometry(triangle({0, 0, 0}, {scale, 0, 0}, {0, scale, 0}));
    CHECK_FALSE(geometry.isDegenerate(0));
    CHECK(std::isfinite(geometry.areas[0]));
    CHECK(distance(geometry.normals[0], {0, 0, 1}) < 1e-15);
  }
}

TEST_CASE("the faces of a cube are oriented outwards and cover it") {
  const FaceGeometry geometry = computeFaceGeometry(shapes::cube());
  double area = 0;
  for (size_t f = 0; f < 12; ++f) {
    CHECK(dot(geometry.normals[f], geometry.barycentres[f]) == doctest::Approx(1));
    area += geometry.areas[f];
  }
  CHECK(area == doctest::Approx(24));
}

TEST_CASE("a shift far from the origin leaves normals and areas") {
  const Vec3d shift{1e9, -2e9, 3e9};  // Exact for the cube's corners.
  const FaceGeometry near = computeFaceGeometry(shapes::cube());
  const FaceGeometry far = computeFaceGeometry(shapes::scaledAndShifted(shapes::cube(), 1, shift));
  CHECK(far.normals == near.normals);
  CHECK(far.areas == near.areas);
  for (size_t f = 0; f < 12; ++f) CHECK(distance(far.barycentres[f] - shift, near.barycentres[f]) < 1e-6);
}

TEST_CASE("a sliver has a normal down to the height ratio and none below it, in any direction") {
  const Vec3d along{0.48, 0.6, 0.64}, across{0.8, 0, -0.6};  // Orthonormal.
  // Below 5e-60 and above 9e60, edges are divided by a power of two.
  for (const double length : {1e-100, 3e-60, 5e-60, 1.0, 9e60, 2e61, 1e100}) {
    const auto sliver = [&](double heightRatio) {
      return computeFaceGeometry(
          triangle({}, along * length, along * (0.5 * length) + across * (heightRatio * length)));
    };
    const FaceGeometry thin = sliver(2e-10);
    CHECK_FALSE(thin.isDegenerate(0));
    CHECK(distance(thin.normals[0], cross(along, across)) < 1e-5);
    CHECK(thin.areas[0] / length / length == doctest::Approx(1e-10).epsilon(1e-5));
    const FaceGeometry tooThin = sliver(5e-11);
    CHECK(tooThin.isDegenerate(0));
    CHECK(tooThin.normals[0] == Vec3d{});
  }
}

TEST_CASE("faces without area are degenerate") {
  CHECK(computeFaceGeometry(triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3})).isDegenerate(0));
  CHECK(computeFaceGeometry(triangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3})).isDegenerate(0));
  CHECK(computeFaceGeometry(triangle({0, 0, 0}, {0, 0, 0}, {3, 3, 3})).isDegenerate(0));
  const FaceGeometry repeated = computeFaceGeometry(Mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}, {}});
  CHECK(repeated.isDegenerate(0));
  CHECK(distance(repeated.barycentres[0], {2.0 / 3, 0, 0}) < 1e-15);
}

TEST_CASE("faces with a non-finite corner are degenerate and stay out of the box") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    const FaceGeometry geometry = computeFaceGeometry(triangle({0, 0, 0}, {1, bad, 0}, {0, 1, 0}));
    CHECK(geometry.isDegenerate(0));
    CHECK(geometry.normals[0] == Vec3d{});
    CHECK_FALSE(isFinite(geometry.barycentres[0]));
    CHECK(geometry.bounds.max == Vec3d{0, 1, 0});
  }
}

TEST_CASE("the box holds only vertices that faces use") {
  Mesh mesh = shapes::cube();
  mesh.vertices.push_back({100, 0, 0});
  CHECK(computeFaceGeometry(mesh).bounds.max == Vec3d{1, 1, 1});
}

TEST_CASE("coordinates at the ends of a double's range overflow nothing") {
  const double edge = 1.7e308;
  const FaceGeometry geometry = computeFaceGeometry(triangle({-edge, -edge, 0}, {edge, -edge, 0}, {edge, edge, 0}));
  CHECK(geometry.normals[0] == Vec3d{0, 0, 1});
  CHECK(geometry.areas[0] == std::numeric_limits<double>::max());
  CHECK(geometry.barycentres[0].x == doctest::Approx(edge / 3));
  CHECK(geometry.barycentres[0].y == doctest::Approx(-edge / 3));
}

TEST_CASE("the geometry of a face depends neither on the faces beside it nor on the instruction set") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Random random(5);
  const auto coordinate = [&](double scale) { return scale * (random.real() - 0.5); };
  // Most scales are ordinary, so that most groups of faces have one special face at most.
  std::vector<double> scales(60, 1);
  for (const double scale :
       {1e-310, 1e-70, 0x1p-204, 0x1p-200, 0x1p-196, 1e-12, 0x1p197, 0x1p201, 1e70, 1e300, kInfinity})
    scales.push_back(scale);
  Mesh mesh;
  for (uint32_t face = 0; face < 5003; ++face) {
    const double scale = scales[random.next() % scales.size()], other = random.next() % 5 == 0 ? 1 : scale;
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back({coordinate(scale), coordinate(other), coordinate(scale)});
    if (random.next() % 50 == 0) mesh.vertices.back().y = random.next() % 2 == 0 ? kNoValue : kInfinity;
    mesh.faces.push_back({3 * face, 3 * face + 1, 3 * face + (random.next() % 9 == 0 ? 1 : 2)});
  }
  const FaceGeometry geometry = computeFaceGeometry(mesh),
                     baseline = computeFaceGeometry(mesh, InstructionSet::Baseline);
  const auto bits = [](const Vec3d& v) { return std::bit_cast<std::array<uint64_t, 3>>(v); };
  Box3d bounds;
  size_t smallCount = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const auto [i, j, k] = mesh.faces[face];
    const FaceGeometry own = computeFaceGeometry(triangle(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]));
    CAPTURE(face);
    for (const FaceGeometry* whole : {&geometry, &baseline}) {
      CHECK(bits(whole->normals[face]) == bits(own.normals[0]));
      CHECK(whole->areas[face] == own.areas[0]);
      if (isFinite(own.barycentres[0])) CHECK(bits(whole->barycentres[face]) == bits(own.barycentres[0]));
    }
    smallCount += own.areas[0] > 0 && own.areas[0] < 1e-100 ? 1 : 0;
    bounds.add(own.bounds);
  }
  CHECK(smallCount > 100);
  for (const FaceGeometry* whole : {&geometry, &baseline}) {
    CHECK(whole->bounds.min == bounds.min);
    CHECK(whole->bounds.max == bounds.max);
  }
}

TEST_CASE("normalisation brings the largest half extent to 1") {
  for (const double scale : {1e-300, 1e-150, 1e-30, 0.7, 1.0, 3.0, 1e3, 1e30, 1e300}) {
    CAPTURE(scale);
    const Normalization normalization = normalizationOf(box({-scale, 0, 0}, {3 * scale, scale, -scale}));
    const Vec3d low = normalization.toNormalized({-scale, 0, 0}), high = normalization.toNormalized({3 * scale, 0, 0});
    CHECK(high.x == doctest::Approx(1).epsilon(1e-15));
    CHECK(low.x == doctest::Approx(-high.x));
    CHECK(normalization.toMeshLength(high.x - low.x) == doctest::Approx(4 * scale));
  }
}

TEST_CASE("a shift that the numbers resolve does not change normalised coordinates") {
  const Normalization near = normalizationOf(box({-1, -1, -1}, {1, 1, 1}));
  const Normalization far = normalizationOf(box({1e9 - 1, -1, -1}, {1e9 + 1, 1, 1}));
  CHECK(far.scale == near.scale);
  CHECK(far.toNormalized({1e9 + 0.5, 0.25, 0}) == near.toNormalized({0.5, 0.25, 0}));
}

TEST_CASE("a point, an empty box and subnormal extents have a usable scale") {
  CHECK(normalizationOf(box({5, 5, 5}, {5, 5, 5})).scale == 1);
  CHECK(normalizationOf(box({5, 5, 5}, {5, 5, 5})).toNormalized({5, 5, 5}) == Vec3d{});
  CHECK(normalizationOf(Box3d{}).scale == 1);
  const double tiny = std::numeric_limits<double>::denorm_min();
  CHECK(std::isfinite(normalizationOf(box({0, 0, 0}, {tiny * 8, 0, 0})).scale));
}

TEST_CASE("a box as wide as a double's range maps into [-1, 1] and its lengths stay finite") {
  const double edge = 1.7e308;
  const Normalization normalization = normalizationOf(box({-edge, -edge, 0}, {edge, edge, 1}));
  for (const double sign : {-1.0, 1.0}) {
    const Vec3d corner = normalization.toNormalized({sign * edge, -sign * edge, 0});
    CHECK(std::abs(corner.x) == doctest::Approx(1).epsilon(1e-15));
    CHECK(corner.y == -corner.x);
  }
  CHECK(normalization.toMeshLength(0.25) == doctest::Approx(0.25 / normalization.scale));
  CHECK(normalization.toMeshLength(2) == std::numeric_limits<double>::max());
  CHECK(std::isnan(normalization.toMeshLength(std::numeric_limits<double>::quiet_NaN())));
}
