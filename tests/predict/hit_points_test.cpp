#include "predict/hit_points.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "generate/shapes.h"
#include "predict/seeded_mesh.h"
#include "shared/cone_rules.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

/// A torus without its upper half: rays escape.
Mesh openTorus() {
  Mesh mesh = makeTorus(1200).mesh;
  std::erase_if(mesh.faces, [&](const Face& face) { return mesh.vertices[face[0]].z > 0.1; });
  return mesh;
}

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t count = values.size();
  return count % 2 == 1 ? values[count / 2] : 0.5 * (values[count / 2 - 1] + values[count / 2]);
}

/// The valid lengths that the outlier rule keeps, from its definition in cone.h.
std::vector<bool> inliersOf(const std::vector<double>& lengths, const OutlierRule& rule) {
  if (lengths.empty()) return {};
  const auto count = static_cast<double>(lengths.size());
  const double median = medianOf(lengths), mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / count;
  double squares = 0;
  std::vector<double> deviations;
  for (const double length : lengths) {
    squares += (length - mean) * (length - mean);
    deviations.push_back(std::abs(length - median));
  }
  const bool isStandard = rule.spread == OutlierRule::Spread::StandardDeviation;
  const double bound =
      rule.deviations * (isStandard ? std::sqrt(squares / count) : medianOf(deviations)) + rule.slack * median;
  std::vector<bool> kept;
  for (const double length : lengths) kept.push_back(std::abs(length - median) <= bound);
  return kept;
}

void checkPoints(const SeededMesh& seeded) {
  const TraceScene scene = seeded.scene();
  HitPoints points(scene, seeded.cone, seeded.seedHits()),
      baseline(scene, seeded.cone, seeded.seedHits(), InstructionSet::Baseline);
  const size_t rayCount = seeded.cone.directions.size();
  for (uint32_t seed = 0; seed < seeded.seeds.size(); ++seed) {
    const HitRange range = points.append(seed);
    CHECK(baseline.append(seed).medianLength == range.medianLength);
    CHECK(range.groupCount == (rayCount + kPointGroupSize - 1) / kPointGroupSize);
    REQUIRE(points.groups().size() == range.firstGroup + range.groupCount);
    const Vec3d& seedNormal = seeded.geometry.normals[seeded.seeds[seed]];
    std::vector<double> lengths;
    std::vector<float> isInlier;
    for (size_t ray = 0; ray < range.groupCount * kPointGroupSize; ++ray) {
      const PointGroup& group = points.groups()[range.firstGroup + ray / kPointGroupSize];
      const size_t at = ray % kPointGroupSize;
      if (ray >= rayCount || seeded.hits[seed * rayCount + ray].face == kNoFace) {
        CHECK(std::isnan(group.x[at]));
        CHECK(std::isnan(group.y[at]));
        CHECK(std::isnan(group.z[at]));
        CHECK(group.isInlier[at] == 0);
        CHECK(group.solidAngleRatio[at] == 0);
        CHECK(group.face[at] == kNoFace);
        continue;
      }
      const ConeHit& hit = seeded.hits[seed * rayCount + ray];
      REQUIRE(group.face[at] == hit.face);
      const Vec3d point{group.x[at], group.y[at], group.z[at]};
      const Vec3d normal{group.nx[at], group.ny[at], group.nz[at]};
      const Vec3d corner = seeded.bvh.normalization.toNormalized(seeded.mesh.vertices[seeded.mesh.faces[hit.face][0]]);
      CHECK(length(normal - seeded.geometry.normals[hit.face]) < 1e-6);
      CHECK(std::abs(dot(point - corner, seeded.geometry.normals[hit.face])) < 2e-6);
      const Vec3d offset =
          point - seeded.bvh.normalization.toNormalized(seeded.geometry.barycentres[seeded.seeds[seed]]);
      CHECK(length(offset) == doctest::Approx(hit.distance).epsilon(1e-5));
      CHECK(group.solidAngleRatio[at] ==
            doctest::Approx(seeded.cone.solidAngles[ray] * dot(offset, offset)).epsilon(1e-4));
      if (isFalseHit(seeded.cone, seedNormal, offset, seeded.geometry.normals[hit.face])) {
        CHECK(group.isInlier[at] == 0);
      } else {
        isInlier.push_back(group.isInlier[at]);
        lengths.push_back(static_cast<double>(hit.distance));
      }
    }
    const std::vector<bool> expected = inliersOf(lengths, seeded.cone.outliers);
    for (size_t i = 0; i < expected.size(); ++i) CHECK(isInlier[i] == (expected[i] ? 1.0f : 0.0f));
    if (lengths.empty()) CHECK(range.medianLength == 0);
    std::sort(lengths.begin(), lengths.end());
    if (lengths.size() % 2 == 1) CHECK(range.medianLength == static_cast<float>(lengths[lengths.size() / 2]));
  }
  CHECK(std::ranges::equal(std::as_bytes(points.groups()), std::as_bytes(baseline.groups())));
}

}  // namespace

TEST_CASE("points are on the faces hit at the length of their rays; misses and padding are NaN") {
  checkPoints(SeededMesh(makeAnimal(2000).mesh, 60));
  checkPoints(SeededMesh(openTorus(), 60));
}

TEST_CASE("points follow the number of rays, their rotation and the outlier rule") {
  checkPoints(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = 1}));
  checkPoints(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = 8}));
  checkPoints(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = 33, .rotation = ConeRotation::Hashed}));
  checkPoints(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = kMaxRayCount}));
  checkPoints(SeededMesh(makeAnimal(2000).mesh, 20, {.falseHitAngleDegrees = 40, .outlierDeviations = 0.5}));
  checkPoints(SeededMesh(openTorus(), 20, {.definition = Definition::Cgal}));
}

TEST_CASE("a seed without hits has no inliers and a median length of 0") {
  checkPoints(SeededMesh(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}, 1));
}

TEST_CASE("after clear() the first seed is at the first group again") {
  const SeededMesh seeded(makeTorus(800).mesh, 2);
  const TraceScene scene = seeded.scene();
  HitPoints points(scene, seeded.cone, seeded.seedHits());
  (void)points.append(0);
  CHECK(points.append(1).firstGroup > 0);
  points.clear();
  CHECK(points.groups().empty());
  CHECK(points.append(1).firstGroup == 0);
}
