#include "reprojection/reprojected_cone.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "generate/shapes.h"
#include "reprojection/plain_twin.h"
#include "reprojection/seeded_mesh.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

/// The hits of some cones of a mesh.
struct Gathering {
  const SeededMesh& seeded;
  TraceScene scene = seeded.scene();
  TracedCones traced = seeded.traced();
  std::vector<LengthWindow> windows = keptLengths(scene, seeded.cone, traced);
  GatheredHits hits{scene, seeded.cone, traced, windows};

  Gathering(const SeededMesh& from, const std::vector<uint32_t>& cones) : seeded(from) { hits.gather(cones); }
};

VirtualCone coneOf(const SeededMesh& seeded, uint32_t face) {
  return {seeded.bvh.normalization.toNormalized(seeded.geometry.barycentres[face]), seeded.geometry.normals[face],
          seeded.representatives[face]};
}

Vec3d randomUnit(Random& random) {
  for (;;) {
    const Vec3d v{2 * random.real() - 1, 2 * random.real() - 1, 2 * random.real() - 1};
    if (const double size = length(v); size > 0.1 && size < 1) return v * (1 / size);
  }
}

/// Points all over the box, of which some are misses.
void scramble(GatheredHits& hits, Random& random) {
  for (size_t i = 0; i < hits.size(); ++i) {
    const Vec3d normal = randomUnit(random);
    const bool isMiss = random.index(6) == 0;
    for (std::vector<float>* coordinate : {&hits.x, &hits.y, &hits.z})
      (*coordinate)[i] = isMiss ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(2 * random.real() - 1);
    hits.nx[i] = static_cast<float>(normal.x);
    hits.ny[i] = static_cast<float>(normal.y);
    hits.nz[i] = static_cast<float>(normal.z);
    hits.spread[i] = static_cast<float>(0.05 + 4 * random.real());
    hits.kept[i] = random.index(3) == 0 ? 0.0f : 1.0f;
    hits.face[i] = random.index(50);
  }
}

struct Agreement {
  size_t count = 0, exactCount = 0;

  void compare(double value, const test::TwinValue& twin) {
    if (std::isnan(twin.exact)) {
      CHECK(std::isnan(value));
      return;
    }
    double least = std::numeric_limits<double>::max();
    for (const double candidate : twin.admissible) least = std::min(least, std::abs(value - candidate) / candidate);
    CHECK_MESSAGE(least < 1e-3, value, " against ", twin.exact);
    ++count;
    exactCount += std::abs(value - twin.exact) < 1e-3 * twin.exact;
  }
};

std::vector<uint32_t> firstCones(uint32_t count) {
  std::vector<uint32_t> cones(count);
  std::iota(cones.begin(), cones.end(), 0u);
  return cones;
}

}  // namespace

TEST_CASE("random hits give what a plain double-precision twin gives") {
  Random random(11);
  Agreement agreement;
  for (const ConeOptions& options :
       {ConeOptions{}, ConeOptions{.rayCount = 5, .openingAngleDegrees = 150, .outlierDeviations = 0.7},
        ConeOptions{.rayCount = 64, .openingAngleDegrees = 60, .falseHitAngleDegrees = 30}}) {
    const SeededMesh seeded(makeSphere(180).mesh, 7, options);
    Gathering gathering(seeded, firstCones(7));
    ReprojectedCone cone(seeded.cone);
    for (int round = 0; round < 200; ++round) {
      scramble(gathering.hits, random);
      std::vector<float> weights(7);
      for (float& weight : weights) weight = static_cast<float>(1e-6 + random.real());
      const VirtualCone at{0.5 * randomUnit(random), randomUnit(random), random.index(50)};
      agreement.compare(cone.value(gathering.hits, at, weights),
                        test::plainTwin(seeded.cone, gathering.hits, at, weights));
    }
  }
  CHECK(agreement.count > 550);
  CHECK(agreement.exactCount > agreement.count * 7 / 10);
}

TEST_CASE("real hits give what a plain double-precision twin gives") {
  Random random(12);
  Agreement agreement;
  const SeededMesh seeded(makeHand(3000).mesh, 60);
  const SeedCells cells = seeded.cells();
  ReprojectedCone cone(seeded.cone);
  for (uint32_t cell = 0; cell < 60; ++cell) {
    const std::vector<uint32_t> cones = nearestCells(cells, seeded.geometry, seeded.seeds, cell, 6);
    const Gathering gathering(seeded, cones);
    std::vector<float> weights(cones.size());
    for (float& weight : weights) weight = static_cast<float>(0.01 + random.real());
    for (const uint32_t face : cells.faces[cell].first(std::min<size_t>(10, cells.faces[cell].size())))
      agreement.compare(cone.value(gathering.hits, coneOf(seeded, face), weights),
                        test::plainTwin(seeded.cone, gathering.hits, coneOf(seeded, face), weights));
  }
  CHECK(agreement.count > 400);
  CHECK(agreement.exactCount > agreement.count * 7 / 10);
}

