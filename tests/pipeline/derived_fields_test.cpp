#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "core/random.h"
#include "core/vec3.h"
#include "generate/shapes.h"
#include "mesh/face_geometry.h"
#include "pipeline/skeleton_points.h"
#include "pipeline/vertex_fields.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::allSeeds;
using test::referenceSession;

namespace {

/// Two triangles of area 1 and 3 at the vertices 0 and 1, and vertex 4 without a face.
Mesh twoTriangles() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, -3, 0}, {9, 9, 9}};
  mesh.faces = {{0, 1, 2}, {0, 3, 1}};
  return mesh;
}

Field vertexField(const Mesh& mesh, Field::Values values, uint32_t componentCount = 1) {
  const std::vector<Field> fields{
      {.name = "a", .label = "A", .unit = "length", .componentCount = componentCount, .values = std::move(values)}};
  std::vector<Field> result = vertexFieldsOf(mesh, {}, computeFaceGeometry(mesh).areas, fields);
  REQUIRE(result.size() == 1);
  CHECK(result[0].name == "a");
  CHECK(result[0].label == "A");
  CHECK(result[0].unit == "length");
  CHECK(result[0].location == FieldLocation::PerVertex);
  CHECK(result[0].componentCount == componentCount);
  CHECK(result[0].itemCount() == mesh.vertices.size());
  return std::move(result[0]);
}

std::vector<double> means(const Mesh& mesh, std::vector<double> values, uint32_t componentCount = 1) {
  return *vertexField(mesh, std::move(values), componentCount).reals();
}

void checkEqual(const std::vector<double>& values, const std::vector<double>& expected) {
  REQUIRE(values.size() == expected.size());
  for (size_t i = 0; i < values.size(); ++i) {
    CAPTURE(i);
    if (std::isnan(expected[i])) {
      CHECK(std::isnan(values[i]));
    } else {
      CHECK(values[i] == doctest::Approx(expected[i]));
    }
  }
}

Vec3d centreOf(const Field& centres, size_t face) {
  return {centres.at(3 * face), centres.at(3 * face + 1), centres.at(3 * face + 2)};
}

/// A box of 2 x 2 x 1 whose six faces are quadrilaterals, facing outwards.
Mesh quadrilateralBox() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 0.5 : -0.5});
  const std::vector<std::array<uint32_t, 4>> quadrilaterals{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  mesh.polygons.firstCorner.push_back(0);
  for (const auto& [a, b, c, d] : quadrilaterals) {
    for (const uint32_t corner : {a, b, c, d}) mesh.polygons.corners.push_back(corner);
    mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.end(), 2,
                                     static_cast<uint32_t>(mesh.polygons.firstCorner.size() - 1));
    mesh.polygons.firstCorner.push_back(mesh.polygons.corners.size());
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
  }
  return mesh;
}

}  // namespace

TEST_CASE("the value of a vertex is the mean over its faces by area") {
  checkEqual(means(twoTriangles(), {4, 8}), {7, 7, 4, 8, kNoValue});
  checkEqual(means(twoTriangles(), {4, 8, -1, 0, 0, 3}, 3),
             {1, 2, 2, 1, 2, 2, 4, 8, -1, 0, 0, 3, kNoValue, kNoValue, kNoValue});
  // Exact for equal values.
  CHECK(means(makeTorus(800).mesh, std::vector<double>(makeTorus(800).mesh.faces.size(), 0.1)) ==
        std::vector<double>(makeTorus(800).mesh.vertices.size(), 0.1));
}

TEST_CASE("faces without a value do not count, and zero-area faces only where there is no other") {
  checkEqual(means(twoTriangles(), {kNoValue, 8}), {8, 8, kNoValue, 8, kNoValue});
  Mesh mesh = twoTriangles();
  mesh.faces.push_back({2, 0, 0});
  checkEqual(means(mesh, {4, 8, 100}), {7, 7, 4, 8, kNoValue});
  checkEqual(means(mesh, {kNoValue, 8, 100}), {8, 8, 100, 8, kNoValue});
}

TEST_CASE("the label of a vertex is the one with the largest area, its flag that of any face") {
  const auto labels = [](const Mesh& mesh, std::vector<uint32_t> values) {
    return std::get<std::vector<uint32_t>>(vertexField(mesh, std::move(values)).values);
  };
  CHECK(labels(twoTriangles(), {7, 2}) == std::vector<uint32_t>{2, 2, 7, 2, kNoSegment});
  CHECK(labels(twoTriangles(), {7, kNoSegment}) == std::vector<uint32_t>{7, 7, 7, kNoSegment, kNoSegment});
  Mesh fan = twoTriangles();  // Two more triangles of area 2 together exceed the one of area 3.
  fan.vertices.push_back({0, 2, 0});
  fan.faces.insert(fan.faces.end(), {{0, 1, 5}, {0, 1, 5}});
  CHECK(labels(fan, {9, 1, 9, 4})[0] == 1);  // 1 + 2, 3, 2: equal areas of 9 and 1.
  CHECK(labels(fan, {5, 1, 4, 4})[0] == 4);
  CHECK(std::get<std::vector<uint8_t>>(vertexField(twoTriangles(), std::vector<uint8_t>{1, 0}).values) ==
        std::vector<uint8_t>{1, 1, 1, 0, 0});
}

