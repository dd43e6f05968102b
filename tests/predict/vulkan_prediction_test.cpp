#include "predict/vk/vulkan_prediction.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <ranges>
#include <stop_token>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "generate/shapes.h"
#include "predict/seeded_mesh.h"
#include "shared/prediction_layout.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace/vk/vulkan_tracer.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

VulkanPredictionKernels kernelsFor(const Device& device, const Cone& cone) {
  return {device, cone.definition, static_cast<uint32_t>(cone.directions.size())};
}

UnsetVector<double> predictOn(const SeededMesh& seeded, const PredictionOptions& options, DevicePredictor* device) {
  return predictValues(seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), options, {}, device).values;
}

/// Differences between the values of the device and of the CPU, in units of the diagonal of the bounding box.
struct DeviceDifference {
  double mean = 0, worst = 0;      ///< mean: without differences above 1e-4.
  size_t count = 0, farCount = 0;  ///< farCount: number of differences above 1e-4.
  size_t missingCount = 0;         ///< Faces with a value from either the device or the CPU only.
};

DeviceDifference differenceOf(const SeededMesh& seeded, std::span<const double> values,
                              std::span<const double> expected) {
  REQUIRE(values.size() == expected.size());
  const double diagonal = length(seeded.geometry.bounds.max - seeded.geometry.bounds.min);
  DeviceDifference difference;
  for (size_t face = 0; face < values.size(); ++face) {
    difference.missingCount += std::isnan(values[face]) != std::isnan(expected[face]);
    const double distance = std::abs(values[face] - expected[face]) / diagonal;
    if (std::isnan(distance)) continue;
    difference.worst = std::max(difference.worst, distance);
    ++difference.count;
    if (distance > 1e-4)
      ++difference.farCount;
    else
      difference.mean += distance;
  }
  difference.mean /= static_cast<double>(std::max<size_t>(1, difference.count));
  return difference;
}

DeviceDifference compare(const Device& device, const SeededMesh& seeded, const PredictionOptions& options = {}) {
  const VulkanPredictionKernels kernels = kernelsFor(device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
  return differenceOf(seeded, predictOn(seeded, options, predictor.get()), predictOn(seeded, options, nullptr));
}

void checkClose(const DeviceDifference& difference) {
  MESSAGE("mean ", difference.mean, ", worst ", difference.worst, ", above 1e-4: ", difference.farCount, " of ",
          difference.count, ", missing: ", difference.missingCount);
  CHECK(difference.mean < 2e-6);
  CHECK(difference.worst < 0.02);
  CHECK(difference.farCount <= 2 + difference.count / 1000);
  CHECK(difference.missingCount <= 1 + difference.count / 1000);
}

/// Two spheres with duplicate faces, degenerate faces and a component without seeds.
Mesh defectiveMesh() {
  Mesh mesh = shapes::joined(makeSphere(720).mesh, makeSphere(180).mesh, {4, 0, 0});
  const std::vector<Face> faces = mesh.faces;
  for (size_t i = 0; i < 100; i += 2) mesh.faces.push_back(faces[i]);
  mesh.faces.push_back({faces[0][0], faces[0][0], faces[0][1]});
  return mesh;
}

}  // namespace

TEST_CASE(
    "predictions of the device are those of the CPU but for rounding, for both definitions and any number of rays") {
  const test::ValidatedDevice device;
  const Mesh animal = generateShape("animal", 4000).mesh, slab = makeSlab(2000, 2, 0.2).mesh;
  for (const Definition definition : {Definition::Paper, Definition::Cgal})
    for (const uint32_t rayCount : {1u, 30u, 100u}) {
      CAPTURE(rayCount);
      CAPTURE(definition == Definition::Cgal);
      const ConeOptions options{.rayCount = rayCount, .definition = definition};
      const DeviceDifference difference = compare(*device, SeededMesh(animal, 400, options));
      checkClose(difference);
      CHECK(difference.count > 2000);
      checkClose(compare(*device, SeededMesh(slab, 150, options)));
    }
}

TEST_CASE("predictions of the device are those of the CPU for other cones and other numbers of neighbours") {
  const test::ValidatedDevice device;
  const Mesh mesh = makeHand(3000).mesh;
  for (const ConeOptions& options :
       {ConeOptions{.rayCount = 33, .openingAngleDegrees = 175}, ConeOptions{.openingAngleDegrees = 1},
        ConeOptions{.rayCount = 40, .openingAngleDegrees = 60, .falseHitAngleDegrees = 30, .outlierDeviations = 0.7},
        ConeOptions{.rotation = ConeRotation::Hashed}})
    checkClose(compare(*device, SeededMesh(mesh, 200, options)));
  // Rounding moves one of the thousands of points of a face across a bound more often, and each counts less.
  for (const Definition definition : {Definition::Paper, Definition::Cgal})
    CHECK(compare(*device, SeededMesh(makeSphere(180).mesh, 20, {.rayCount = 1000, .definition = definition})).worst <
          2e-3);
  const SeededMesh seeded(mesh, 200);
  for (const uint32_t neighbourCount : {0u, 1u, 6u})
    checkClose(compare(*device, seeded, {.neighbourCount = neighbourCount}));
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
  test::requireFailure([&] { (void)predictOn(seeded, {.neighbourCount = 7}, predictor.get()); }, ErrorCode::DeviceLimit,
                       "7 neighbouring seeds");
}

