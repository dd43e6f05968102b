#include "estimate/error_estimate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/median.h"
#include "generate/shapes.h"
#include "pipeline/average_error.h"

using namespace asdfvk;
using test::averageError;
using test::referenceSession;

namespace {

void addSeed(Seeds& seeds, uint32_t face, double value) {
  seeds.nodes.push_back(face);
  seeds.kinds.push_back(SeedKind::Sampled);
  seeds.values.push_back(value);
}

struct HeldOut {
  std::vector<uint32_t> faces;
  std::vector<double> weights;
};

/// A mesh without arcs, some of whose faces are seeds. The test sets everything else.
struct SeededFaces {
  explicit SeededFaces(uint32_t faceCount) : values(faceCount), result(faceCount) {
    mesh.faces.resize(faceCount);
    graph.offsets.resize(faceCount + size_t{1}, 0);
  }

  [[nodiscard]] double& tracedAt(uint32_t face) {
    return seeds.values[static_cast<size_t>(std::ranges::find(seeds.nodes, face) - seeds.nodes.begin())];
  }
  [[nodiscard]] EstimatedErrors estimateAt(const FaceDomain& domain) const {
    Seeds marked = seeds;
    std::vector<double> withoutHeldOut;
    for (size_t seed = 0; seed < seeds.size(); ++seed) {
      const auto found = std::ranges::find(heldOut.faces, seeds.nodes[seed]);
      if (found == heldOut.faces.end()) continue;
      marked.kinds[seed] = SeedKind::HeldOut;
      marked.heldOutWeights.push_back(heldOut.weights[static_cast<size_t>(found - heldOut.faces.begin())]);
      withoutHeldOut.push_back(values[seeds.nodes[seed]]);
    }
    return estimateErrors(mesh, domain, {marked, withoutHeldOut, indicator, result});
  }
  [[nodiscard]] EstimatedErrors estimate() {
    EstimatedErrors errors = estimateAt({graph, geometry, {}, 0, {}});
    expected = expectedErrors(errors, seeds, result, indicator);
    return errors;
  }

