#include "segment/cgal_postprocess.h"

#include <doctest/doctest.h>

#include <cmath>

#include "sample_problems.h"
#include "support/require_failure.h"

using namespace asdfvk;

namespace {

using Values = std::vector<double>;
constexpr double kMissing = kNoValue;

// The definition in cgal_postprocess.h, written out: distances by relaxation over the whole mesh.
double definedValue(const FaceNeighbours& neighbours, const Values& values, uint32_t face, uint32_t ringCount) {
  std::vector<uint32_t> ringOf(values.size(), ~0u);
  ringOf[face] = 0;
  for (uint32_t ring = 0; ring < ringCount; ++ring)
    for (uint32_t f = 0; f < values.size(); ++f)
      if (ringOf[f] == ring)
        for (const uint32_t g : neighbours[f])
          if (g != kNoNeighbour && ringOf[g] == ~0u) ringOf[g] = ring + 1;
  double squares = 0, count = 0, weights = 0, sum = 0;
  for (uint32_t f = 0; f < values.size(); ++f)
    if (ringOf[f] != ~0u) {
      squares += std::pow(values[f] - values[face], 2);
      ++count;
    }
  const double sigma = 1.5 * std::sqrt(squares / count);
  for (uint32_t f = 0; f < values.size(); ++f)
    if (ringOf[f] != ~0u) {
      const double weight = std::exp(-std::pow(ringOf[f] / (ringCount / 2.0), 2) / 2) *
                            std::exp(-std::pow((values[f] - values[face]) / sigma, 2) / 2);
      weights += weight;
      sum += weight * values[f];
    }
  return sum / weights;
}

}  // namespace

TEST_CASE("a missing value becomes the mean of its neighbours") {
  CHECK(fillMissingValues(test::stripNeighbours(4), Values{1, kMissing, 4, 0}) == Values{1, 2.5, 4, 0});
}

TEST_CASE("missing values are filled in the order of the faces, in place") {
  // Face 1 sees face 0 only, face 2 sees the new value of face 1 and face 3.
  CHECK(fillMissingValues(test::stripNeighbours(4), Values{2, kMissing, kMissing, 6}) == Values{2, 2, 4, 6});
  // Face 0 has no neighbour with a value when its turn comes, so it becomes the least value.
  CHECK(fillMissingValues(test::stripNeighbours(4), Values{kMissing, kMissing, 5, 3}) == Values{3, 5, 5, 3});
}

TEST_CASE("a face without any neighbour becomes the least value") {
  FaceNeighbours neighbours = test::stripNeighbours(3);
  neighbours.push_back({kNoNeighbour, kNoNeighbour, kNoNeighbour});
  CHECK(fillMissingValues(neighbours, Values{4, 2, 3, kMissing}) == Values{4, 2, 3, 2});
}

TEST_CASE("a neighbour across several edges counts as often") {
  const FaceNeighbours neighbours{{1, 1, 2}, {0, 0, kNoNeighbour}, {0, kNoNeighbour, kNoNeighbour}};
  CHECK(fillMissingValues(neighbours, Values{kMissing, 3, 6}) == Values{4, 3, 6});
}

TEST_CASE("two faces have the filtered values computed by hand") {
  // Window of one ring: sigma of the rings .5; root mean square of the differences 0 and 2: sqrt 2.
  const double weight = std::exp(-2.0) * std::exp(-std::pow(2 / (1.5 * std::sqrt(2.0)), 2) / 2);
  const Values filtered = filterLikeCgal(test::stripNeighbours(2), Values{1, 3});
  CHECK(filtered[0] == doctest::Approx((1 + 3 * weight) / (1 + weight)).epsilon(1e-15));
  CHECK(filtered[1] == doctest::Approx((3 + 1 * weight) / (1 + weight)).epsilon(1e-15));
}

TEST_CASE("every face has the filtered value of the definition; the window grows with the number of faces") {
  for (const uint64_t faceCount : {600u, 2500u, 9000u}) {
    const test::SampleMesh sample = test::sampleMesh("torus", faceCount, 1);
    const auto ringCount = static_cast<uint32_t>(std::floor(std::sqrt(sample.mesh.faceCount() / 2000.0))) + 1;
    const Values filtered = filterLikeCgal(sample.neighbours, sample.values);
    for (uint32_t face = 0; face < filtered.size(); face += 17)
      REQUIRE(filtered[face] ==
              doctest::Approx(definedValue(sample.neighbours, sample.values, face, ringCount)).epsilon(1e-13));
  }
}

