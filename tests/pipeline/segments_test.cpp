#include "pipeline/segments.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "pipeline/input_face_values.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"
#include "support/quad_cubes.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;
using test::allSeeds;
using test::referenceSession;
using test::requireFailure;

namespace {

using Labels = std::vector<uint32_t>;

Options segmented(uint32_t clusterCount = 5) {
  Options options = allSeeds();
  options.cone.rayCount = 10;
  options.segmentation = Segmentation::Cgal;
  options.cgalSegmentation.clusterCount = clusterCount;
  return options;
}

/// A sphere and two of half its size.
Mesh threeSpheres() {
  Mesh mesh = makeSphere(320).mesh;
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(makeSphere(80).mesh, 0.5), {4, 0, 0});
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(makeSphere(80).mesh, 0.5), {-4, 0, 0});
  return mesh;
}

struct Segmented {
  SegmentedValues values;
  Report report;
};

Segmented segment(const Mesh& mesh, const std::vector<double>& values, const Options& options) {
  Segmented result;
  StageClock clock(result.report.stageSeconds);
  result.values = segmentValues(prepareMesh(mesh, Orientation::Keep), values, options, {}, clock, result.report, {});
  return result;
}

}  // namespace

TEST_CASE("without a request there is no field, no stage and no report of segments") {
  const Result result = referenceSession().compute(makeTorus(200).mesh, allSeeds());
  CHECK(result.field("normalized") == nullptr);
  CHECK(result.field("segment") == nullptr);
  CHECK_FALSE(result.report.postprocess.has_value());
  CHECK_FALSE(result.report.segmentCount.has_value());
  CHECK(result.report.stageSeconds[Stage::Postprocess] == 0);
  CHECK(result.report.stageSeconds[Stage::Segment] == 0);
}

TEST_CASE("post-processing alone gives values from 0 to 1, and the range that they had") {
  Options options = allSeeds();
  options.postprocess = Postprocess::Cgal;
  const Mesh mesh = makeTorus(800).mesh;
  const Result result = referenceSession().compute(mesh, options);
  const std::vector<double>& normalized = test::normalizedOf(result);
  REQUIRE(normalized.size() == mesh.faces.size());
  CHECK(*std::min_element(normalized.begin(), normalized.end()) == 0);
  CHECK(*std::max_element(normalized.begin(), normalized.end()) == 1);
  CHECK(result.field("segment") == nullptr);
  CHECK(result.report.stageSeconds[Stage::Postprocess] > 0);
  CHECK(result.report.stageSeconds[Stage::Segment] == 0);
  REQUIRE(result.report.postprocess.has_value());
  CHECK(result.report.postprocess->min >= result.report.sdf.min);
  CHECK(result.report.postprocess->max <= result.report.sdf.max);
  CHECK(result.report.postprocess->min < result.report.postprocess->max);
}

TEST_CASE("the fields are those of src/segment for the values of the result") {
  const Mesh mesh = generateShape("animal", 1500).mesh;
  for (const CgalExpansion expansion : {CgalExpansion::All, CgalExpansion::First}) {
    Options options = segmented(3);
    options.cgalSegmentation.smoothness = 0.1;
    options.cgalSegmentation.expansion = expansion;
    const Result result = referenceSession().compute(mesh, options);
    const FaceNeighbours neighbours = findFaceNeighbours(mesh);
    const CgalValues values = postprocessLikeCgal(neighbours, result.sdf());
    CHECK(test::normalizedOf(result) == values.normalized);
    CHECK(result.report.postprocess->min == values.min);
    CHECK(result.report.postprocess->max == values.max);
    const CgalSegmentation expected =
        segmentLikeCgal(computeFaceGeometry(mesh), mesh, neighbours, values.normalized, options.cgalSegmentation);
    CHECK(test::segmentsOf(result) == expected.segments);
    REQUIRE(result.report.segmentCount.has_value());
    CHECK(result.report.segmentCount == expected.segmentCount);
    CHECK(result.report.stageSeconds[Stage::Segment] > 0);
  }
}

TEST_CASE("interpolated and smoothed values can be segmented, too") {
  Options options = segmented();
  options.seeds = SeedCount::ofShare(0.2);
  options.smoothing.isOn = true;
  const Mesh mesh = makeTorus(1000).mesh;
  const Result result = referenceSession().compute(mesh, options);
  CHECK(test::segmentsOf(result).size() == mesh.faces.size());
  CHECK(test::normalizedOf(result) == postprocessLikeCgal(findFaceNeighbours(mesh), result.sdf()).normalized);
}