TEST_CASE("on the device, too, degenerate faces and faces of components without a seed have no prediction") {
  const test::ValidatedDevice device;
  SeededMesh seeded(defectiveMesh(), 100);
  for (uint32_t& seed : seeded.seeds)
    if (seed >= 720 && seed < 900) seed = kNoFace;  // On the second sphere.
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
  const UnsetVector<double> values = predictOn(seeded, {}, predictor.get());
  checkClose(differenceOf(seeded, values, predictOn(seeded, {}, nullptr)));
  for (uint32_t face = 0; face < 720; ++face) CHECK(std::isfinite(values[face]));
  for (uint32_t face = 720; face < 900; ++face) CHECK(std::isnan(values[face]));
  CHECK(std::isnan(values.back()));
}

TEST_CASE("on the device, too, an open mesh, a single seed, no seeds and only seeds have the values of the CPU") {
  const test::ValidatedDevice device;
  Mesh open = makeAnimal(3000).mesh;
  std::erase_if(open.faces, [&](const Face& face) { return open.vertices[face[0]].x > 0.3; });
  checkClose(compare(*device, SeededMesh(open, 300)));
  const SeededMesh flat({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {}}, 2);
  CHECK(compare(*device, flat).count == 0);
  checkClose(compare(*device, SeededMesh(makeSphere(500).mesh, 1)));
  CHECK(compare(*device, SeededMesh(makeSphere(180).mesh, 0)).count == 0);
  checkClose(compare(*device, SeededMesh(makeSphere(180).mesh, 180)));
}

TEST_CASE("predictions of the device have the same bits in every call, with any size of batches and after other seeds" *
          doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  SeededMesh few(makeAnimal(3000).mesh, 300);
  for (size_t i = 0; i < few.seeds.size(); i += 3) few.seeds[i] = kNoFace;
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
  const UnsetVector<double> expected = predictOn(seeded, {}, predictor.get());
  CHECK(test::haveSameBits(predictOn(seeded, {}, predictor.get()), expected));
  const auto predictorOfFew = makeVulkanPredictor(kernels, few.scene(), few.cone);
  const UnsetVector<double> fewExpected = predictOn(few, {}, predictorOfFew.get());
  CHECK_FALSE(test::haveSameBits(fewExpected, expected));
  for (const PredictionBatchSize& size : {PredictionBatchSize{7, 1}, PredictionBatchSize{7, 1000},
                                          PredictionBatchSize{50, 17}, PredictionBatchSize{1000, 100}}) {
    CAPTURE(size.maxSeedCount);
    const auto other = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone, size);
    CHECK(test::haveSameBits(predictOn(few, {}, other.get()), fewExpected));
    CHECK(test::haveSameBits(predictOn(seeded, {}, other.get()), expected));
  }
}

TEST_CASE("hits that stay on the device give the same bits as uploaded ones, with any size of batches") {
  const test::ValidatedDevice device;
  SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const VulkanConeKernel tracing(*device, {30, true});
  const auto tracer = makeVulkanTracer(tracing, seeded.scene(), seeded.cone);
  const std::unique_ptr<DeviceHits> kept = tracer->makeDeviceHits();
  kept->reserve(seeded.seeds.size());
  (void)tracer->trace(seeded.seeds, {.values = seeded.values, .onDevice = kept.get()}, {});
  (void)tracer->trace(seeded.seeds, {seeded.values, seeded.hits}, {});
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  for (const PredictionBatchSize& size : {PredictionBatchSize{1000, 4000}, PredictionBatchSize{50, 17}}) {
    const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone, size);
    const UnsetVector<double> values = predictValues(seeded.scene(), seeded.domain(), seeded.cone,
                                                     {seeded.seeds, {}, kept.get()}, {}, {}, predictor.get())
                                           .values;
    CHECK(test::haveSameBits(values, predictOn(seeded, {}, predictor.get())));
  }
}

TEST_CASE("predictions of the device scale with the mesh") {
  const test::ValidatedDevice device;
  const Mesh mesh = makeAnimal(1000).mesh;
  const auto valuesOf = [&](double scale) {
    const SeededMesh seeded(shapes::scaledAndShifted(mesh, scale), 100);
    const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
    const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
    UnsetVector<double> values = predictOn(seeded, {}, predictor.get());
    for (double& value : values) value /= scale;
    return values;
  };
  const UnsetVector<double> expected = valuesOf(1);
  for (const double scale : {0.125, std::ldexp(1, -500), std::ldexp(1, 500)})
    CHECK(test::haveSameBits(valuesOf(scale), expected));
}