TEST_CASE("values are mapped to [0, 1], the ends are returned") {
  const test::SampleMesh sample = test::sampleMesh("animal", 1000);
  Values values = sample.values;
  for (double& value : values) value = 3 + 5 * value;
  for (size_t face = 0; face < values.size(); face += 13) values[face] = kMissing;
  const CgalValues result = postprocessLikeCgal(sample.neighbours, values);
  const Values filtered = filterLikeCgal(sample.neighbours, fillMissingValues(sample.neighbours, values));
  CHECK(result.min == *std::min_element(filtered.begin(), filtered.end()));
  CHECK(result.max == *std::max_element(filtered.begin(), filtered.end()));
  CHECK(*std::min_element(result.normalized.begin(), result.normalized.end()) == 0);
  CHECK(*std::max_element(result.normalized.begin(), result.normalized.end()) == 1);
  for (size_t face = 0; face < values.size(); ++face)
    REQUIRE(result.min + result.normalized[face] * (result.max - result.min) ==
            doctest::Approx(filtered[face]).epsilon(1e-14));
}

TEST_CASE("all values equal: they stay as they are") {
  const test::SampleMesh sample = test::sampleMesh("torus", 600);
  const Values equal(sample.mesh.faceCount(), 0.3);
  const CgalValues result = postprocessLikeCgal(sample.neighbours, equal);
  CHECK(result.normalized == equal);
  CHECK(result.min == 0.3);
  CHECK(result.max == 0.3);
}

TEST_CASE("one face keeps its value; two faces become 0 and 1") {
  CHECK(postprocessLikeCgal(test::stripNeighbours(1), Values{7}).normalized == Values{7});
  CHECK(postprocessLikeCgal(test::stripNeighbours(2), Values{7, 5}).normalized == Values{1, 0});
  CHECK(postprocessLikeCgal(test::stripNeighbours(2), Values{7, kMissing}).normalized == Values{7, 7});
}

TEST_CASE("an empty mesh and a mesh without any value are refused") {
  test::requireFailure([] { static_cast<void>(postprocessLikeCgal({}, {})); }, ErrorCode::NoValues);
  test::requireFailure([] { static_cast<void>(postprocessLikeCgal(test::stripNeighbours(3), Values(3, kMissing))); },
                       ErrorCode::NoValues, "no face has a value");
}

TEST_CASE("post-processed values have the same bits on any number of threads") {
  const test::SampleMesh sample = test::sampleMesh("hand", 20'000);
  const auto values = [&] { return postprocessLikeCgal(sample.neighbours, sample.values).normalized; };
  const Values alone = test::onThreads(1, values);
  for (const size_t count : {2u, 4u}) CHECK(test::onThreads(count, values) == alone);
}

TEST_CASE("filtered values have the same bits with every instruction set and in every order of the faces") {
  const test::SampleMesh sample = test::sampleMesh("hand", 20'000);
  const Values values = filterLikeCgal(sample.neighbours, sample.values, {}, InstructionSet::Baseline);
  // Within a rounding error where the C library has another exp().
  for (const InstructionSet instructionSet : {InstructionSet::Avx2, InstructionSet::Avx512})
    if (hasInstructionSet(instructionSet)) {
      const Values wide = filterLikeCgal(sample.neighbours, sample.values, {}, instructionSet);
#ifdef __GLIBC__
      CHECK(wide == values);
#endif
      for (size_t face = 0; face < values.size(); ++face)
        REQUIRE(wide[face] == doctest::Approx(values[face]).epsilon(1e-14));
    }
  const auto faceCount = static_cast<uint32_t>(values.size());
  FaceNeighbours reversed(faceCount);
  Values reversedValues(faceCount);
  for (uint32_t face = 0; face < faceCount; ++face) {
    reversedValues[faceCount - 1 - face] = sample.values[face];
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t neighbour = sample.neighbours[face][i];
      reversed[faceCount - 1 - face][i] = neighbour == kNoNeighbour ? kNoNeighbour : faceCount - 1 - neighbour;
    }
  }
  Values filtered = filterLikeCgal(reversed, reversedValues);
  std::reverse(filtered.begin(), filtered.end());
  CHECK(filtered == filterLikeCgal(sample.neighbours, sample.values));
}

TEST_CASE("an outlier in a large window, whose weight is below exp(-512), is filtered by the definition") {
  constexpr uint32_t kFaceCount = 200'000, kRingCount = 11;
  FaceNeighbours tree(kFaceCount);  // Binary, so that the window of face 0 has 4095 faces.
  for (uint32_t face = 0; face < kFaceCount; ++face) {
    tree[face][0] = face == 0 ? kNoNeighbour : (face - 1) / 2;
    for (uint32_t i = 1; i < 3; ++i) tree[face][i] = 2 * face + i < kFaceCount ? 2 * face + i : kNoNeighbour;
  }
  Values values(kFaceCount, 0.25);
  values[1] = 1;
  values[2] = 0.26;
  CHECK(filterLikeCgal(tree, values)[0] == doctest::Approx(definedValue(tree, values, 0, kRingCount)).epsilon(1e-14));
}
