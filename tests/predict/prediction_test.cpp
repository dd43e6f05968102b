#include "predict/prediction.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "cone/cone_value.h"
#include "generate/shapes.h"
#include "predict/seeded_mesh.h"
#include "support/bits.h"
#include "support/shapes.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

UnsetVector<double> predict(const SeededMesh& seeded, const PredictionOptions& options = {}) {
  return predictValues(seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), options).values;
}

/// Mean and maximum of |a - b| / b over the chosen faces that are not seeds.
struct Difference {
  double mean = 0, worst = 0;
  size_t count = 0;
};

template <typename Exact, typename Choose>
Difference differenceTo(const SeededMesh& seeded, std::span<const double> values, const Exact& exact,
                        const Choose& isChosen) {
  Difference difference;
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (std::find(seeded.seeds.begin(), seeded.seeds.end(), face) != seeded.seeds.end() || !isChosen(face)) continue;
    const double error = std::abs(values[face] - exact(face)) / exact(face);
    REQUIRE(std::isfinite(error));
    difference.mean += error;
    difference.worst = std::max(difference.worst, error);
    ++difference.count;
  }
  difference.mean /= static_cast<double>(difference.count);
  return difference;
}

/// A ray of a convex shape: the length of its chord and the cosine of the angle between the normals at its ends. Rays
/// are given by their direction in the frame of the face, z inwards.
struct Chord {
  double length = 0, facing = 0;
};

template <typename ChordOf>
double coneValueOf(const Cone& cone, const ChordOf& chordOf) {
  std::vector<double> lengths, weights;
  for (size_t ray = 0; ray < cone.directions.size(); ++ray) {
    const Chord chord = chordOf(cone.directions[ray]);
    if (chord.facing > cone.falseHitCosine) continue;
    lengths.push_back(chord.length);
    weights.push_back(cone.weights[ray]);
  }
  return coneValue(lengths, weights, cone.outliers);
}

Chord chordOfUnitSphere(const Vec3d& direction) { return {2 * direction.z, 1 - 2 * direction.z * direction.z}; }

const auto kAnyFace = [](uint32_t) { return true; };

}  // namespace

TEST_CASE("on a sphere predictions are close to the value of its chords") {
  const SeededMesh seeded(makeSphere(2000).mesh, 100);
  const double exact = coneValueOf(seeded.cone, chordOfUnitSphere);
  const Difference error = differenceTo(
      seeded, predict(seeded), [&](uint32_t) { return exact; }, kAnyFace);
  CHECK(error.count == 1900);
  CHECK(error.mean < 0.02);
  CHECK(error.worst < 0.06);
}

TEST_CASE("between two walls, away from the rim, predictions are close to the exact value") {
  const SeededMesh seeded(makeSlab(3000, 2, 0.2).mesh, 300);
  const double exact = coneValueOf(seeded.cone, [](const Vec3d& d) { return Chord{0.2 / d.z, -1}; });
  const auto isInside = [&](uint32_t face) {
    const Vec3d& centre = seeded.geometry.barycentres[face];
    return std::max(std::abs(centre.x), std::abs(centre.y)) < 0.5;
  };
  const Difference error = differenceTo(
      seeded, predict(seeded), [&](uint32_t) { return exact; }, isInside);
  CHECK(error.count > 500);
  // A bias of a few percent: the ray along the axis is an outlier of the face's own cone but not of the next seed's.
  CHECK(error.mean < 0.07);
  CHECK(error.worst < 0.13);
}

TEST_CASE("on a long cylinder, away from the caps, predictions are close to the value of its chords") {
  const SeededMesh seeded(makeCylinder(4000).mesh, 400);
  // Which rays are along the axis of the cylinder depends on the tangent of the frame, so on the face.
  const auto exact = [&](uint32_t face) {
    const Vec3d& normal = seeded.geometry.normals[face];
    const ConeFrame frame = paperConeFrame(seeded.cone, normal, face);
    return coneValueOf(seeded.cone, [&](const Vec3d& d) {
      const Vec3d direction = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
      const double chord = 2 * 0.25 * -dot(direction, normal) / (1 - direction.z * direction.z);
      return Chord{chord, 1 + chord / 0.25 * dot(direction, normal)};
    });
  };
  const auto isInside = [&](uint32_t face) { return std::abs(seeded.geometry.barycentres[face].z) < 1; };
  const Difference error = differenceTo(seeded, predict(seeded), exact, isInside);
  CHECK(error.count > 1000);
  CHECK(error.mean < 0.05);
  CHECK(error.worst < 0.15);
}

