#include "estimate/error_indicator.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "generate/shapes.h"
#include "mesh/face_geometry.h"
#include "predict/seed_cells.h"

using namespace asdfvk;

namespace {

/// A sphere with some seeds, whose prediction the test sets.
struct SeededSphere {
  Mesh mesh = makeSphere(320).mesh;
  FaceGeometry geometry = computeFaceGeometry(mesh);
  DualGraph graph = buildDualGraph(mesh);
  std::vector<uint32_t> seeds{3, 60, 120, 150};
  std::vector<double> values;  ///< #S
  Prediction prediction;

  SeededSphere() : values(seeds.size(), 2) {
    const SeedCells cells = buildSeedCells(graph, seeds);
    prediction.cellOf = cells.cellOf;
    prediction.nearest = NearestCells(cells, graph, geometry, seeds, 6);
    prediction.values.assign(mesh.faces.size(), 2.0);
  }
  [[nodiscard]] UnsetVector<double> indicator() const { return errorIndicator(prediction, seeds, values); }
  [[nodiscard]] uint32_t faceOfCell(uint32_t cell) const {
    for (uint32_t face = 0; face < mesh.faces.size(); ++face)
      if (prediction.cellOf[face] == cell && face != seeds[cell]) return face;
    return kNoFace;
  }
};

}  // namespace

TEST_CASE("the indicator is constant where predictions equal the seeds, also for a face without a prediction") {
  SeededSphere sphere;
  sphere.prediction.values[sphere.faceOfCell(1)] = kNoValue;
  const UnsetVector<double> indicator = sphere.indicator();
  CHECK(indicator[0] > 0);
  CHECK(std::all_of(indicator.begin(), indicator.end(), [&](double entry) { return entry == indicator[0]; }));
}

TEST_CASE("the indicator of a face is the difference to its seed plus half of the mean") {
  SeededSphere sphere;
  const uint32_t face = sphere.faceOfCell(2);
  sphere.prediction.values[face] = 5;
  const UnsetVector<double> indicator = sphere.indicator();
  const double mean = 3.0 / static_cast<double>(indicator.size());
  CHECK(indicator[face] == doctest::Approx(3 + 0.5 * mean));
  CHECK(indicator[sphere.seeds[2]] == doctest::Approx(0.5 * mean));
}

TEST_CASE("the indicator of a cell grows with the difference between its seed and neighbouring seeds") {
  SeededSphere sphere;
  sphere.values[2] = 8;
  const UnsetVector<double> indicator = sphere.indicator();
  const auto of = [&](uint32_t cell) { return indicator[sphere.seeds[cell]]; };
  REQUIRE(sphere.prediction.nearest.of(2).size() > 1);
  // Its own prediction is off by 6 besides; of the neighbours of each other cell one may be off by 6.
  CHECK(of(2) > of(0));
  for (const uint32_t cell : {0u, 1u, 3u}) {
    const auto around = sphere.prediction.nearest.of(cell);
    const bool isNext = std::count(around.begin(), around.end(), 2u) > 0;
    const double spread = isNext ? 6.0 / static_cast<double>(around.size() - 1) : 0;
    CHECK(of(2) - of(cell) == doctest::Approx(12 - spread));
  }
}

TEST_CASE("a face without a prediction, or with a seed without a value, has the mean indicator") {
  SeededSphere sphere;
  sphere.prediction.values[sphere.faceOfCell(1)] = 5;
  const uint32_t unpredicted = sphere.faceOfCell(0);
  sphere.prediction.values[unpredicted] = kNoValue;
  sphere.values[2] = kNoValue;  // A seed without any hit.
  const uint32_t ofNoValue = sphere.faceOfCell(2);
  const UnsetVector<double> indicator = sphere.indicator();
  CHECK(indicator[unpredicted] == doctest::Approx(3 * indicator[sphere.seeds[0]]));
  CHECK(indicator[ofNoValue] == indicator[unpredicted]);
  CHECK(
      std::all_of(indicator.begin(), indicator.end(), [](double entry) { return entry > 0 && std::isfinite(entry); }));
}