  Mesh mesh;
  DualGraph graph;
  FaceGeometry geometry;
  Seeds seeds;
  HeldOut heldOut;
  std::vector<double> values, indicator, result;
  UnsetVector<double> expected;  ///< The expected errors of the last estimate.
};

/// Six faces: 0 and 1 are sampled seeds, 2 and 3 are held out; the interpolation without them is off by 1 and by 2.
struct SixFaces : SeededFaces {
  SixFaces() : SeededFaces(6) {
    heldOut = {{2, 3}, {1, 1}};
    values = {0, 10, 5, 8, 5, 5};
    result = {0, 10, 4, 6, 5, 5};
    addSeed(seeds, 0, 0);
    addSeed(seeds, 1, 10);
    addSeed(seeds, 2, 4);
    addSeed(seeds, 3, 6);
  }
};

/// Factor of the errors when the held-out faces, half of the seeds, become seeds.
const double kHalfGain = std::pow(0.5, 0.12);

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("without an indicator every interpolated face has the mean error of held-out faces, less their gain") {
  SixFaces six;
  const EstimatedErrors errors = six.estimate();
  const std::vector<double> expected{0, 0, 0, 0, 1.5 * kHalfGain, 1.5 * kHalfGain};
  REQUIRE(six.expected.size() == 6);
  for (size_t face = 0; face < 6; ++face) CHECK(six.expected[face] == doctest::Approx(expected[face]));
  CHECK(errors.estimate.average == doctest::Approx(kHalfGain * 3.0 / 6 / 10));
  // The standard error of the mean of 1 and 2 is 0.5; it is scaled to two faces of six and the range 10. The gain of
  // the held-out faces has an uncertainty of its own size.
  CHECK(errors.estimate.standardError ==
        doctest::Approx(kHalfGain * std::hypot(0.5, 1.5 * (1 - kHalfGain)) * 2 / 6 / 10));
  CHECK(errors.estimate.heldOutCount == 2);
  REQUIRE(errors.estimate.worstFaces.size() == 2);
  CHECK(errors.estimate.worstFaces[0].face == 3);
  CHECK(errors.estimate.worstFaces[0].error == doctest::Approx(0.2));
  CHECK(errors.estimate.worstFaces[1].face == 2);
  CHECK(errors.estimate.worstFaces[1].error == doctest::Approx(0.1));
}

TEST_CASE("errors are in proportion to the indicator, and a held-out face counts by its weight") {
  SixFaces six;
  six.indicator = {9, 9, 1.5, 3.5, 2.5, 0.5};
  const EstimatedErrors errors = six.estimate();
  CHECK(six.expected[4] == doctest::Approx(kHalfGain * 3.0 / (1.5 + 3.5) * 2.5));
  CHECK(six.expected[5] == doctest::Approx(kHalfGain * 3.0 / (1.5 + 3.5) * 0.5));
  CHECK(six.expected[3] == 0);
  CHECK(errors.estimate.average == doctest::Approx(kHalfGain * 1.8 / 6 / 10));
  // The held-out faces are 0.1 below and above the ratio; the two faces have an indicator of 3, a held-out face 2.5.
  CHECK(errors.estimate.standardError ==
        doctest::Approx(kHalfGain * std::hypot(0.1 / 2.5, 0.6 * (1 - kHalfGain)) * 3 / 6 / 10));

  six.heldOut.weights = {3, 1};
  const EstimatedErrors weighted = six.estimate();
  const double ratio = (3 * 1.0 + 2.0) / (3 * 1.5 + 3.5);
  CHECK(six.expected[4] == doctest::Approx(kHalfGain * ratio * 2.5));
  const double first = 3 * (1 - ratio * 1.5), second = 2 - ratio * 3.5;
  CHECK(weighted.estimate.standardError ==
        doctest::Approx(kHalfGain *
                        std::hypot(std::sqrt(2.0) * std::hypot(first, second) / 8, ratio * (1 - kHalfGain)) * 3 / 6 /
                        10));

  six.heldOut.weights = {1, 0};  // Inclusion probability 1: it represents no other face.
  CHECK(six.estimate().estimate.heldOutCount == 0);
}

TEST_CASE("the estimate has the same bits at any power of two of the unit of length") {
  SixFaces six;
  six.indicator = {9, 9, 1.5, 3.5, 2.5, 0.5};
  six.heldOut.weights = {3, 1};
  const ErrorEstimate expected = six.estimate().estimate;
  for (const double scale : {0x1p500, 0x1p-500, 0x1p1000, 0x1p-1000}) {
    SixFaces scaled = six;
    for (std::vector<double>* lengths : {&scaled.seeds.values, &scaled.values, &scaled.indicator, &scaled.result})
      for (double& length : *lengths) length *= scale;
    const EstimatedErrors errors = scaled.estimate();
    CHECK(scaled.expected[4] == six.expected[4] * scale);
    CHECK(errors.estimate.average == expected.average);
    CHECK(errors.estimate.standardError == expected.standardError);
    CHECK(errors.estimate.robustAverage == expected.robustAverage);
    CHECK(errors.estimate.relativeMedian == expected.relativeMedian);
    CHECK(errors.estimate.worstFaces[0].error == expected.worstFaces[0].error);
  }
}

TEST_CASE("a held-out face of inclusion probability 1 is among the worst faces and stands for no other") {
  SixFaces six;
  six.heldOut = {{2, 3, 1}, {1, 1, 0}};
  six.values[1] = 4;
  const EstimatedErrors errors = six.estimate();
  CHECK(six.expected[4] == doctest::Approx(std::pow(0.25, 0.12) * 1.5));
  CHECK(errors.estimate.heldOutCount == 3);
  REQUIRE(errors.estimate.worstFaces.size() == 3);
  CHECK(errors.estimate.worstFaces[0].face == 1);
  CHECK(errors.estimate.worstFaces[0].error == doctest::Approx(0.6));
}

TEST_CASE("the error of a seed is the difference by which its value was moved") {
  SixFaces six;
  six.result[0] = 1;
  six.result[3] = 5;
  const EstimatedErrors errors = six.estimate();
  CHECK(six.expected[0] == 1);
  CHECK(six.expected[3] == 1);
  CHECK(errors.estimate.average == doctest::Approx((1 + 1 + kHalfGain * (1.5 + 1.5)) / 6 / 10));
}

TEST_CASE("faces without a value have no error, and held-out faces without one do not count") {
  SixFaces six;
  six.values[5] = six.result[5] = kNoValue;
  const EstimatedErrors errors = six.estimate();
  CHECK(six.expected[5] == 0);
  CHECK(errors.estimate.average == doctest::Approx(kHalfGain * 1.5 / 5 / 10));

  six.tracedAt(2) = kNoValue;
  CHECK(six.estimate().estimate.heldOutCount == 0);
}

TEST_CASE("an estimate needs two held-out faces and a positive range") {
  SixFaces one;
  one.heldOut = {{2}, {1}};
  CHECK(one.estimate().estimate.heldOutCount == 0);
  SixFaces flat;
  for (double& value : flat.seeds.values) value = 3;
  CHECK(flat.estimate().estimate.heldOutCount == 0);
}

namespace {

/// 100 faces of the value 10, with a median relative error at the held-out faces 2 .. 5. Faces 0 and 1 are sampled.
struct HundredFaces : SeededFaces {
  HundredFaces() : SeededFaces(100) {
    heldOut = {{2, 3, 4, 5}, {1, 1, 1, 1}};
    values = result = std::vector<double>(100, 10.0);
    for (uint32_t face = 0; face < 6; ++face) addSeed(seeds, face, 10);
    tracedAt(1) = result[1] = 20;
    for (uint32_t face = 2; face < 6; ++face) values[face] = 10 + face;  // 20 to 50 % off.
  }
};

}  // namespace

TEST_CASE("quantiles of the relative error are those of held-out faces by their weights, and of seeds") {
  HundredFaces faces;
  const double gain = std::pow(1 - 4.0 / 6, 0.12);
  // Six faces without an error, then 23.5 faces of each held-out face.
  CHECK(faces.estimate().estimate.relativeMedian == doctest::Approx(0.3 * gain));
  CHECK(faces.estimate().estimate.relativePercentile90 == doctest::Approx(0.5 * gain));
  CHECK(faces.estimate().estimate.relativeMedianStandardError > 0);
  faces.heldOut.weights = {8, 1, 0.6, 0.4};
  CHECK(faces.estimate().estimate.relativeMedian == doctest::Approx(0.2 * gain));
  CHECK(faces.estimate().estimate.relativePercentile90 == doctest::Approx(0.3 * gain));
  // Half of the faces are seeds.
  for (uint32_t face = 6; face < 52; ++face) addSeed(faces.seeds, face, 10);
  CHECK(faces.estimate().estimate.relativeMedian == 0);
  CHECK(faces.estimate().estimate.relativeMedianStandardError == 0);
  CHECK(faces.estimate().estimate.relativePercentile90 > 0);
}

TEST_CASE("values of seeds that were moved have a relative error, infinite where the traced value is 0") {
  HundredFaces faces;
  for (uint32_t face = 6; face < 70; ++face) addSeed(faces.seeds, face, 10);
  CHECK(faces.estimate().estimate.relativeMedian == 0);
  for (uint32_t face = 6; face < 70; ++face) faces.result[face] = 10.5;
  CHECK(faces.estimate().estimate.relativeMedian == doctest::Approx(0.05));
  for (uint32_t face = 6; face < 70; ++face) faces.tracedAt(face) = 0;
  CHECK(faces.estimate().estimate.relativePercentile90 == std::numeric_limits<double>::infinity());
}

TEST_CASE("the robust average is over the range without one percent of the values at each end") {
  HundredFaces faces;
  for (uint32_t face = 0; face < 100; ++face) faces.result[face] = 10 + 0.01 * face;
  for (uint32_t face = 0; face < 6; ++face) faces.result[face] = faces.tracedAt(face);
  faces.tracedAt(1) = faces.result[1] = 1010;
  const ErrorEstimate estimate = faces.estimate().estimate;
  // 1000 and 0.98: from the second to the last but one of the values 10, ..., 10.99, 1010.
  CHECK(estimate.robustAverage / estimate.average == doctest::Approx(1000 / 0.99).epsilon(0.02));
  CHECK(estimate.average < 0.01);
  CHECK(estimate.robustAverage > 1);
}

TEST_CASE("a node stands for the faces that get its value, seeds included") {
  SixFaces six;
  six.indicator = {9, 9, 1.5, 3.5, 2.5, 0.5};
  const std::vector<uint32_t> counts{3, 1, 1, 2, 4, 1};
  const EstimatedErrors errors = six.estimateAt({six.graph, six.geometry, {}, 0, {}, {}, counts});
  const double ratio = kHalfGain * 3.0 / (1.5 + 3.5), indicatorSum = 2 * 9 + 3.5 + 4 * 2.5 + 0.5;
  CHECK(errors.perIndicator == doctest::Approx(ratio));
  CHECK(errors.average == doctest::Approx(ratio * indicatorSum / 12));
  CHECK(errors.estimate.average == doctest::Approx(ratio * indicatorSum / 12 / 10));
}

TEST_CASE("no more than five worst faces, by their number in the file") {
  SeededFaces twenty(20);
  twenty.mesh.polygons.firstCorner.resize(11);
  for (uint32_t face = 0; face < 20; ++face) twenty.mesh.polygons.inputFaceOf.push_back(face / 2);
  addSeed(twenty.seeds, 0, 0);
  for (uint32_t face = 6; face < 20; ++face) {
    addSeed(twenty.seeds, face, face);
    twenty.heldOut.faces.push_back(face);
    twenty.heldOut.weights.push_back(1);
  }
  twenty.values.assign(20, 6.0);
  std::iota(twenty.result.begin(), twenty.result.end(), 0.0);
  const EstimatedErrors errors = twenty.estimate();
  REQUIRE(errors.estimate.worstFaces.size() == 5);
  CHECK(errors.estimate.worstFaces[0].face == 9);  // Triangle 19.
  CHECK(errors.estimate.worstFaces[1].face == 9);
  CHECK(errors.estimate.worstFaces[2].face == 8);
  for (size_t i = 1; i < 5; ++i) CHECK(errors.estimate.worstFaces[i].error < errors.estimate.worstFaces[i - 1].error);
}

namespace {

/// Over several random seeds.
struct Accuracy {
  double ratio = 0;      ///< Mean of estimate / real error.
  double deviation = 0;  ///< Root mean square of the error of the estimate, in standard errors.
  double median = 0, percentile90 = 0, robust = 0;  ///< Means of estimate / real error.
  double medianDeviation = 0;                       ///< The same value as `deviation`, for the estimated median.
};

Accuracy accuracyOf(const std::string& shape, Options options) {
  options.seeds = SeedCount::ofShare(0.1);
  const Mesh mesh = generateShape(shape, 3000).mesh;
  const std::vector<double> truth = test::tracedEverywhere(mesh, options.cone);
  std::vector<double> sorted = truth;
  const double range = percentileOf(sorted, 1) - percentileOf(sorted, 0),
               robustRange = percentileOf(sorted, 0.99) - percentileOf(sorted, 0.01);
  constexpr int kRunCount = 8;
  Accuracy accuracy;
  for (int run = 1; run <= kRunCount; ++run) {
    options.randomSeed = static_cast<uint64_t>(run);
    const Result result = referenceSession().compute(mesh, options);
    REQUIRE(result.report.estimatedError);
    const ErrorEstimate& estimate = *result.report.estimatedError;
    const double real = averageError(result.sdf(), truth);
    const double median = test::relativeErrorAt(0.5, result.sdf(), truth);
    accuracy.ratio += estimate.average / real / kRunCount;
    accuracy.deviation += std::pow((estimate.average - real) / estimate.standardError, 2) / kRunCount;
    accuracy.median += estimate.relativeMedian / median / kRunCount;
    accuracy.medianDeviation +=
        std::pow((estimate.relativeMedian - median) / estimate.relativeMedianStandardError, 2) / kRunCount;
    accuracy.percentile90 +=
        estimate.relativePercentile90 / test::relativeErrorAt(0.9, result.sdf(), truth) / kRunCount;
    accuracy.robust += estimate.robustAverage / (real * range / robustRange) / kRunCount;
    CHECK(estimate.heldOutCount == result.report.seedCount / 4);
  }
  accuracy.deviation = std::sqrt(accuracy.deviation);
  accuracy.medianDeviation = std::sqrt(accuracy.medianDeviation);
  MESSAGE(shape, ": estimate over real error ", accuracy.ratio, ", off by ", accuracy.deviation,
          " standard errors; median ", accuracy.median, ", off by ", accuracy.medianDeviation, "; 90th percentile ",
          accuracy.percentile90, "; robust ", accuracy.robust);
  return accuracy;
}

}  // namespace

TEST_CASE("the estimate is right on average, and its standard error is that of its errors") {
  Options balanced, paper, random, quality;
  applyRecipe(Recipe::Paper, paper);
  applyRecipe(Recipe::Paper, random);
  random.interpolation.guidance = Guidance::None;
  applyRecipe(Recipe::Quality, quality);
  for (const Options& options : {balanced, paper, random, quality})
    for (const std::string shape : {"animal", "hand"}) {
      const Accuracy accuracy = accuracyOf(shape, options);
      CHECK(accuracy.ratio > 0.8);
      CHECK(accuracy.ratio < 1.25);
      CHECK(accuracy.deviation > 0.2);
      CHECK(accuracy.deviation < 2.5);
      CHECK(accuracy.median > 0.8);
      CHECK(accuracy.median < 1.25);
      CHECK(accuracy.medianDeviation > 0.2);
      CHECK(accuracy.medianDeviation < 2.5);
      CHECK(accuracy.percentile90 > 0.8);
      CHECK(accuracy.percentile90 < 1.25);
      CHECK(accuracy.robust > 0.8);
      CHECK(accuracy.robust < 1.25);
    }
}

TEST_CASE("seeds have an expected error of 0, and the mean of the expected errors is the estimate") {
  const Mesh mesh = makeAnimal(3000).mesh;
  const Result result = referenceSession().compute(mesh, test::tenthOfFaces());
  REQUIRE(result.report.estimatedError);
  const std::vector<double>& expected = test::expectedErrors(result);
  REQUIRE(expected.size() == result.sdf().size());
  for (size_t face = 0; face < result.sdf().size(); ++face) CHECK((expected[face] == 0) == (result.seed()[face] == 1));
  double low = 1e30, high = -1e30;
  for (size_t face = 0; face < result.sdf().size(); ++face)
    if (result.seed()[face]) low = std::min(low, result.sdf()[face]), high = std::max(high, result.sdf()[face]);
  CHECK(meanOf(expected) / (high - low) == doctest::Approx(result.report.estimatedError->average).epsilon(1e-9));

  Options pooled = test::tenthOfFaces();
  applyRecipe(Recipe::Quality, pooled);
  const Result moved = referenceSession().compute(mesh, pooled);
  size_t movedSeedCount = 0;
  for (size_t face = 0; face < moved.sdf().size(); ++face)
    movedSeedCount += moved.seed()[face] == 1 && test::expectedErrors(moved)[face] > 0;
  CHECK(movedSeedCount > moved.report.seedCount * 9 / 10);
}

TEST_CASE("expected errors are large where errors are large") {
  const Mesh mesh = makeAnimal(3000).mesh;
  const std::vector<double> truth = test::tracedEverywhere(mesh);
  const Result result = referenceSession().compute(mesh, test::tenthOfFaces());
  const std::vector<double>& expected = test::expectedErrors(result);
  std::vector<size_t> faces;
  for (size_t face = 0; face < truth.size(); ++face)
    if (!result.seed()[face]) faces.push_back(face);
  std::sort(faces.begin(), faces.end(), [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  double low = 0, high = 0;
  const size_t half = faces.size() / 2;
  for (size_t i = 0; i < 2 * half; ++i) (i < half ? low : high) += std::abs(result.sdf()[faces[i]] - truth[faces[i]]);
  CHECK(high > 1.3 * low);
}

TEST_CASE("there is no estimate without a request, where every face is a seed and where there is one seed") {
  const Mesh mesh = makeTorus(1000).mesh;
  Options unrequested, all, one;
  unrequested.estimatesError = false;
  all.seeds = SeedCount::all();
  one.seeds = SeedCount::ofCount(1);
  for (const Options& options : {unrequested, all, one}) {
    const Result result = referenceSession().compute(mesh, options);
    CHECK_FALSE(result.report.estimatedError.has_value());
    CHECK(result.field("error") == nullptr);
    CHECK(result.report.noValueCount == 0);
  }
}