TEST_CASE("predictions are closer to the traced values than the values of the seeds of the cells are") {
  for (const std::string name : {"animal", "hand"}) {
    CAPTURE(name);
    const SeededMesh seeded(generateShape(name, 4000).mesh, 400);
    const SeedCells cells = seeded.cells();
    std::vector<double> seedValues(seeded.mesh.faceCount());
    for (uint32_t face = 0; face < seedValues.size(); ++face) seedValues[face] = seeded.values[cells.cellOf[face]];
    const UnsetVector<double> predicted = predict(seeded);
    double predictedError = 0, copiedError = 0;
    for (uint32_t face = 0; face < predicted.size(); ++face) {
      const double exact = seeded.tracedValue(face);
      predictedError += std::abs(predicted[face] - exact);
      copiedError += std::abs(seedValues[face] - exact);
    }
    CHECK(predictedError < 0.7 * copiedError);
  }
}

TEST_CASE("predictions have the same bits on any number of threads") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const UnsetVector<double> many = predict(seeded);
  for (const size_t threadCount : {size_t{1}, size_t{2}}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
    CHECK(test::haveSameBits(predict(seeded), many));
  }
}

TEST_CASE("predictions scale with the mesh and do not change when it is shifted") {
  const Mesh mesh = makeAnimal(2000).mesh;
  const UnsetVector<double> expected = predict(SeededMesh(mesh, 150));
  // A power of two preserves every mantissa. Other factors change last bits, and with them rays that graze an edge and
  // lengths at the limits of an outlier window.
  const struct {
    double scale;
    Vec3d shift;
    bool sameBits;
  } cases[] = {{0.125, {0, 0, 0}, true},
               {std::ldexp(1, -500), {0, 0, 0}, true},
               {std::ldexp(1, 500), {0, 0, 0}, true},
               {1e-160, {0, 0, 0}, false},
               {10, {300, -200, 500}, false}};
  for (const auto& [size, shift, isExact] : cases) {
    const double scale = size;
    CAPTURE(scale);
    UnsetVector<double> values = predict(SeededMesh(shapes::scaledAndShifted(mesh, scale, shift), 150));
    for (double& value : values) value /= scale;
    if (isExact) {
      CHECK(test::haveSameBits(values, expected));
      continue;
    }
    double error = 0;
    for (size_t face = 0; face < values.size(); ++face) {
      REQUIRE(std::isnan(values[face]) == std::isnan(expected[face]));
      if (!std::isnan(values[face])) error += std::abs(values[face] - expected[face]) / expected[face];
    }
    CHECK(error / static_cast<double>(values.size()) < 2e-3);
  }
}

TEST_CASE("degenerate faces and faces of components without a seed have no prediction, the others have one") {
  Mesh mesh = shapes::joined(makeSphere(500).mesh, makeSphere(180).mesh, {4, 0, 0});
  const Face first = mesh.faces[0];
  mesh.faces.push_back({first[0], first[0], first[1]});
  SeededMesh seeded(mesh, 680);
  // 40 seeds on the first sphere, none on the second.
  std::vector<uint32_t> seeds;
  std::vector<ConeHit> hits;
  const size_t rayCount = seeded.cone.directions.size();
  for (size_t i = 0; i < seeded.seeds.size() && seeds.size() < 40; ++i) {
    if (seeded.seeds[i] >= 500) continue;
    seeds.push_back(seeded.seeds[i]);
    hits.insert(hits.end(), seeded.hits.begin() + static_cast<std::ptrdiff_t>(i * rayCount),
                seeded.hits.begin() + static_cast<std::ptrdiff_t>((i + 1) * rayCount));
  }
  seeded.seeds = seeds;
  seeded.hits = hits;
  const UnsetVector<double> values = predict(seeded);
  REQUIRE(values.size() == mesh.faces.size());
  for (uint32_t face = 0; face < 500; ++face) CHECK(std::isfinite(values[face]));
  for (uint32_t face = 500; face < values.size(); ++face) CHECK(std::isnan(values[face]));
}

