#include "segment/cgal_segmentation.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "asdf_vk/error.h"
#include "sample_problems.h"
#include "segment/cgal_postprocess.h"
#include "segment/soft_clustering.h"
#include "slow_expansion.h"
#include "stored_case.h"
#include "support/require_failure.h"

using namespace asdfvk;

namespace {

using Labels = std::vector<uint32_t>;

CgalSegmentation segmentsOf(const test::SampleMesh& sample, const CgalSegmentationOptions& options) {
  return segmentLikeCgal(sample.geometry, sample.mesh, sample.neighbours, sample.values, options);
}

/// Two faces at the edge from (0, 0, 0) to (1, 0, 0); the second is turned around it by the angle, which is 0 where
/// they are coplanar and positive where the edge is convex.
std::vector<LabelEdge> edgesAtAngle(double angle, double smoothness) {
  const Mesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -std::cos(angle), -std::sin(angle)}}, {{0, 1, 2}, {1, 0, 3}}, {}};
  return cgalEdgeCosts(computeFaceGeometry(mesh), mesh, findFaceNeighbours(mesh), smoothness);
}

double costAtAngle(double angle, double smoothness) { return edgesAtAngle(angle, smoothness).at(0).cost; }

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("a flat edge costs most, a convex one more than a concave one of equal angle") {
  CHECK(costAtAngle(0, 0.01) == doctest::Approx(-std::log(5e-6)).epsilon(1e-14));
  CHECK(costAtAngle(kPi / 2, 0.01) == doctest::Approx(-std::log(0.08 * 0.5)).epsilon(1e-13));
  CHECK(costAtAngle(-kPi / 2, 0.01) == doctest::Approx(-std::log(0.5)).epsilon(1e-13));
  CHECK(costAtAngle(-kPi / 2, 0.26) == doctest::Approx(-26 * std::log(0.5)).epsilon(1e-13));
  CHECK(costAtAngle(1, -3) == 0);
}

TEST_CASE("at a face of no area the edge is convex and folded, or flat by the signs of the other's normal") {
  const auto costs = [](const std::vector<Face>& faces) {
    // Corner 2 is on the edge 0-1; the normal of 0, 1, 3 is (1, 1, 1) times a number.
    const Mesh mesh{{{0, 0, 0}, {2, -2, 0}, {1, -1, 0}, {0, 2, -2}}, faces, {}};
    return cgalEdgeCosts(computeFaceGeometry(mesh), mesh, findFaceNeighbours(mesh), 0.01).at(0).cost;
  };
  const double flat = -std::log(5e-6), folded = -std::log(0.08);
  CHECK(costs({{0, 1, 3}, {1, 0, 2}}) == doctest::Approx(flat));
  CHECK(costs({{1, 0, 3}, {0, 1, 2}}) == doctest::Approx(folded));
  CHECK(costs({{1, 0, 2}, {0, 1, 3}}) == doctest::Approx(folded));
  CHECK(costs({{0, 1, 2}, {1, 0, 3}}) == doctest::Approx(flat));
}

TEST_CASE("a common edge has one cost, a border none") {
  const std::vector<LabelEdge> edges = edgesAtAngle(1, 1);
  REQUIRE(edges.size() == 1);
  CHECK(edges[0].f == 0);
  CHECK(edges[0].g == 1);
  const test::SampleMesh torus = test::sampleMesh("torus", 600);
  CHECK(cgalEdgeCosts(torus.geometry, torus.mesh, torus.neighbours, 1).size() == 3 * torus.mesh.faceCount() / 2);
}

TEST_CASE("components are numbered by ascending mean value, then by first face") {
  const LabelComponents components = findLabelComponents(test::stripNeighbours(7), Labels{1, 1, 0, 1, 0, 0, 1},
                                                         std::vector<double>{0.5, 0.7, 0.1, 0.9, 0.4, 0.2, 0.6});
  CHECK(components.componentCount == 5);
  CHECK(components.componentOf == Labels{2, 2, 0, 4, 1, 1, 3});
  CHECK(findLabelComponents({}, {}, {}).componentCount == 0);
}

TEST_CASE("an empty mesh is refused") {
  test::requireFailure([] { static_cast<void>(segmentsOf({Mesh{}, {}}, {})); }, ErrorCode::NoValues);
}

TEST_CASE("one face is one segment of one cluster, two clusters are refused") {
  const test::SampleMesh sample(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}, {0.7});
  const CgalSegmentation result = segmentsOf(sample, {.clusterCount = 1});
  CHECK(result.segments == Labels{0});
  CHECK(result.segmentCount == 1);
  test::requireFailure([&] { static_cast<void>(segmentsOf(sample, {.clusterCount = 2})); }, ErrorCode::TooFewValues);
}

