#include "predict/reprojection.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "generate/shapes.h"
#include "predict/seeded_mesh.h"

using namespace asdfvk;
using test::SeededMesh;

namespace {

std::vector<double> predict(const SeededMesh& seeded, const ReprojectionOptions& options = {}) {
  return reprojectHits(seeded.scene(), seeded.graph, seeded.cone, seeded.traced(), options).values;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// Mean and worst of |a - b| / b over the chosen faces that are no seeds.
struct Difference {
  double mean = 0, worst = 0;
  size_t count = 0;
};

template <typename Exact, typename Choose>
Difference differenceTo(const SeededMesh& seeded, const std::vector<double>& values, const Exact& exact,
                        const Choose& isChosen) {
  Difference difference;
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (std::find(seeded.seeds.begin(), seeded.seeds.end(), face) != seeded.seeds.end() || !isChosen(face)) continue;
    const double off = std::abs(values[face] - exact(face)) / exact(face);
    REQUIRE(std::isfinite(off));
    difference.mean += off;
    difference.worst = std::max(difference.worst, off);
    ++difference.count;
  }
  difference.mean /= static_cast<double>(difference.count);
  MESSAGE("off by ", difference.mean, " on average, ", difference.worst, " at worst, over ", difference.count);
  return difference;
}

/// A ray of a convex shape, by its direction in the face's frame (z inwards), the length of its chord and the cosine
/// between the normals at both ends.
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
  return coneValue(lengths, weights, cone.outlierDeviations);
}

Chord chordOfUnitSphere(const Vec3d& direction) { return {2 * direction.z, 1 - 2 * direction.z * direction.z}; }

const auto kAnyFace = [](uint32_t) { return true; };

}  // namespace

TEST_CASE("on a sphere the faces without rays are predicted as its chords say") {
  const SeededMesh seeded(makeSphere(2000).mesh, 100);
  const double exact = coneValueOf(seeded.cone, chordOfUnitSphere);
  const Difference off = differenceTo(
      seeded, predict(seeded), [&](uint32_t) { return exact; }, kAnyFace);
  CHECK(off.count == 1900);
  CHECK(off.mean < 0.02);
  CHECK(off.worst < 0.06);
}

TEST_CASE("between two walls, away from the rim, the faces without rays are predicted as the distance says") {
  const SeededMesh seeded(makeSlab(3000, {.width = 2, .thickness = 0.2}).mesh, 300);
  const double exact = coneValueOf(seeded.cone, [](const Vec3d& d) { return Chord{0.2 / d.z, -1}; });
  const auto isInside = [&](uint32_t face) {
    const Vec3d& centre = seeded.geometry.barycentres[face];
    return std::max(std::abs(centre.x), std::abs(centre.y)) < 0.5;
  };
  const Difference off = differenceTo(
      seeded, predict(seeded), [&](uint32_t) { return exact; }, isInside);
  CHECK(off.count > 500);
  // A bias of some percent: a ray right across, an outlier of the face's own cone, is none of the next seed's.
  CHECK(off.mean < 0.07);
  CHECK(off.worst < 0.13);
}

TEST_CASE("on a long cylinder, away from the caps, the faces without rays are predicted as its chords say") {
  const SeededMesh seeded(makeCylinder(4000, {.radius = 0.25, .length = 5}).mesh, 400);
  // What lies along the axis of the cylinder depends on where the frame's tangent points: on the face.
  const auto exact = [&](uint32_t face) {
    const Vec3d& normal = seeded.geometry.normals[face];
    const ConeFrame frame = faceConeFrame(seeded.cone, normal, face);
    return coneValueOf(seeded.cone, [&](const Vec3d& d) {
      const Vec3d way = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
      const double chord = 2 * 0.25 * -dot(way, normal) / (1 - way.z * way.z);
      return Chord{chord, 1 + chord / 0.25 * dot(way, normal)};
    });
  };
  const auto isInside = [&](uint32_t face) { return std::abs(seeded.geometry.barycentres[face].z) < 1; };
  const Difference off = differenceTo(seeded, predict(seeded), exact, isInside);
  CHECK(off.count > 1000);
  CHECK(off.mean < 0.05);
  CHECK(off.worst < 0.15);
}