TEST_CASE("components are segments of their own, on every backend the same ones") {
  const Mesh mesh = threeSpheres();
  const size_t firstSmall = makeSphere(320).mesh.faces.size(), smallCount = makeSphere(80).mesh.faces.size();
  Labels expected(firstSmall, 2);
  expected.insert(expected.end(), smallCount, 0);
  expected.insert(expected.end(), smallCount, 1);
  const auto check = [&](Session& session) {
    const Result result = session.compute(mesh, segmented(2));
    Labels labels = test::segmentsOf(result);
    // The two small spheres have equal values up to rounding: either of them may be first.
    if (labels[firstSmall] == 1)
      for (uint32_t& label : labels) label = label == 2 ? 2 : 1 - label;
    CHECK(labels == expected);
    CHECK(result.report.segmentCount == 3);
  };
  check(referenceSession());
  Session cpu({.backend = BackendChoice::Cpu});
  check(cpu);
}

TEST_CASE("the same bits on one thread and on two, and with a power of two as the unit") {
  const GeneratedShape shape = generateShape("hand", 3000);
  std::vector<double> values(shape.diameter.begin(), shape.diameter.end());
  values[17] = kNoValue;
  const auto onThreads = [&](size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return segment(shape.mesh, values, segmented());
  };
  const Segmented expected = onThreads(1), parallel = onThreads(2);
  CHECK(parallel.values.normalized == expected.values.normalized);
  CHECK(parallel.values.segments == expected.values.segments);
  for (const int exponent : {-600, -3, 600, 1000}) {
    CAPTURE(exponent);
    Mesh scaled = shape.mesh;
    for (Vec3d& v : scaled.vertices) v = v * std::ldexp(1.0, exponent);
    std::vector<double> scaledValues = values;
    for (double& value : scaledValues) value = std::ldexp(value, exponent);
    const Segmented result = segment(scaled, scaledValues, segmented());
    CHECK(result.values.normalized == expected.values.normalized);
    CHECK(result.values.segments == expected.values.segments);
    CHECK(result.report.postprocess->max == std::ldexp(expected.report.postprocess->max, exponent));
  }
}

TEST_CASE("a face without a value is filled, and so is a component without any") {
  Mesh mesh = makeSphere(320).mesh;
  mesh = shapes::joined(std::move(mesh), Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}, {5, 0, 0});
  const Result result = referenceSession().compute(mesh, segmented(2));
  CHECK(std::isnan(result.sdf().back()));
  CHECK(result.report.noValueCount == 1);
  CHECK(std::none_of(test::normalizedOf(result).begin(), test::normalizedOf(result).end(),
                     [](double v) { return std::isnan(v); }));
  CHECK(test::segmentsOf(result).size() == mesh.faces.size());
  CHECK(*std::max_element(test::segmentsOf(result).begin(), test::segmentsOf(result).end()) + 1 ==
        result.report.segmentCount);
}

TEST_CASE("open, non-manifold and degenerate meshes have segments") {
  const Mesh sphere = makeSphere(320).mesh;
  Mesh open = sphere;
  open.faces.erase(open.faces.begin(), open.faces.begin() + 40);
  Mesh fin = sphere;  // A face more at an edge, which then has three.
  fin.vertices.push_back({0, 0, 3});
  fin.faces.push_back({fin.faces[0][0], fin.faces[0][1], static_cast<uint32_t>(fin.vertices.size() - 1)});
  Mesh degenerate = sphere;
  const Face first = sphere.faces[0];
  degenerate.faces.push_back({first[0], first[0], first[1]});
  degenerate.faces.push_back({first[0], first[1], static_cast<uint32_t>(degenerate.vertices.size())});
  degenerate.vertices.push_back((sphere.vertices[first[0]] + sphere.vertices[first[1]]) * 0.5);
  Mesh infinite = sphere;
  infinite.vertices[7] = {kNoValue, 0, INFINITY};
  Mesh doubled = sphere;
  doubled.faces.insert(doubled.faces.end(), sphere.faces.begin(), sphere.faces.end());
  for (const Mesh& mesh : {open, fin, degenerate, infinite, doubled}) {
    CAPTURE(mesh.faces.size());
    const Result result = referenceSession().compute(mesh, segmented(2));
    REQUIRE(test::segmentsOf(result).size() == mesh.faces.size());
    const uint32_t count = result.report.segmentCount.value();
    CHECK(*std::max_element(test::segmentsOf(result).begin(), test::segmentsOf(result).end()) + 1 == count);
    CHECK(std::all_of(test::normalizedOf(result).begin(), test::normalizedOf(result).end(),
                      [](double v) { return 0 <= v && v <= 1; }));
  }
}

