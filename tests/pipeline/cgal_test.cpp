#include "asdf_vk/cgal.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stop_token>

#include "generate/shapes.h"
#include "support/quad_cubes.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::requireFailure;

namespace {

using Labels = std::vector<uint32_t>;
using Values = std::vector<double>;

/// Values of the cgal definition, normalised and segmented by the session.
Result computed(const MeshView& mesh, const CgalSegmentationOptions& segmentation) {
  Options options;
  applyDefinition(Definition::Cgal, options);
  options.segmentation = Segmentation::Cgal;
  options.cgalSegmentation = segmentation;
  return test::referenceSession().compute(mesh, options);
}

Mesh animal() { return generateShape("animal", 1500).mesh; }

/// Two cubes of quads, of 1 and of a quarter of the size, and a face of two corners.
test::QuadCubes cubesOfQuads() {
  return test::QuadCubes(std::array{test::QuadCubes::Cube{1, 0}, test::QuadCubes::Cube{0.25, 3}});
}

}  // namespace

TEST_CASE("from the values of a result, its fields with the same bits") {
  Mesh open = animal();
  open.faces.resize(open.faces.size() * 3 / 4);  // Some faces have no value.
  Mesh fin = animal();                           // A face more at an edge, which then has three.
  fin.vertices.push_back({0, 0, 3});
  fin.faces.push_back({fin.faces[0][0], fin.faces[0][1], static_cast<uint32_t>(fin.vertices.size() - 1)});
  for (const Mesh& mesh : {animal(), open, fin}) {
    CAPTURE(mesh.faces.size());
    for (const CgalExpansion expansion : {CgalExpansion::All, CgalExpansion::First}) {
      const CgalSegmentationOptions options{3, 0.1, expansion};
      const Result result = computed(mesh, options);
      const PostprocessedSdf sdf = postprocessSdf(mesh, result.sdf());
      CHECK(sdf.normalized == test::normalizedOf(result));
      CHECK(sdf.min == result.report.postprocess->min);
      CHECK(sdf.max == result.report.postprocess->max);
      const LabelledFaces segments = segmentSdf(mesh, sdf.normalized, options);
      CHECK(segments.labels == test::segmentsOf(result));
      CHECK(segments.count == result.report.segmentCount);
    }
  }
}

TEST_CASE("a segment is a connected set of faces of one cluster") {
  const Mesh mesh = animal();
  const CgalSegmentationOptions options{3, 0.1};
  const Values normalized = test::normalizedOf(computed(mesh, options));
  const LabelledFaces segments = segmentSdf(mesh, normalized, options);
  const LabelledFaces clusters = segmentSdf(mesh, normalized, options, CgalLabels::Clusters);
  CHECK(clusters.count == 3);
  CHECK(segments.count > clusters.count);
  Labels clusterOf(segments.count, kNoSegment);
  for (size_t face = 0; face < mesh.faces.size(); ++face) {
    uint32_t& cluster = clusterOf[segments.labels[face]];
    if (cluster == kNoSegment) cluster = clusters.labels[face];
    REQUIRE(cluster == clusters.labels[face]);
  }
  CHECK(*std::max_element(clusterOf.begin(), clusterOf.end()) < clusters.count);
}

TEST_CASE("the number of clusters is the requested one, even where one has no face") {
  const Mesh mesh = makeSphere(320).mesh;
  Values values(mesh.faces.size());
  for (size_t face = 0; face < values.size(); ++face) values[face] = static_cast<double>(face % 5) / 4;
  const LabelledFaces clusters = segmentSdf(mesh, values, {4, kMaxSmoothness}, CgalLabels::Clusters);
  CHECK(clusters.count == 4);
  CHECK(std::count(clusters.labels.begin(), clusters.labels.end(), clusters.labels[0]) ==
        static_cast<ptrdiff_t>(mesh.faces.size()));
}