TEST_CASE("a prediction is nearer to what a face's own rays would say than its seed's value is") {
  for (const std::string name : {"animal", "hand"}) {
    CAPTURE(name);
    const SeededMesh seeded(generateShape(name, 4000).mesh, 400);
    const SeedCells cells = seeded.cells();
    std::vector<double> ofTheSeed(seeded.mesh.faceCount());
    for (uint32_t face = 0; face < ofTheSeed.size(); ++face) ofTheSeed[face] = seeded.values[cells.cellOf[face]];
    const std::vector<double> predicted = predict(seeded);
    double predictedOff = 0, copiedOff = 0;
    for (uint32_t face = 0; face < predicted.size(); ++face) {
      const double exact = seeded.tracedValue(face);
      predictedOff += std::abs(predicted[face] - exact);
      copiedOff += std::abs(ofTheSeed[face] - exact);
    }
    MESSAGE(name, ": ", predictedOff / copiedOff);
    CHECK(predictedOff < 0.7 * copiedOff);
  }
}

TEST_CASE("one thread and several give the same bits") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const std::vector<double> many = predict(seeded);
  for (const size_t threadCount : {size_t{1}, size_t{2}}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
    CHECK(sameBits(predict(seeded), many));
  }
}

TEST_CASE("scaling and shifting a mesh scales its predictions and nothing else") {
  const Mesh mesh = makeAnimal(2000).mesh;
  const std::vector<double> expected = predict(SeededMesh(mesh, 150));
  // By a power of two every number stays the same; else a ray that grazes an edge, and a length at the edge of its
  // window, may change sides with the last bit.
  const struct {
    double scale;
    Vec3d shift;
    bool sameBits;
  } cases[] = {{0.125, {0, 0, 0}, true},
               {std::ldexp(1, -500), {0, 0, 0}, true},
               {std::ldexp(1, 500), {0, 0, 0}, true},
               {1e-160, {0, 0, 0}, false},
               {10, {300, -200, 500}, false}};
  for (const auto& [scale, shift, isExact] : cases) {
    CAPTURE(scale);
    std::vector<double> values = predict(SeededMesh(test::scaledAndShifted(mesh, scale, shift), 150));
    for (double& value : values) value /= scale;
    if (isExact) {
      CHECK(sameBits(values, expected));
      continue;
    }
    double off = 0;
    for (size_t face = 0; face < values.size(); ++face) {
      REQUIRE(std::isnan(values[face]) == std::isnan(expected[face]));
      if (!std::isnan(values[face])) off += std::abs(values[face] - expected[face]) / expected[face];
    }
    MESSAGE("off by ", off / static_cast<double>(values.size()));
    CHECK(off / static_cast<double>(values.size()) < 2e-3);
  }
}

TEST_CASE("degenerate faces and faces that no seed is linked with have no prediction, the others have one") {
  Mesh mesh = test::joined(makeSphere(500).mesh, makeSphere(180).mesh, {4, 0, 0});
  const Face first = mesh.faces[0];
  mesh.faces.push_back({first[0], first[0], first[1]});
  SeededMesh seeded(mesh, 680);
  // The first ones of the first sphere only.
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
  const std::vector<double> values = predict(seeded);
  REQUIRE(values.size() == mesh.faces.size());
  for (uint32_t face = 0; face < 500; ++face) CHECK(std::isfinite(values[face]));
  for (uint32_t face = 500; face < values.size(); ++face) CHECK(std::isnan(values[face]));
}

TEST_CASE("where rays escape a prediction is a length or nothing") {
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

TEST_CASE("a lone seed predicts all that it is linked with") {
  const SeededMesh seeded(makeSphere(500).mesh, 1);
  const std::vector<double> values = predict(seeded);
  CHECK(std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }) > 100);
  CHECK(values[seeded.seeds[0]] == doctest::Approx(seeded.values[0]).epsilon(0.03));
}