TEST_CASE("no value anywhere, and fewer different values than clusters, are errors of the input") {
  const Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  Options options = allSeeds();
  options.postprocess = Postprocess::Cgal;
  requireFailure([&] { (void)referenceSession().compute(triangle, options); }, ErrorCode::NoValues,
                 "no face has a value");
  requireFailure([&] { (void)referenceSession().compute(triangle, segmented()); }, ErrorCode::NoValues);
  requireFailure([] { (void)referenceSession().compute(makeCube(12).mesh, segmented(13)); }, ErrorCode::TooFewValues,
                 "13 clusters");
  requireFailure([&] { (void)segment(triangle, {0.5}, segmented(2)); }, ErrorCode::TooFewValues);
  CHECK(kindOf(ErrorCode::NoValues) == ErrorKind::Input);
  CHECK(kindOf(ErrorCode::TooFewValues) == ErrorKind::Input);
}

TEST_CASE("equal values stay lengths, as CGAL leaves them") {
  Options options = allSeeds();
  options.postprocess = Postprocess::Cgal;
  const Mesh mesh = makeTorus(200).mesh;
  const std::vector<double> values(mesh.faces.size(), 3.0);
  const Segmented result = segment(mesh, values, options);
  CHECK(result.values.normalized == values);
  CHECK(result.report.postprocess->min == 3);
  CHECK(result.report.postprocess->max == 3);
}

TEST_CASE("numbers out of range are errors of usage, and so are numbers without a segmentation") {
  const Mesh mesh = makeSphere(80).mesh;
  for (const uint32_t count : {0u, 1u, 101u})
    requireFailure([&] { (void)referenceSession().compute(mesh, segmented(count)); }, ErrorCode::OptionOutOfRange,
                   "is not a whole number from 2 to 100");
  for (const double smoothness : {-0.1, 1000.5, double(INFINITY), kNoValue}) {
    Options options = segmented();
    options.cgalSegmentation.smoothness = smoothness;
    requireFailure([&] { (void)referenceSession().compute(mesh, options); }, ErrorCode::OptionOutOfRange,
                   "is not a number from 0 to 1000");
  }
  Options unused = allSeeds();
  unused.cgalSegmentation.clusterCount = 7;
  requireFailure([&] { (void)referenceSession().compute(mesh, unused); }, ErrorCode::OptionConflict,
                 "clusters needs segment=cgal");
}

TEST_CASE("the greatest smoothness leaves one segment per component, 0 follows the clusters") {
  const Mesh mesh = makeTorus(600).mesh;
  Options options = segmented(4);
  options.cgalSegmentation.smoothness = kMaxSmoothness;
  CHECK(referenceSession().compute(mesh, options).report.segmentCount == 1);
  options.cgalSegmentation.smoothness = 0;
  CHECK(referenceSession().compute(mesh, options).report.segmentCount > 1);
}

TEST_CASE("a polygon has the label of its largest area; labels without a polygon are removed") {
  // A quad of two triangles, a point, a pentagon of three triangles, a quad of no area.
  Mesh mesh;
  mesh.vertices.resize(5);
  mesh.faces.resize(7);
  mesh.polygons = {{0, 4, 5, 10, 14}, {0, 1, 2, 3, 0, 0, 1, 2, 3, 4, 0, 1, 2, 3}, {0, 0, 2, 2, 2, 3, 3}};
  const Labels triangles{4, 1, 5, 2, 5, 9, 3};
  CHECK(segmentsOfInputFaces(mesh, triangles, std::vector<double>{2, 1, 1, 1.5, 1, 0, 0}) ==
        Labels{1, kNoSegment, 2, 0});
  CHECK(segmentsOfInputFaces(mesh, triangles, std::vector<double>{1, 1, 1, 3, 1, 0, 0}) == Labels{0, kNoSegment, 1, 2});
  mesh.polygons = {};
  CHECK(segmentsOfInputFaces(mesh, triangles, std::vector<double>(7, 1.0)) == triangles);
}

TEST_CASE("a mesh of polygons has one normalised value and one segment per input face") {
  const test::QuadCubes cubes(std::array{test::QuadCubes::Cube{1, 0}, test::QuadCubes::Cube{0.25, 3}});
  const Result result = referenceSession().compute(cubes.view(), segmented(2));
  CHECK(test::segmentsOf(result) == Labels{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, kNoSegment});
  CHECK(result.report.segmentCount == 2);
  REQUIRE(test::normalizedOf(result).size() == 13);
  CHECK(std::isnan(test::normalizedOf(result).back()));
  for (size_t face = 0; face < 12; ++face)
    CHECK(test::normalizedOf(result)[face] == doctest::Approx(face < 6 ? 1 : 0).epsilon(0.2));
}