TEST_CASE("float positions give the labels of the same positions in double") {
  const Mesh mesh = animal();
  std::vector<float> floats;
  Mesh rounded = mesh;
  for (Vec3d& v : rounded.vertices)
    for (size_t axis = 0; axis < 3; ++axis) {
      floats.push_back(static_cast<float>(v[axis]));
      v[axis] = static_cast<double>(floats.back());
    }
  const MeshView view(floats, MeshView(mesh).corners());
  const Values normalized = test::normalizedOf(computed(mesh, {}));
  CHECK(segmentSdf(view, normalized).labels == segmentSdf(rounded, normalized).labels);
  CHECK(postprocessSdf(view, normalized).normalized == postprocessSdf(rounded, normalized).normalized);
}

TEST_CASE("polygons: their triangles have their value, and a face without a triangle none") {
  const test::QuadCubes cubes = cubesOfQuads();
  Values values{2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1, kNoValue};
  values[1] = kNoValue;
  const PostprocessedSdf sdf = postprocessSdf(cubes.view(), values);
  REQUIRE(sdf.normalized.size() == 13);
  CHECK(std::isnan(sdf.normalized.back()));
  for (size_t face = 0; face < 12; ++face) CHECK(sdf.normalized[face] == (face < 6 ? 1 : 0));
  CHECK(sdf.min == 1);
  CHECK(sdf.max == 2);
  const LabelledFaces segments = segmentSdf(cubes.view(), sdf.normalized, {.clusterCount = 2});
  CHECK(segments.labels == Labels{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, kNoSegment});
  CHECK(segments.count == 2);
  const LabelledFaces clusters = segmentSdf(cubes.view(), sdf.normalized, {.clusterCount = 2}, CgalLabels::Clusters);
  CHECK(clusters.labels == segments.labels);
  CHECK(clusters.count == 2);
}

TEST_CASE("polygons: the results are those of the triangles, by area") {
  // Quads of two triangles each, of equal area.
  const test::QuadCubes cubes = cubesOfQuads();
  Values values(13);
  for (size_t face = 0; face < 13; ++face) values[face] = 1 + std::sin(static_cast<double>(face));
  Mesh triangles;
  triangles.vertices.resize(16);
  for (size_t i = 0; i < cubes.positions.size(); ++i) triangles.vertices[i / 3][i % 3] = cubes.positions[i];
  Values ofTriangles;
  for (size_t face = 0; face < 12; ++face) {
    const uint32_t* c = &cubes.corners[4 * face];
    triangles.faces.insert(triangles.faces.end(), {Face{c[0], c[1], c[2]}, Face{c[0], c[2], c[3]}});
    ofTriangles.insert(ofTriangles.end(), 2, values[face]);
  }
  const PostprocessedSdf polygons = postprocessSdf(cubes.view(), values),
                         expected = postprocessSdf(triangles, ofTriangles);
  CHECK(polygons.min == expected.min);
  CHECK(polygons.max == expected.max);
  for (size_t face = 0; face < 12; ++face)
    CHECK(polygons.normalized[face] ==
          doctest::Approx((expected.normalized[2 * face] + expected.normalized[2 * face + 1]) / 2));
}

TEST_CASE("a missing value is the mean of its neighbours before the filter; equal values stay") {
  const Mesh mesh = makeSphere(320).mesh;
  Values values(mesh.faces.size(), 3.0);
  values[17] = kNoValue;
  const PostprocessedSdf sdf = postprocessSdf(mesh, values);
  CHECK(sdf.normalized == Values(mesh.faces.size(), 3.0));
  CHECK(sdf.min == 3);
  CHECK(sdf.max == 3);
}

TEST_CASE("a missing value is the mean of its neighbours before the clustering") {
  const Mesh mesh = makeSphere(320).mesh;
  const auto height = [&](const Face& face) { return mesh.vertices[face[0]][2]; };
  Values values;
  for (const Face& face : mesh.faces) values.push_back(height(face) < 0 ? 0.25 : 0.75);
  const Labels expected = segmentSdf(mesh, values, {.clusterCount = 2}).labels;
  const auto highest = std::max_element(mesh.faces.begin(), mesh.faces.end(),
                                        [&](const Face& a, const Face& b) { return height(a) < height(b); });
  values[static_cast<size_t>(highest - mesh.faces.begin())] = kNoValue;
  CHECK(segmentSdf(mesh, values, {.clusterCount = 2}).labels == expected);
}

