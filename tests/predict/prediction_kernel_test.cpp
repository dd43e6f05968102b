#include "predict/prediction_kernel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <numeric>

#include "generate/shapes.h"
#include "predict/hit_points.h"
#include "predict/plain_twin.h"
#include "predict/seeded_mesh.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

/// The hit points of some seeds of a mesh, each with the weight 1.
struct TestInput {
  std::vector<PointGroup> groups;
  std::vector<WeightedRange> ranges;
  float medianLength = 0;  ///< Median length of the hits of the first seed.

  TestInput(const SeededMesh& seeded, const std::vector<uint32_t>& seeds) {
    const TraceScene scene = seeded.scene();
    HitPoints points(scene, seeded.cone, seeded.seedHits());
    for (const uint32_t seed : seeds) {
      const HitRange range = points.append(seed);
      if (ranges.empty()) medianLength = range.medianLength;
      ranges.push_back({range.firstGroup, range.groupCount, 1});
    }
    groups.assign(points.groups().begin(), points.groups().end());
  }

  void weigh(Random& random, double minWeight) {
    for (WeightedRange& range : ranges) range.weight = static_cast<float>(minWeight + random.real());
  }

  /// Calls change(group, lane, seed) for each point of each seed.
  template <typename Change>
  void change(const Change& change) {
    for (size_t seed = 0; seed < ranges.size(); ++seed)
      for (uint32_t i = 0; i < ranges[seed].groupCount; ++i)
        for (size_t lane = 0; lane < kPointGroupSize; ++lane) change(groups[ranges[seed].firstGroup + i], lane, seed);
  }

  [[nodiscard]] double value(PredictionKernel& kernel, const VirtualCone& at) const {
    return kernel.value(groups, ranges, at, medianLength);
  }
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

/// Random points in the box; some are misses.
void scramble(TestInput& input, Random& random) {
  input.change([&](PointGroup& group, size_t lane, size_t) {
    const Vec3d normal = randomUnit(random);
    const bool isMiss = random.index(6) == 0;
    for (float* coordinate : {group.x, group.y, group.z})
      coordinate[lane] = isMiss ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(2 * random.real() - 1);
    group.nx[lane] = static_cast<float>(normal.x);
    group.ny[lane] = static_cast<float>(normal.y);
    group.nz[lane] = static_cast<float>(normal.z);
    group.solidAngleRatio[lane] = static_cast<float>(0.05 + 4 * random.real());
    group.isInlier[lane] = random.index(3) == 0 ? 0.0f : 1.0f;
    group.face[lane] = random.index(50);
  });
}

struct Agreement {
  size_t count = 0, exactCount = 0;

  void compare(double value, const test::TwinValue& twin) {
    if (std::isnan(twin.exact)) {
      CHECK(std::isnan(value));
      return;
    }
    double minDifference = std::numeric_limits<double>::max();
    for (const double candidate : twin.admissible)
      minDifference = std::min(minDifference, std::abs(value - candidate) / candidate);
    CHECK_MESSAGE(minDifference < 1e-3, value, " against ", twin.exact);
    ++count;
    exactCount += std::abs(value - twin.exact) < 1e-3 * twin.exact;
  }
};

std::vector<uint32_t> firstSeeds(uint32_t count) {
  std::vector<uint32_t> seeds(count);
  std::iota(seeds.begin(), seeds.end(), 0u);
  return seeds;
}

}  // namespace

TEST_CASE("random hits give the value of the double-precision twin") {
  Random random(11);
  Agreement agreement;
  for (const ConeOptions& options :
       {ConeOptions{}, ConeOptions{.rayCount = 5, .openingAngleDegrees = 150, .outlierDeviations = 0.7},
        ConeOptions{.rayCount = 64, .openingAngleDegrees = 60, .falseHitAngleDegrees = 30},
        ConeOptions{.rayCount = 25, .definition = Definition::Cgal}}) {
    const SeededMesh seeded(makeSphere(180).mesh, 7, options);
    TestInput input(seeded, firstSeeds(7));
    PredictionKernel kernel(seeded.cone);
    for (int round = 0; round < 200; ++round) {
      scramble(input, random);
      input.weigh(random, 1e-6);
      const VirtualCone at{0.5 * randomUnit(random), randomUnit(random), random.index(50)};
      agreement.compare(input.value(kernel, at), test::plainTwin(seeded.cone, input.groups, input.ranges, at));
    }
  }
  CHECK(agreement.count > 550);
  CHECK(agreement.exactCount > agreement.count * 7 / 10);
}