TEST_CASE("predictions on an open mesh are positive and at most the diagonal, or missing") {
  Mesh mesh = makeAnimal(3000).mesh;
  std::erase_if(mesh.faces, [&](const Face& face) { return mesh.vertices[face[0]].x > 0.3; });
  const SeededMesh seeded(mesh, 300);
  size_t count = 0;
  for (const double value : predict(seeded)) {
    if (std::isnan(value)) continue;
    ++count;
    CHECK(value > 0);
    CHECK(value < length(seeded.geometry.bounds.max - seeded.geometry.bounds.min));
  }
  CHECK(count > mesh.faces.size() / 2);

  const SeededMesh flat({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {}}, 2);
  for (const double value : predict(flat)) CHECK(std::isnan(value));
}

TEST_CASE("a single seed predicts its component") {
  const SeededMesh seeded(makeSphere(500).mesh, 1);
  const UnsetVector<double> values = predict(seeded);
  CHECK(std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }) > 100);
  CHECK(values[seeded.seeds[0]] == doctest::Approx(seeded.values[0]).epsilon(0.03));
}

TEST_CASE("values with unchanged contributing seeds are copied from the earlier prediction, and no others") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const PredictionOptions options;
  std::vector<uint32_t> fewer = seeded.seeds;
  for (size_t i = 0; i < fewer.size(); i += 40) fewer[i] = kNoFace;
  const auto predictFrom = [&](const std::vector<uint32_t>& seeds, Prediction earlier) {
    return predictValues(seeded.scene(), seeded.domain(), seeded.cone, {seeds, seeded.hits}, options,
                         std::move(earlier));
  };
  const Prediction few = predictFrom(fewer, {}), all = predictFrom(seeded.seeds, {});
  CHECK_FALSE(test::haveSameBits(few.values, all.values));
  CHECK(test::haveSameBits(predictFrom(seeded.seeds, few).values, all.values));
  CHECK(test::haveSameBits(predictFrom(fewer, all).values, few.values));
  // -1 marks values that are copied.
  Prediction marked = few;
  for (double& value : marked.values) value = -1;
  const UnsetVector<double> values = predictFrom(seeded.seeds, marked).values;
  size_t takenCount = 0;
  for (size_t face = 0; face < values.size(); ++face) {
    takenCount += values[face] == -1;
    if (values[face] == -1) CHECK((few.values[face] == all.values[face] || std::isnan(all.values[face])));
  }
  CHECK(takenCount > values.size() / 4);
  CHECK(takenCount < values.size());
}

TEST_CASE("seeds marked with kNoFace are ignored") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 200);
  std::vector<uint32_t> leftOut = seeded.seeds, used;
  std::vector<ConeHit> usedHits;
  const size_t rayCount = seeded.cone.directions.size();
  for (size_t i = 0; i < leftOut.size(); ++i) {
    if (i % 5 == 2) {
      leftOut[i] = kNoFace;
      continue;
    }
    used.push_back(leftOut[i]);
    const auto first = seeded.hits.begin() + static_cast<std::ptrdiff_t>(i * rayCount);
    usedHits.insert(usedHits.end(), first, first + static_cast<std::ptrdiff_t>(rayCount));
  }
  const auto predictFrom = [&](const std::vector<uint32_t>& seeds, const std::vector<ConeHit>& hits) {
    return predictValues(seeded.scene(), seeded.domain(), seeded.cone, {seeds, hits}, {}).values;
  };
  CHECK(test::haveSameBits(predictFrom(leftOut, seeded.hits), predictFrom(used, usedHits)));
}