TEST_CASE("triangles of a polygon have its value and their own areas") {
  const Mesh mesh = quadrilateralBox();
  std::vector<double> values(6);
  for (size_t i = 0; i < 6; ++i) values[i] = static_cast<double>(i + 1);
  // Vertex 0: both triangles of the faces 0, 2 and 4, of areas 4, 2 and 2. Vertex 7: of the faces 1, 3 and 5.
  const std::vector<double> result = means(mesh, values);
  CHECK(result[0] == doctest::Approx((4 * 1 + 2 * 3 + 2 * 5) / 8.0));
  CHECK(result[7] == doctest::Approx((4 * 2 + 2 * 4 + 2 * 6) / 8.0));
  // Vertex 1: one triangle of each of the faces 0, 2 and 5.
  CHECK(result[1] == doctest::Approx((2 * 1 + 1 * 3 + 2 * 6) / 5.0));
}

TEST_CASE("fields per vertex follow those per face and have their names") {
  const Mesh mesh = makeAnimal(1000).mesh;
  Options options = test::tenthOfFaces();
  options.computesCentres = true;
  const Result plain = referenceSession().compute(mesh, options);
  options.per = PerElement::Vertices;
  const Result result = referenceSession().compute(mesh, options);
  const std::vector<std::string> names{"sdf", "seed", "error", "centre", "component"};
  REQUIRE(plain.fields.size() == 5);
  REQUIRE(result.fields.size() == 10);
  for (size_t i = 0; i < 5; ++i) {
    CHECK(result.fields[i].name == names[i]);
    CHECK(result.fields[i].values == plain.fields[i].values);
    CHECK(result.fields[5 + i].name == names[i]);
    CHECK(result.fields[5 + i].location == FieldLocation::PerVertex);
    CHECK(result.fields[5 + i].itemCount() == mesh.vertices.size());
  }
  CHECK(result.field("sdf") == &result.fields[0]);
  CHECK(findField(result.fields, "sdf", FieldLocation::PerVertex) == &result.fields[5]);
  CHECK(findField(plain.fields, "sdf", FieldLocation::PerVertex) == nullptr);
  const FieldSummary faces = summarize(result.fields[0]), vertices = summarize(result.fields[5]);
  CHECK(vertices.min >= faces.min);
  CHECK(vertices.max <= faces.max);
  CHECK(vertices.missingCount == 0);
}

TEST_CASE("fields per vertex have the same bits on any number of threads") {
  const Mesh mesh = makeTorus(20000).mesh;
  std::vector<double> values(mesh.faces.size());
  std::vector<uint32_t> labels(mesh.faces.size());
  Random random(3);
  for (size_t face = 0; face < values.size(); ++face) {
    values[face] = random.real();
    labels[face] = static_cast<uint32_t>(random.next() % 5);
  }
  const auto fieldsWith = [&](size_t threadCount) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threadCount);
    return std::pair(means(mesh, values), vertexField(mesh, labels).values);
  };
  const auto expected = fieldsWith(1);
  for (const size_t threadCount : {2, 5}) CHECK(fieldsWith(threadCount) == expected);
}

TEST_CASE("a skeleton point is half of the shape diameter below the barycentre") {
  const Mesh mesh = makeSphere(1280).mesh;
  Options options = allSeeds();
  CHECK(referenceSession().compute(mesh, options).field("centre") == nullptr);
  options.computesCentres = true;
  const Result result = referenceSession().compute(mesh, options);
  const Field* centre = result.field("centre");
  REQUIRE(centre != nullptr);
  CHECK(centre->componentCount == 3);
  CHECK(centre->unit == "length");
  REQUIRE(centre->itemCount() == mesh.faces.size());
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  for (size_t face = 0; face < mesh.faces.size(); ++face) {
    const Vec3d point = centreOf(*centre, face);
    CHECK(length(geometry.barycentres[face] - point) == doctest::Approx(result.sdf()[face] / 2));
    CHECK(length(point) == doctest::Approx(1 - result.sdf()[face] / 2).epsilon(0.02));
  }
}

TEST_CASE("the skeleton point of a polygon is below its middle") {
  const Mesh mesh = quadrilateralBox();
  Options options = allSeeds();
  options.computesCentres = true;
  const Result result = referenceSession().compute(mesh, options);
  const Field* centre = result.field("centre");
  REQUIRE(centre != nullptr);
  REQUIRE(centre->itemCount() == 6);
  const std::vector<Vec3d> outwards{{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  for (size_t i = 0; i < 6; ++i) {
    const Vec3d middle = i < 2 ? outwards[i] * 0.5 : outwards[i];
    CHECK(length(middle - outwards[i] * (result.sdf()[i] / 2) - centreOf(*centre, i)) < 1e-12);
  }
}

TEST_CASE("a face without a value or without a normal has no skeleton point") {
  Mesh mesh = twoTriangles();
  mesh.faces.push_back({0, 1, 1});
  const std::vector<double> centres =
      centresOfInputFaces(mesh, computeFaceGeometry(mesh), std::vector<double>{2, kNoValue, 2});
  const double third = 1.0 / 3;
  checkEqual(centres, {2 * third, third, -1, kNoValue, kNoValue, kNoValue, kNoValue, kNoValue, kNoValue});
  // Two triangles of one polygon that face each other.
  Mesh folded = twoTriangles();
  folded.faces = {{0, 1, 2}, {0, 2, 1}};
  folded.polygons = {{0, 4}, {0, 1, 2, 2}, {0, 0}};
  checkEqual(centresOfInputFaces(folded, computeFaceGeometry(folded), std::vector<double>{2}),
             {kNoValue, kNoValue, kNoValue});
}