TEST_CASE("a power of two as the unit of the values changes no bit") {
  const Mesh mesh = animal();
  const Values sdf = computed(mesh, {}).sdf();
  const PostprocessedSdf expected = postprocessSdf(mesh, sdf);
  for (const int exponent : {-900, -1, 1000}) {
    Values scaled = sdf;
    for (double& value : scaled) value = std::ldexp(value, exponent);
    const PostprocessedSdf result = postprocessSdf(mesh, scaled);
    CHECK(result.normalized == expected.normalized);
    CHECK(result.max == std::ldexp(expected.max, exponent));
  }
}

TEST_CASE("wrong values and meshes are errors with a code and the face") {
  const Mesh mesh = makeCube(12).mesh;
  const auto withValue = [&](double value) {
    Values values(mesh.faces.size(), 0.5);
    values[7] = value;
    return values;
  };
  for (const size_t count : {size_t{0}, mesh.faces.size() - 1, mesh.faces.size() + 1}) {
    requireFailure([&] { (void)postprocessSdf(mesh, Values(count, 1)); }, ErrorCode::ArraySize, "for 12 faces");
    requireFailure([&] { (void)segmentSdf(mesh, Values(count, 1)); }, ErrorCode::ArraySize, "for 12 faces");
  }
  for (const double value : {-1.0, -1e-300, double(INFINITY), -double(INFINITY)}) {
    requireFailure([&] { (void)postprocessSdf(mesh, withValue(value)); }, ErrorCode::ValueOutOfRange, "of face 7");
    requireFailure([&] { (void)segmentSdf(mesh, withValue(value)); }, ErrorCode::ValueOutOfRange, "of face 7");
  }
  requireFailure([&] { (void)segmentSdf(mesh, withValue(1 + 1e-15)); }, ErrorCode::ValueOutOfRange, "(0 to 1, or NaN");
  requireFailure([&] { (void)postprocessSdf(mesh, Values(12, kNoValue)); }, ErrorCode::NoValues);
  requireFailure([&] { (void)segmentSdf(mesh, Values(12, kNoValue)); }, ErrorCode::NoValues);
  requireFailure([&] { (void)segmentSdf(mesh, withValue(1), {.clusterCount = 3}); }, ErrorCode::TooFewValues);
  for (const uint32_t count : {0u, 1u, 101u})
    requireFailure([&] { (void)segmentSdf(mesh, withValue(1), {count}); }, ErrorCode::OptionOutOfRange);
  for (const double smoothness : {-0.1, kNoValue, 1000.5})
    requireFailure([&] { (void)segmentSdf(mesh, withValue(1), {2, smoothness}); }, ErrorCode::OptionOutOfRange);
  requireFailure([&] { (void)postprocessSdf(Mesh{}, {}); }, ErrorCode::EmptyMesh);
  Mesh broken = mesh;
  broken.faces[3][1] = 99;
  requireFailure([&] { (void)postprocessSdf(broken, withValue(1)); }, ErrorCode::IndexOutOfRange);
  requireFailure([&] { (void)segmentSdf(broken, withValue(1), {2}); }, ErrorCode::IndexOutOfRange);
}

TEST_CASE("a requested stop ends both, and the filter reports progress") {
  const Mesh mesh = makeSphere(20000).mesh;
  Values values(mesh.faces.size());
  for (size_t face = 0; face < values.size(); ++face) values[face] = static_cast<double>(face % 101) / 100;
  std::stop_source source;
  RunControl control;
  control.stop = source.get_token();
  std::vector<double> fractions;
  control.progress = [&](double fraction) { fractions.push_back(fraction); };
  (void)postprocessSdf(mesh, values, control);
  CHECK(fractions.size() >= 3);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.back() == 1);
  control.progress = [&](double fraction) {
    if (fraction > 0) source.request_stop();
  };
  requireFailure([&] { (void)postprocessSdf(mesh, values, control); }, ErrorCode::Cancelled);
  requireFailure([&] { (void)segmentSdf(mesh, values, {}, CgalLabels::Segments, control); }, ErrorCode::Cancelled);
}