TEST_CASE("there is one value per face without seeds, and with every face a seed") {
  SeededMesh none(makeSphere(180).mesh, 0);
  for (const double value : predict(none)) CHECK(std::isnan(value));
  const SeededMesh all(makeSphere(180).mesh, 180);
  for (const double value : predict(all)) CHECK(std::isfinite(value));
}

TEST_CASE("more neighbours reduce the noise of the predictions") {
  const SeededMesh seeded(makeSphere(2000).mesh, 200);
  const double exact = coneValueOf(makeCone({.rayCount = 1000}), chordOfUnitSphere);
  const auto error = [&](uint32_t neighbourCount) {
    return differenceTo(
        seeded, predict(seeded, {.neighbourCount = neighbourCount}), [&](uint32_t) { return exact; }, kAnyFace);
  };
  CHECK(error(6).mean < error(0).mean);
}

TEST_CASE(
    "a face that moves to another cell is predicted again, even if the contributing seeds of that cell are unchanged") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  std::vector<uint32_t> fewer = seeded.seeds;
  for (size_t i = 0; i < fewer.size(); i += 10) fewer[i] = kNoFace;
  for (const uint32_t neighbourCount : {0u, 1u}) {
    CAPTURE(neighbourCount);
    const auto predictFrom = [&](const std::vector<uint32_t>& seeds, Prediction earlier) {
      return predictValues(seeded.scene(), seeded.domain(), seeded.cone, {seeds, seeded.hits},
                           {.neighbourCount = neighbourCount}, std::move(earlier));
    };
    const Prediction all = predictFrom(seeded.seeds, {}), few = predictFrom(fewer, {});
    size_t movedCount = 0;  // To a cell with unchanged contributing seeds, and with another value.
    for (uint32_t face = 0; face < few.values.size(); ++face) {
      const uint32_t cell = few.cellOf[face];
      movedCount += cell != kNoCell && cell != all.cellOf[face] && few.values[face] != all.values[face] &&
                    std::ranges::equal(few.nearest.of(cell), all.nearest.of(cell));
    }
    CHECK(movedCount > 10);
    CHECK(test::haveSameBits(predictFrom(fewer, all).values, few.values));
    CHECK(test::haveSameBits(predictFrom(seeded.seeds, few).values, all.values));
  }
}

TEST_CASE("added seeds have cells of the faces that are nearer to them, and other values do not change") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  std::vector<uint32_t> fewer = seeded.seeds;
  for (size_t i = 0; i < fewer.size(); i += 10) fewer[i] = kNoFace;
  fewer.resize(290);
  const std::span<const ConeHit> fewerHits = std::span(seeded.hits).first(fewer.size() * seeded.cone.directions.size());
  const Prediction before =
      predictValues(seeded.scene(), seeded.domain(), seeded.cone, {fewer, fewerHits}, PredictionOptions());
  const Prediction after =
      withFurtherSeeds(before, seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), {});
  CHECK(after.nearest.cellCount() == 300);
  UnsetVector<double> unclaimed = after.values;
  for (uint32_t face = 0; face < unclaimed.size(); ++face)
    if (after.cellOf[face] != before.cellOf[face]) unclaimed[face] = before.values[face];
  CHECK(test::haveSameBits(unclaimed, before.values));
  const auto squaredDistance = [&](uint32_t face, uint32_t cell) {
    const Vec3d between = seeded.geometry.barycentres[face] - seeded.geometry.barycentres[seeded.seeds[cell]];
    return dot(between, between);
  };
  const auto isNew = [&](uint32_t cell) { return cell % 10 == 0 || cell >= 290; };
  std::vector<uint32_t> claimed;
  for (uint32_t face = 0; face < seeded.mesh.faces.size(); ++face) {
    const uint32_t cell = after.cellOf[face];
    if (cell == before.cellOf[face]) continue;
    claimed.push_back(face);
    CHECK(isNew(cell));
    if (face != seeded.seeds[cell]) CHECK(squaredDistance(face, cell) < squaredDistance(face, before.cellOf[face]));
  }
  CHECK(claimed.size() > 30);
  for (uint32_t cell = 0; cell < 300; ++cell) {
    CHECK(after.cellOf[seeded.seeds[cell]] == cell);
    CHECK(after.nearest.of(cell)[0] == cell);
  }
  // The values are those of a prediction whose cells are these.
  double error = 0, earlierError = 0;
  for (const uint32_t face : claimed) {
    const double traced = seeded.tracedValue(face), earlier = before.values[face];
    if (std::isnan(traced) || std::isnan(earlier) || std::isnan(after.values[face])) continue;
    error += std::abs(after.values[face] - traced);
    earlierError += std::abs(earlier - traced);
  }
  CHECK(error < 0.95 * earlierError);
}