TEST_CASE("real hits give the value of the double-precision twin") {
  Random random(12);
  Agreement agreement;
  const SeededMesh seeded(makeHand(3000).mesh, 60);
  const SeedCells cells = seeded.cells();
  PredictionKernel kernel(seeded.cone);
  const NearestCells nearest(cells, seeded.graph, seeded.geometry, seeded.seeds, 6);
  for (uint32_t cell = 0; cell < 60; ++cell) {
    TestInput input(seeded, {nearest.of(cell).begin(), nearest.of(cell).end()});
    input.weigh(random, 0.01);
    for (const uint32_t face : cells.faces[cell].first(std::min<size_t>(10, cells.faces[cell].size())))
      agreement.compare(input.value(kernel, coneOf(seeded, face)),
                        test::plainTwin(seeded.cone, input.groups, input.ranges, coneOf(seeded, face)));
  }
  CHECK(agreement.count > 400);
  CHECK(agreement.exactCount > agreement.count * 7 / 10);
}

TEST_CASE("the prediction of a seed from its own hits is close to its value") {
  // All solid angle ratios are 1; only the median of an even count differs.
  const SeededMesh seeded(makeAnimal(2500).mesh, 200);
  PredictionKernel kernel(seeded.cone);
  size_t farCount = 0;
  double sum = 0;
  for (uint32_t i = 0; i < seeded.seeds.size(); ++i) {
    TestInput input(seeded, {i});
    input.ranges[0].weight = 0.3f;
    const double value = seeded.bvh.normalization.toMeshLength(input.value(kernel, coneOf(seeded, seeded.seeds[i])));
    const double error = std::abs(value - seeded.values[i]) / seeded.values[i];
    farCount += error > 1e-3;
    sum += error;
  }
  CHECK(sum / 200 < 0.01);
  CHECK(farCount < 30);
}

TEST_CASE("a seed with a larger weight has more influence") {
  const SeededMesh seeded(makeAnimal(2500).mesh, 2);
  TestInput input(seeded, {0, 1});
  // One seed hits a wall at 0.5, the other a wall at 0.7.
  input.change([&](PointGroup& group, size_t lane, size_t seed) {
    group.x[lane] = 0.001f * static_cast<float>(lane);
    group.y[lane] = 0;
    group.z[lane] = seed == 0 ? -0.5f : -0.7f;
    group.nx[lane] = group.ny[lane] = 0;
    group.nz[lane] = -1;
    group.solidAngleRatio[lane] = 0.3f;
    group.isInlier[lane] = 1;
    group.face[lane] = 1;
  });
  PredictionKernel kernel(seeded.cone);
  const VirtualCone at{{0, 0, 0}, {0, 0, 1}, 0};
  double last = 1;
  for (const float weight : {0.1f, 0.5f, 1.0f, 2.0f, 10.0f}) {
    input.ranges[0].weight = weight;
    const double value = input.value(kernel, at);
    CHECK(value < last);
    CHECK(value > 0.5);
    last = value;
  }
}

TEST_CASE("points on the face itself, points outside of its cone and false hits are ignored") {
  const SeededMesh seeded(makeSphere(180).mesh, 1);
  TestInput input(seeded, {0});
  PredictionKernel kernel(seeded.cone);
  const VirtualCone at{{0, 0, 0}, {0, 0, 1}, 5};
  const auto valueWith = [&](float z, float nz, uint32_t face) {
    input.change([&](PointGroup& group, size_t lane, size_t) {
      group.x[lane] = group.y[lane] = group.nx[lane] = group.ny[lane] = 0;
      group.z[lane] = z;
      group.nz[lane] = nz;
      group.solidAngleRatio[lane] = group.isInlier[lane] = 1;
      group.face[lane] = face;
    });
    return input.value(kernel, at);
  };
  CHECK(valueWith(-0.5f, -1, 6) == doctest::Approx(0.5));
  CHECK(std::isnan(valueWith(-0.5f, -1, 5)));
  CHECK(std::isnan(valueWith(0.5f, -1, 6)));
  CHECK(std::isnan(valueWith(-0.5f, 1, 6)));
  CHECK(std::isnan(valueWith(0, -1, 6)));  // At the origin of the cone.
}

TEST_CASE("misses are ignored") {
  const SeededMesh seeded(makeTorus(900).mesh, 2);
  TestInput both(seeded, {0, 1}), first(seeded, {0});
  both.change([&](PointGroup& group, size_t lane, size_t seed) {
    if (seed == 1) group.x[lane] = group.y[lane] = group.z[lane] = std::numeric_limits<float>::quiet_NaN();
  });
  PredictionKernel kernel(seeded.cone);
  for (TestInput* input : {&both, &first}) input->ranges[0].weight = 0.5f;
  const VirtualCone at = coneOf(seeded, seeded.seeds[0]);
  const double value = both.value(kernel, at);
  CHECK(std::isfinite(value));
  CHECK(value == first.value(kernel, at));
}