TEST_CASE("what an earlier prediction has of the same seeds is taken from it, and nothing else") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  const ReprojectionOptions options;
  std::vector<uint32_t> fewer = seeded.seeds;
  for (size_t i = 0; i < fewer.size(); i += 40) fewer[i] = kNoFace;
  const auto predictFrom = [&](const std::vector<uint32_t>& seeds, Prediction earlier) {
    return reprojectHits(seeded.scene(), seeded.graph, seeded.cone, {seeds, seeded.hits}, options, std::move(earlier));
  };
  const Prediction few = predictFrom(fewer, {}), all = predictFrom(seeded.seeds, {});
  CHECK_FALSE(sameBits(few.values, all.values));
  CHECK(sameBits(predictFrom(seeded.seeds, few).values, all.values));
  CHECK(sameBits(predictFrom(fewer, all).values, few.values));
  // Marked, so that it can be told where values come from.
  Prediction marked = few;
  for (double& value : marked.values) value = -1;
  const std::vector<double> values = predictFrom(seeded.seeds, marked).values;
  size_t takenCount = 0;
  for (size_t face = 0; face < values.size(); ++face) {
    takenCount += values[face] == -1;
    if (values[face] == -1) CHECK((few.values[face] == all.values[face] || std::isnan(all.values[face])));
  }
  CHECK(takenCount > values.size() / 4);
  CHECK(takenCount < values.size());
}

TEST_CASE("seeds that are left out change nothing, though their hits are there") {
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
    return reprojectHits(seeded.scene(), seeded.graph, seeded.cone, {seeds, hits}, {}).values;
  };
  CHECK(sameBits(predictFrom(leftOut, seeded.hits), predictFrom(used, usedHits)));
}

TEST_CASE("without seeds, and with every face a seed, there is one prediction per face all the same") {
  SeededMesh none(makeSphere(180).mesh, 0);
  for (const double value : predict(none)) CHECK(std::isnan(value));
  const SeededMesh all(makeSphere(180).mesh, 180);
  for (const double value : predict(all)) CHECK(std::isfinite(value));
}

TEST_CASE("more neighbours make the predictions less noisy") {
  const SeededMesh seeded(makeSphere(2000).mesh, 200);
  const double exact = coneValueOf(makeCone({.rayCount = 1000}), chordOfUnitSphere);
  const auto off = [&](uint32_t neighbourCount) {
    return differenceTo(
        seeded, predict(seeded, {.neighbourCount = neighbourCount}), [&](uint32_t) { return exact; }, kAnyFace);
  };
  CHECK(off(6).mean < off(0).mean);
}

TEST_CASE("a face that comes to another cell is predicted anew, though that cell asks whom it asked before") {
  const SeededMesh seeded(makeAnimal(3000).mesh, 300);
  std::vector<uint32_t> fewer = seeded.seeds;
  for (size_t i = 0; i < fewer.size(); i += 10) fewer[i] = kNoFace;
  for (const uint32_t neighbourCount : {0u, 1u}) {
    CAPTURE(neighbourCount);
    const auto predictFrom = [&](const std::vector<uint32_t>& seeds, Prediction earlier) {
      return reprojectHits(seeded.scene(), seeded.graph, seeded.cone, {seeds, seeded.hits},
                           {.neighbourCount = neighbourCount}, std::move(earlier));
    };
    const Prediction all = predictFrom(seeded.seeds, {}), few = predictFrom(fewer, {});
    size_t movedCount = 0;  // To a cell that asks the same seeds, and with another value.
    for (uint32_t face = 0; face < few.values.size(); ++face) {
      const uint32_t cell = few.cellOf[face];
      movedCount += cell != kNoCell && cell != all.cellOf[face] && few.values[face] != all.values[face] &&
                    std::ranges::equal(few.nearest.of(cell), all.nearest.of(cell));
    }
    CHECK(movedCount > 10);
    CHECK(sameBits(predictFrom(fewer, all).values, few.values));
    CHECK(sameBits(predictFrom(seeded.seeds, few).values, all.values));
  }
}