TEST_CASE("faces as far from an added seed as from their own are claimed alike in every unit") {
  std::vector<UnsetVector<uint32_t>> cells;
  for (const double unit : {1.0, 0.001, 25.4, 1 + 1e-13}) {
    const SeededMesh seeded(shapes::scaledAndShifted(shapes::box({3, 2, 1}, 20), unit), 300);
    std::vector<uint32_t> fewer = seeded.seeds;
    for (size_t i = 0; i < fewer.size(); i += 4) fewer[i] = kNoFace;
    const Prediction before =
        predictValues(seeded.scene(), seeded.domain(), seeded.cone, {fewer, seeded.hits}, PredictionOptions());
    cells.push_back(
        withFurtherSeeds(before, seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), {}).cellOf);
    CHECK(cells.back() != before.cellOf);
    CHECK(cells.back() == cells.front());
  }
}

TEST_CASE("a domain of all faces in another order of memory, and a part of the faces, have the values of the faces") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  std::vector<uint32_t> every(seeded.mesh.faceCount());
  std::iota(every.begin(), every.end(), 0u);
  const FaceGeometry gathered = geometryOf(seeded.geometry, every);
  const FaceDomain named{seeded.graph, gathered, {}, 0, {}, every};
  CHECK(test::haveSameBits(predictValues(seeded.scene(), named, seeded.cone, seeded.seedHits(), {}).values,
                           predict(seeded)));
  // Faces next to other cells have fewer neighbouring seeds.
  const uint32_t firstSeed = 100;
  const test::SeededPart part(seeded, firstSeed);
  const Prediction ofPart = predictValues(seeded.scene(), part.domain(), seeded.cone, {part.seeds, part.hits}, {});
  const Prediction ofAll = predictValues(seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), {});
  size_t sameCount = 0;
  for (uint32_t node = 0; node < part.faces.size(); ++node) {
    const uint32_t face = part.faces[node], cell = ofPart.cellOf[node];
    CHECK(cell + firstSeed == ofAll.cellOf[face]);
    std::vector<uint32_t> nearest;
    for (const uint32_t other : ofPart.nearest.of(cell))
      nearest.push_back(other == kNoCell ? other : other + firstSeed);
    if (!std::ranges::equal(nearest, ofAll.nearest.of(cell + firstSeed))) continue;
    CHECK(ofPart.values[node] == ofAll.values[face]);
    ++sameCount;
  }
  CHECK(sameCount > 100);
}

TEST_CASE("a failure of the device is an error when seeds are added") {
  class FailingPredictor final : public DevicePredictor {
   public:
    void predict(const PredictionInput&, std::span<double>, const RunControl&) override {
      throw Error(ErrorCode::DeviceLost, "lost");
    }
  };
  const SeededMesh seeded(makeAnimal(1000).mesh, 100);
  std::vector<uint32_t> fewer = seeded.seeds;
  fewer[7] = kNoFace;
  const Prediction before = predictValues(seeded.scene(), seeded.domain(), seeded.cone, {fewer, seeded.hits}, {});
  FailingPredictor failing;
  CHECK_THROWS_AS(
      (void)withFurtherSeeds(before, seeded.scene(), seeded.domain(), seeded.cone, seeded.seedHits(), {}, &failing),
      Error);
}