TEST_CASE("two faces of different values are two clusters, and one segment where the edge costs more") {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  const test::SampleMesh sample(mesh, {1, 0});
  const CgalSegmentation cut = segmentsOf(sample, {.clusterCount = 2, .smoothness = 0});
  CHECK(cut.clusters == Labels{1, 0});
  CHECK(cut.segments == Labels{1, 0});
  CHECK(cut.energy == 0);
  const CgalSegmentation whole = segmentsOf(sample, {.clusterCount = 2, .smoothness = 1});
  CHECK(whole.segments == Labels{0, 0});
  CHECK(whole.segmentCount == 1);
}

TEST_CASE("all values equal: refused, but for one cluster") {
  test::SampleMesh sample = test::sampleMesh("torus", 600);
  sample.values.assign(sample.values.size(), 0.5);
  CHECK(segmentsOf(sample, {.clusterCount = 1}).segmentCount == 1);
  test::requireFailure([&] { static_cast<void>(segmentsOf(sample, {})); }, ErrorCode::TooFewValues);
}

TEST_CASE("faces without neighbours are segments of their own") {
  Mesh soup;
  for (uint32_t i = 0; i < 8; ++i) {
    soup.vertices.insert(soup.vertices.end(), {{double(i), 0, 0}, {i + 0.5, 0, 0}, {double(i), 1, 0}});
    soup.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const test::SampleMesh sample(soup, {0, 0.1, 0.05, 0.9, 1, 0.95, 0.02, 0.97});
  CHECK(segmentsOf(sample, {.clusterCount = 2}).segments == Labels{0, 3, 2, 4, 7, 5, 1, 6});
}

TEST_CASE("all labels expanded: the energy of the slow twin, never above that of the first label only") {
  for (const std::string shape : {"animal", "hand", "figure"})
    for (const uint64_t faceCount : {400u, 5000u})
      for (const test::Setting& setting : test::kSettings) {
        CAPTURE(shape);
        CAPTURE(faceCount);
        const test::SampleMesh sample = test::sampleMesh(shape, faceCount);
        const CgalSegmentationOptions options{setting.clusterCount, setting.smoothness, CgalExpansion::All};
        const CgalSegmentation all = segmentsOf(sample, options);
        CgalSegmentationOptions firstOnly = options;
        firstOnly.expansion = CgalExpansion::First;
        CHECK(all.energy <= segmentsOf(sample, firstOnly).energy);

        std::vector<double> logarithms;
        for (const double value : sample.values) logarithms.push_back(std::log(5 * value + 1) / std::log(6.0));
        std::vector<double> costs = clusterSoftly(logarithms, setting.clusterCount).probabilities;
        for (double& cost : costs) cost = -std::log(std::max(5e-6, cost));
        const std::vector<LabelEdge> edges =
            cgalEdgeCosts(sample.geometry, sample.mesh, sample.neighbours, setting.smoothness);
        const LabelProblem problem{setting.clusterCount, costs, edges};
        Labels labels;
        for (uint32_t face = 0; face < sample.mesh.faceCount(); ++face) {
          labels.push_back(0);
          for (uint32_t label = 1; label < setting.clusterCount; ++label)
            if (problem.dataCost(face, label) < problem.dataCost(face, labels.back())) labels.back() = label;
        }
        const double slow = test::minimizeSlowly(problem, labels, setting.clusterCount);
        CHECK(all.energy == doctest::Approx(slow).epsilon(1e-10));
        CHECK(all.energy == doctest::Approx(labelEnergy(problem, all.clusters)).epsilon(1e-13));
      }
}

TEST_CASE("segments are the same on any number of threads") {
  const test::SampleMesh sample = test::sampleMesh("hand", 20'000);
  const auto segments = [&] { return segmentsOf(sample, {}); };
  const CgalSegmentation alone = test::onThreads(1, segments);
  CHECK(alone.segmentCount > 1);
  for (const size_t count : {2u, 4u}) {
    const CgalSegmentation result = test::onThreads(count, segments);
    CHECK(result.segments == alone.segments);
    CHECK(result.energy == alone.energy);
  }
}

TEST_CASE("the stored values of CGAL 5.5.1: post-processed values within 1e-12, every segment equal") {
  const test::StoredCase stored = test::readStoredCase();
  const test::SampleMesh sample(test::storedCaseMesh(), stored.normalized);
  REQUIRE(stored.raw.size() == sample.mesh.faceCount());
  const CgalValues values = postprocessLikeCgal(sample.neighbours, stored.raw);
  for (size_t face = 0; face < stored.raw.size(); ++face)
    REQUIRE(std::abs(values.normalized[face] - stored.normalized[face]) < 1e-12);
  for (size_t i = 0; i < test::kSettings.size(); ++i)
    CHECK(segmentsOf(sample, {test::kSettings[i].clusterCount, test::kSettings[i].smoothness, CgalExpansion::First})
              .segments == stored.segments[i]);
}