TEST_CASE("a seed seen from itself keeps about its own value") {
  // Every ray stands for its own solid angle then; only the median of an even count is another one.
  const SeededMesh seeded(makeAnimal(2500).mesh, 200);
  ReprojectedCone cone(seeded.cone);
  size_t farCount = 0;
  double sum = 0;
  for (uint32_t i = 0; i < seeded.seeds.size(); ++i) {
    const Gathering gathering(seeded, {i});
    const std::vector<float> weight{0.3f};
    const double value =
        seeded.bvh.normalization.toMeshLength(cone.value(gathering.hits, coneOf(seeded, seeded.seeds[i]), weight));
    const double off = std::abs(value - seeded.values[i]) / seeded.values[i];
    farCount += off > 1e-3;
    sum += off;
  }
  MESSAGE("off by ", sum / 200, " on average, far off ", farCount, " of 200");
  CHECK(sum / 200 < 0.01);
  CHECK(farCount < 30);
}

TEST_CASE("cones of more weight have more of a say") {
  const SeededMesh seeded(makeAnimal(2500).mesh, 2);
  const Gathering gathering(seeded, {0, 1});
  GatheredHits hits = gathering.hits;
  // Both cones see a wall across, one at 0.5 and one at 0.7.
  const size_t stride = hits.raysPerCone();
  for (size_t i = 0; i < hits.size(); ++i) {
    hits.x[i] = 0.001f * static_cast<float>(i % stride);
    hits.y[i] = 0;
    hits.z[i] = i < stride ? -0.5f : -0.7f;
    hits.nx[i] = hits.ny[i] = 0;
    hits.nz[i] = -1;
    hits.spread[i] = 0.3f;
    hits.kept[i] = 1;
    hits.face[i] = 1;
  }
  ReprojectedCone cone(seeded.cone);
  const VirtualCone at{{0, 0, 0}, {0, 0, 1}, 0};
  double last = 1;
  for (const float weight : {0.1f, 0.5f, 1.0f, 2.0f, 10.0f}) {
    const std::vector<float> weights{weight, 1.0f};
    const double value = cone.value(hits, at, weights);
    CHECK(value < last);
    CHECK(value > 0.5);
    last = value;
  }
}

TEST_CASE("points on the face itself, points behind it and points that look its way do not count") {
  const SeededMesh seeded(makeSphere(180).mesh, 1);
  const Gathering gathering(seeded, {0});
  ReprojectedCone cone(seeded.cone);
  const std::vector<float> weight{1};
  const VirtualCone at{{0, 0, 0}, {0, 0, 1}, 5};
  const auto valueWith = [&](float z, float nz, uint32_t face) {
    GatheredHits hits = gathering.hits;
    for (size_t i = 0; i < hits.size(); ++i) {
      hits.x[i] = hits.y[i] = hits.nx[i] = hits.ny[i] = 0;
      hits.z[i] = z;
      hits.nz[i] = nz;
      hits.spread[i] = hits.kept[i] = 1;
      hits.face[i] = face;
    }
    return cone.value(hits, at, weight);
  };
  CHECK(valueWith(-0.5f, -1, 6) == doctest::Approx(0.5));
  CHECK(std::isnan(valueWith(-0.5f, -1, 5)));
  CHECK(std::isnan(valueWith(0.5f, -1, 6)));
  CHECK(std::isnan(valueWith(-0.5f, 1, 6)));
  CHECK(std::isnan(valueWith(0, -1, 6)));  // At the face's own centre.
}

TEST_CASE("rays that met nothing change nothing") {
  const SeededMesh seeded(makeTorus(900).mesh, 2);
  Gathering both(seeded, {0, 1});
  const Gathering first(seeded, {0});
  const size_t stride = both.hits.raysPerCone();
  for (size_t i = stride; i < both.hits.size(); ++i)
    both.hits.x[i] = both.hits.y[i] = both.hits.z[i] = std::numeric_limits<float>::quiet_NaN();
  ReprojectedCone cone(seeded.cone);
  const std::vector<float> weights{0.5f, 0.9f};
  const VirtualCone at = coneOf(seeded, seeded.seeds[0]);
  const double value = cone.value(both.hits, at, weights);
  CHECK(std::isfinite(value));
  CHECK(value == cone.value(first.hits, at, std::span(weights).first(1)));
}

TEST_CASE("wide instructions and the baseline give the same bits") {
  if (widestInstructionSet() == InstructionSet::Baseline) {
    MESSAGE("skipped: this machine has no wide instructions");
    return;
  }
  Random random(13);
  const SeededMesh seeded(makeSphere(180).mesh, 5, {.rayCount = 30, .openingAngleDegrees = 140});
  Gathering gathering(seeded, firstCones(5));
  ReprojectedCone wide(seeded.cone, widestInstructionSet()), baseline(seeded.cone, InstructionSet::Baseline);
  size_t valueCount = 0;
  for (int round = 0; round < 500; ++round) {
    scramble(gathering.hits, random);
    std::vector<float> weights(5);
    for (float& weight : weights) weight = static_cast<float>(1e-6 + random.real());
    const VirtualCone at{0.5 * randomUnit(random), randomUnit(random), random.index(50)};
    const double a = wide.value(gathering.hits, at, weights), b = baseline.value(gathering.hits, at, weights);
    valueCount += std::isfinite(a);
    CHECK(std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b));
  }
  CHECK(valueCount > 450);
}