TEST_CASE("the median length passed to the kernel affects rounding only") {
  const SeededMesh seeded(makeAnimal(2500).mesh, 40);
  PredictionKernel kernel(seeded.cone);
  for (uint32_t i = 0; i + 2 < 40; ++i) {
    TestInput input(seeded, {i, i + 1, i + 2});
    const VirtualCone at = coneOf(seeded, seeded.seeds[i]);
    const double expected = input.value(kernel, at);
    input.medianLength *= 0.5f;
    const double value = input.value(kernel, at);
    CHECK(std::isnan(value) == std::isnan(expected));
    if (!std::isnan(value)) CHECK(value == doctest::Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("the value of a narrow cone with almost equal lengths is their value") {
  const SeededMesh seeded(makeSphere(2000).mesh, 20, {.openingAngleDegrees = 0.1});
  PredictionKernel kernel(seeded.cone);
  for (uint32_t i = 0; i < 20; ++i) {
    const TestInput input(seeded, {i});
    CHECK(seeded.bvh.normalization.toMeshLength(input.value(kernel, coneOf(seeded, seeded.seeds[i]))) ==
          doctest::Approx(seeded.values[i]).epsilon(1e-3));
  }
}

TEST_CASE("the weight of a seed is a Gaussian of its distance and of the angle between the normals") {
  Random random(14);
  SeedGroup seeds;
  std::vector<Vec3d> positions, normals;
  for (size_t lane = 0; lane < kPointGroupSize; ++lane) {
    positions.push_back(0.3 * randomUnit(random));
    normals.push_back(lane == 0 ? Vec3d{0, 0, 1} : randomUnit(random));
    seeds.x[lane] = static_cast<float>(positions[lane].x);
    seeds.y[lane] = static_cast<float>(positions[lane].y);
    seeds.z[lane] = static_cast<float>(positions[lane].z);
    seeds.nx[lane] = static_cast<float>(normals[lane].x);
    seeds.ny[lane] = static_cast<float>(normals[lane].y);
    seeds.nz[lane] = static_cast<float>(normals[lane].z);
  }
  const VirtualCone at{{0.1, 0, 0}, {0, 0, 1}, 0};
  for (const double reach : {0.05, 0.2, 10.0})
    for (const InstructionSet instructionSet :
         {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512}) {
      if (!hasInstructionSet(instructionSet)) continue;
      float weights[kPointGroupSize];
      PredictionKernel(makeCone({}), instructionSet)
          .weigh(seeds, {static_cast<float>(1 / (reach * reach)), 4}, at, weights);
      for (size_t lane = 0; lane < kPointGroupSize; ++lane) {
        const double distance = length(positions[lane] - at.origin) / reach;
        const double turn = 2 * std::acos(std::clamp(dot(normals[lane], at.normal), -1.0, 1.0));
        const double exact = std::exp(-0.5 * (distance * distance + turn * turn));
        CHECK(static_cast<double>(weights[lane]) ==
              doctest::Approx(std::max(exact, 1e-6)).epsilon(turn < std::numbers::pi ? 0.03 : 100));
      }
    }
}

TEST_CASE("wide instructions and the baseline give the same bits") {
  Random random(13);
  const SeededMesh seeded(makeSphere(180).mesh, 5, {.rayCount = 30, .openingAngleDegrees = 140});
  TestInput input(seeded, firstSeeds(5));
  for (const InstructionSet instructionSet : {InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (!hasInstructionSet(instructionSet)) {
      MESSAGE("skipped: this machine lacks wide instructions");
      continue;
    }
    PredictionKernel wide(seeded.cone, instructionSet), baseline(seeded.cone, InstructionSet::Baseline);
    size_t valueCount = 0;
    for (int round = 0; round < 500; ++round) {
      scramble(input, random);
      input.weigh(random, 1e-6);
      const VirtualCone at{0.5 * randomUnit(random), randomUnit(random), random.index(50)};
      const double a = input.value(wide, at), b = input.value(baseline, at);
      valueCount += std::isfinite(a);
      CHECK(std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b));
    }
    CHECK(valueCount > 450);
    for (int round = 0; round < 500; ++round) {
      SeedGroup seeds;
      for (float* numbers : {seeds.x, seeds.y, seeds.z, seeds.nx, seeds.ny, seeds.nz})
        for (size_t lane = 0; lane < kPointGroupSize; ++lane) numbers[lane] = static_cast<float>(2 * random.real() - 1);
      const VirtualCone at{0.5 * randomUnit(random), randomUnit(random), 0};
      float a[kPointGroupSize], b[kPointGroupSize];
      wide.weigh(seeds, {9, 4}, at, a);
      baseline.weigh(seeds, {9, 4}, at, b);
      CHECK(std::memcmp(a, b, sizeof a) == 0);
    }
  }
}
