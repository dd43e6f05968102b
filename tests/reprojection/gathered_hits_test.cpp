#include "reprojection/gathered_hits.h"
#include "core/lanes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "generate/shapes.h"
#include "reprojection/seeded_mesh.h"
#include "shared/cone_rules.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

/// Without its upper half, so that rays escape.
Mesh openTorus() {
  Mesh mesh = makeTorus(1200).mesh;
  std::erase_if(mesh.faces, [&](const Face& face) { return mesh.vertices[face[0]].z > 0.1; });
  return mesh;
}

std::vector<uint32_t> allCones(const SeededMesh& seeded) {
  std::vector<uint32_t> cones(seeded.seeds.size());
  std::iota(cones.begin(), cones.end(), 0u);
  return cones;
}

/// The outlier rule, written again from the definition in cone.h: which of the valid lengths count.
std::vector<bool> keptByTheRule(const std::vector<double>& lengths, double deviations) {
  std::vector<double> sorted = lengths;
  std::sort(sorted.begin(), sorted.end());
  const size_t count = sorted.size();
  if (count == 0) return {};
  const double median = count % 2 == 1 ? sorted[count / 2] : 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]);
  const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(count);
  double squares = 0;
  for (const double length : sorted) squares += (length - mean) * (length - mean);
  const double bound =
      deviations * std::sqrt(squares / static_cast<double>(count)) + static_cast<double>(kOutlierSlack) * median;
  std::vector<bool> kept;
  for (const double length : lengths) kept.push_back(std::abs(length - median) <= bound);
  return kept;
}

void checkGathered(const SeededMesh& seeded) {
  const TraceScene scene = seeded.scene();
  const std::vector<LengthWindow> windows = keptLengths(scene, seeded.cone, seeded.traced());
  GatheredHits gathered(scene, seeded.cone, seeded.traced(), windows);
  gathered.gather(allCones(seeded));
  const size_t rayCount = seeded.cone.directions.size(), stride = gathered.raysPerCone();
  CHECK(stride % kLaneCount == 0);
  CHECK(stride >= rayCount);
  CHECK(stride < rayCount + kLaneCount);
  REQUIRE(gathered.size() == stride * seeded.seeds.size());

  for (size_t cone = 0; cone < seeded.seeds.size(); ++cone) {
    const Vec3d& seedNormal = seeded.geometry.normals[seeded.seeds[cone]];
    std::vector<double> lengths;
    std::vector<size_t> validAt;
    for (size_t ray = 0; ray < stride; ++ray) {
      const size_t at = cone * stride + ray;
      if (ray >= rayCount || seeded.hits[cone * rayCount + ray].face == kNoFace) {
        CHECK(std::isnan(gathered.x[at]));
        CHECK(std::isnan(gathered.y[at]));
        CHECK(std::isnan(gathered.z[at]));
        CHECK(gathered.kept[at] == 0);
        CHECK(gathered.spread[at] == 0);
        CHECK(gathered.face[at] == kNoFace);
        continue;
      }
      const ConeHit& hit = seeded.hits[cone * rayCount + ray];
      REQUIRE(gathered.face[at] == hit.face);
      const Vec3d point{gathered.x[at], gathered.y[at], gathered.z[at]};
      const Vec3d normal{gathered.nx[at], gathered.ny[at], gathered.nz[at]};
      const Vec3d corner = seeded.bvh.normalization.toNormalized(seeded.mesh.vertices[seeded.mesh.faces[hit.face][0]]);
      CHECK(length(normal - seeded.geometry.normals[hit.face]) < 1e-6);
      CHECK(std::abs(dot(point - corner, seeded.geometry.normals[hit.face])) < 2e-6);
      const Vec3d way = point - seeded.bvh.normalization.toNormalized(seeded.geometry.barycentres[seeded.seeds[cone]]);
      CHECK(length(way) == doctest::Approx(hit.distance).epsilon(1e-5));
      const double incidence = std::abs(dot(way, normal)) / length(way);
      CHECK(gathered.spread[at] ==
            doctest::Approx(dot(way, way) / (incidence + static_cast<double>(kGrazingSlack))).epsilon(1e-3));
      if (isFalseHit(seeded.cone, seedNormal, seeded.geometry.normals[hit.face])) {
        CHECK(gathered.kept[at] == 0);
      } else {
        validAt.push_back(at);
        lengths.push_back(static_cast<double>(hit.distance));
      }
    }
    const std::vector<bool> kept = keptByTheRule(lengths, seeded.cone.outlierDeviations);
    for (size_t i = 0; i < kept.size(); ++i) CHECK(gathered.kept[validAt[i]] == (kept[i] ? 1.0f : 0.0f));
  }
}

}  // namespace