TEST_CASE("the device, too, copies the values of faces whose seeds are the same as before, and predicts the others") {
  const test::ValidatedDevice device;
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  std::vector<uint32_t> fewer = seeded.seeds;
  for (size_t i = 0; i < fewer.size(); i += 20) fewer[i] = kNoFace;
  // Cells of a few seeds are in several batches of one face.
  for (const PredictionBatchSize& size : {PredictionBatchSize{7, 1}, PredictionBatchSize{1000, 4000}}) {
    const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone, size);
    const auto predict = [&](std::span<const uint32_t> seeds, Prediction earlier) {
      return predictValues(seeded.scene(), seeded.domain(), seeded.cone, {seeds, seeded.hits}, {}, std::move(earlier),
                           predictor.get());
    };
    const Prediction first = predict(fewer, {}), expected = predict(seeded.seeds, {});
    CHECK_FALSE(test::haveSameBits(first.values, expected.values));
    CHECK(test::haveSameBits(predict(seeded.seeds, first).values, expected.values));
    Prediction marked = first;
    std::ranges::fill(marked.values, 7.0);
    const Prediction partly = predict(seeded.seeds, marked);
    size_t keptCount = 0;
    for (uint32_t face = 0; face < expected.values.size(); ++face) {
      const uint32_t cell = expected.cellOf[face];
      const bool isKept =
          first.cellOf[face] == cell && std::ranges::equal(first.nearest.of(cell), expected.nearest.of(cell));
      keptCount += isKept;
      if (isKept || !std::isnan(expected.values[face]))
        CHECK(partly.values[face] == (isKept ? 7.0 : expected.values[face]));
      else
        CHECK(std::isnan(partly.values[face]));
    }
    CHECK(keptCount > 500);
    CHECK(keptCount < 2500);
  }
}

TEST_CASE("the device predicts the nodes of a part of the mesh, whose indices are not those of their faces") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const test::SeededPart part(seeded, 100);
  REQUIRE(part.faces.back() > part.faces.size());
  const test::ValidatedDevice device;
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
  const auto predict = [&](DevicePredictor* onDevice) {
    return predictValues(seeded.scene(), part.domain(), seeded.cone, {part.seeds, part.hits}, {}, {}, onDevice).values;
  };
  const DeviceDifference difference = differenceOf(seeded, predict(predictor.get()), predict(nullptr));
  CHECK(difference.count > 500);
  CHECK(difference.mean < 1e-6);
  CHECK(difference.farCount <= difference.count / 100);
  CHECK(difference.missingCount <= 2);
}

TEST_CASE("a stop ends a prediction on the device between submissions") {
  const test::ValidatedDevice device;
  const SeededMesh seeded(makeAnimal(2000).mesh, 200);
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone, PredictionBatchSize{100, 200});
  const auto predict = [&](const RunControl& control) {
    return predictValues(seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), {}, {}, predictor.get(),
                         control)
        .values;
  };
  std::vector<double> fractions;
  std::stop_source stop;
  const auto record = [&](double fraction) { fractions.push_back(fraction); };
  const UnsetVector<double> expected = predict({{}, record});
  CHECK(fractions.size() >= 11);
  CHECK(std::ranges::is_sorted(fractions));
  CHECK(fractions.back() == 1);
  fractions.clear();
  const RunControl stopping{stop.get_token(), [&](double fraction) {
                              record(fraction);
                              if (fraction > 0.3) stop.request_stop();
                            }};
  test::requireFailure([&] { (void)predict(stopping); }, ErrorCode::Cancelled);
  CHECK(fractions.back() < 0.6);
  CHECK(test::haveSameBits(predict({}), expected));
}

TEST_CASE("the number of faces of one submission depends on the number of rays") {
  const test::ValidatedDevice device;
  for (const uint32_t rayCount : {1u, 30u, 1024u}) {
    const PredictionBatchSize size = predictionBatchSize({*device, Definition::Paper, rayCount});
    CHECK(size.maxFaceCount * rayCount <= (1u << 23));
    CHECK(size.maxFaceCount >= 8192);
    CHECK(size.maxFaceCount <= (1u << 18));
  }
}

TEST_CASE("the device, too, ignores points on the face itself") {
  const test::ValidatedDevice device;
  SeededMesh seeded(makeSphere(180).mesh, 20, {.falseHitAngleDegrees = 0});  // No hit is false.
  const uint32_t face = seeded.seeds[3];
  for (ConeHit& hit : seeded.hits) hit.face = face;
  const VulkanPredictionKernels kernels = kernelsFor(*device, seeded.cone);
  const auto predictor = makeVulkanPredictor(kernels, seeded.scene(), seeded.cone);
  const UnsetVector<double> values = predictOn(seeded, {}, predictor.get());
  checkClose(differenceOf(seeded, values, predictOn(seeded, {}, nullptr)));
  CHECK(std::isnan(values[face]));
  CHECK(std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }) == 1);
}