TEST_CASE("gathered points lie on the faces hit, at the length of their ray; misses and padding are nowhere") {
  checkGathered(SeededMesh(makeAnimal(2000).mesh, 60));
  checkGathered(SeededMesh(openTorus(), 60));
}

TEST_CASE("the number of rays, their rotation and the outlier rule are followed") {
  checkGathered(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = 1}));
  checkGathered(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = 8}));
  checkGathered(SeededMesh(makeTorus(800).mesh, 20, {.rayCount = 33, .rotation = ConeRotation::Hashed}));
  checkGathered(SeededMesh(makeAnimal(2000).mesh, 20, {.falseHitAngleDegrees = 40, .outlierDeviations = 0.5}));
}

TEST_CASE("gathering again leaves nothing of what was gathered before") {
  const SeededMesh seeded(openTorus(), 12);
  const TraceScene scene = seeded.scene();
  const TracedCones traced = seeded.traced();
  const std::vector<LengthWindow> windows = keptLengths(scene, seeded.cone, traced);
  GatheredHits again(scene, seeded.cone, traced, windows), fresh(scene, seeded.cone, traced, windows);
  again.gather(allCones(seeded));
  const std::vector<uint32_t> two{5, 3};
  again.gather(two);
  fresh.gather(two);
  REQUIRE(again.size() == fresh.size());
  const auto sameBits = [](const std::vector<float>& a, const std::vector<float>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  };
  CHECK(sameBits(again.x, fresh.x));
  CHECK(sameBits(again.spread, fresh.spread));
  CHECK(sameBits(again.kept, fresh.kept));
  CHECK(again.face == fresh.face);
}

TEST_CASE("a cone none of whose rays is valid keeps nothing") {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  const SeededMesh seeded(mesh, 1);
  const std::vector<LengthWindow> windows = keptLengths(seeded.scene(), seeded.cone, seeded.traced());
  REQUIRE(windows.size() == 1);
  CHECK_FALSE(windows[0].keeps(0.5));
}

TEST_CASE("appended points fill whole cones, count as kept, and stand for their area") {
  const SeededMesh seeded(makeTorus(800).mesh, 3);
  const TraceScene scene = seeded.scene();
  const TracedCones traced = seeded.traced();
  const std::vector<LengthWindow> windows = keptLengths(scene, seeded.cone, traced);
  GatheredHits hits(scene, seeded.cone, traced, windows), before(scene, seeded.cone, traced, windows);
  hits.gather(allCones(seeded));
  before.gather(allCones(seeded));
  const size_t stride = hits.raysPerCone();
  std::vector<GatheredHits::Point> points;
  for (size_t i = 0; i < stride + 1; ++i)
    points.push_back({{0.1 * static_cast<double>(i), 0.5, -0.5}, {0, 0, 1}, 0.25, static_cast<uint32_t>(i)});
  CHECK(hits.append({}) == 0);
  CHECK(hits.size() == before.size());
  REQUIRE(hits.append(points) == 2);
  REQUIRE(hits.size() == before.size() + 2 * stride);
  CHECK(std::equal(before.face.begin(), before.face.end(), hits.face.begin()));
  // 30 rays share a cone of half a half-space: pi steradians.
  const double raySolidAngle = std::numbers::pi / 30;
  for (size_t i = 0; i < 2 * stride; ++i) {
    const size_t at = before.size() + i;
    if (i >= points.size()) {
      CHECK(std::isnan(hits.x[at]));
      CHECK(hits.kept[at] == 0);
      CHECK(hits.face[at] == kNoFace);
      continue;
    }
    CHECK(hits.x[at] == static_cast<float>(points[i].position.x));
    CHECK(hits.y[at] == 0.5f);
    CHECK(hits.z[at] == -0.5f);
    CHECK(hits.nz[at] == 1);
    CHECK(hits.kept[at] == 1);
    CHECK(hits.face[at] == i);
    CHECK(hits.spread[at] == doctest::Approx(0.25 / raySolidAngle));
  }
  hits.gather(allCones(seeded));
  CHECK(hits.size() == before.size());
}
