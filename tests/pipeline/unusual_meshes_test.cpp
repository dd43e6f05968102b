// Components, defects, polygons, orientation and places of meshes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::allSeeds;
using test::findWarning;
using test::referenceSession;
using test::requireFailure;
using test::vulkanSession;

namespace {

/// Two spheres that do not touch.
Mesh twoSpheres(uint64_t faceCount, uint64_t smallFaceCount) {
  return shapes::joined(makeSphere(faceCount).mesh, shapes::scaledAndShifted(makeSphere(smallFaceCount).mesh, 0.5),
                        {4, 0, 0});
}

}  // namespace

TEST_CASE("a component without a seed gets one") {
  const Mesh mesh = twoSpheres(5000, 20);
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::ofCount(3);
  const Result result = vulkanSession().compute(mesh, options);
  CHECK(result.report.componentCount == 2);
  CHECK(result.report.noValueCount == 0);
  for (size_t f = makeSphere(5000).mesh.faces.size(); f < mesh.faces.size(); ++f) CHECK(result.sdf()[f] < 1.01);
}

TEST_CASE("a component without any valid ray has no value, and a warning has the number of its faces") {
  Mesh mesh = makeSphere(500).mesh;
  mesh.vertices.insert(mesh.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  const auto v = static_cast<uint32_t>(mesh.vertices.size());
  mesh.faces.push_back({v - 3, v - 2, v - 1});
  const Result result = vulkanSession().compute(mesh, test::tenthOfFaces());
  CHECK(std::isnan(result.sdf().back()));
  CHECK(result.report.noValueCount == 1);
  const Warning* warning = findWarning(result.report, WarningCode::MissingValues);
  REQUIRE(warning != nullptr);
  CHECK(warning->message.starts_with("1 of 501 faces without a value"));
}

TEST_CASE("a sphere twice in the file, each with vertices of its own, has the plain sphere's values") {
  const Mesh sphere = makeSphere(500).mesh;
  const auto count = static_cast<std::ptrdiff_t>(sphere.faces.size());
  const std::vector<double> expected = referenceSession().compute(sphere, allSeeds()).sdf();
  const auto twice = [&](bool isCopyInverted) {
    Mesh mesh = sphere;
    mesh.vertices.insert(mesh.vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
    const auto offset = static_cast<uint32_t>(sphere.vertices.size());
    for (auto [a, b, c] : sphere.faces) {
      if (isCopyInverted) std::swap(b, c);
      mesh.faces.push_back({a + offset, b + offset, c + offset});
    }
    return mesh;
  };
  for (const bool isCopyInverted : {false, true}) {
    CAPTURE(isCopyInverted);
    const Mesh mesh = twice(isCopyInverted);
    const Result result = referenceSession().compute(mesh, allSeeds());
    CHECK(std::equal(expected.begin(), expected.end(), result.sdf().begin()));
    if (isCopyInverted) {
      CHECK(std::all_of(result.sdf().begin() + count, result.sdf().end(), [](double v) { return std::isnan(v); }));
    } else {
      CHECK(std::equal(expected.begin(), expected.end(), result.sdf().begin() + count));
    }
    CHECK(result.report.defects.duplicateFaceCount == (isCopyInverted ? 0 : sphere.faces.size()));
  }
}

TEST_CASE("the warning about missing values has the likely causes: open surface, inverted component, both or none") {
  const auto causeOn = [](const Mesh& mesh) {
    const Result result = referenceSession().compute(mesh, allSeeds());
    const Warning* warning = findWarning(result.report, WarningCode::MissingValues);
    REQUIRE(warning != nullptr);
    CAPTURE(warning->message);
    CHECK(warning->message.starts_with(std::to_string(mesh.faces.size()) + " of "));
    CHECK(warning->message.find("--") == std::string::npos);  // Options belong to the command line.
    const auto cause = std::find_if(warning->details.begin(), warning->details.end(),
                                    [](const ErrorDetail& detail) { return detail.name == "cause"; });
    return cause == warning->details.end() ? std::string() : cause->value;
  };
  const Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  CHECK(causeOn(triangle) == "open");
  Mesh inverted = makeSphere(20).mesh;
  for (Face& face : inverted.faces) std::swap(face[1], face[2]);
  CHECK(causeOn(inverted) == "inverted");
  Mesh line = triangle;
  line.vertices[2] = {2, 0, 0};
  CHECK(causeOn(line).empty());

  Mesh both = inverted;
  both.vertices.insert(both.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  both.faces.push_back({12, 13, 14});
  CHECK(causeOn(both) == "inverted or open");
}

TEST_CASE("the warning about missing values counts polygons, and has the causes of their triangles") {
  Mesh mesh = makeSphere(20).mesh;
  const auto sphereFaceCount = static_cast<uint32_t>(mesh.faces.size());
  mesh.polygons.firstCorner = {0};
  const auto addPolygon = [&](std::initializer_list<uint32_t> corners) {
    mesh.polygons.corners.insert(mesh.polygons.corners.end(), corners);
    mesh.polygons.firstCorner.push_back(mesh.polygons.corners.size());
  };
  for (uint32_t face = 0; face < sphereFaceCount; ++face) {
    const auto [a, b, c] = mesh.faces[face];
    mesh.polygons.inputFaceOf.push_back(face);
    addPolygon({a, b, c});
  }
  const auto first = static_cast<uint32_t>(mesh.vertices.size());  // A square far from the sphere.
  mesh.vertices.insert(mesh.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}});
  mesh.faces.push_back({first, first + 1, first + 2});
  mesh.faces.push_back({first, first + 2, first + 3});
  mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.end(), 2, sphereFaceCount);
  addPolygon({first, first + 1, first + 2, first + 3});
  const Result result = referenceSession().compute(mesh, allSeeds());
  const Warning* warning = findWarning(result.report, WarningCode::MissingValues);
  REQUIRE(warning != nullptr);
  CAPTURE(warning->message);
  CHECK(warning->message.starts_with("1 of " + std::to_string(sphereFaceCount + 1)));
  CHECK(std::ranges::any_of(
      warning->details, [](const ErrorDetail& detail) { return detail.name == "cause" && detail.value == "open"; }));
}

TEST_CASE("degenerate faces are interpolated and the count of faces stays") {
  Mesh mesh = makeSphere(500).mesh;
  const Face first = mesh.faces[0];
  mesh.faces.push_back({first[0], first[0], first[1]});
  mesh.faces.push_back({first[0], first[1], first[1]});
  const Result result = vulkanSession().compute(mesh, allSeeds());
  CHECK(result.sdf().size() == mesh.faces.size());
  CHECK(result.seed().back() == 0);
  CHECK(result.report.defects.zeroAreaFaceCount == 2);
  CHECK(result.report.seedCount == mesh.faces.size() - 2);
}

TEST_CASE("a mesh of polygons has one value per input face") {
  Mesh mesh = makeCube(12).mesh;  // two triangles a side, in order
  mesh.polygons.firstCorner = {0};
  for (uint32_t side = 0; side < 6; ++side) {
    const Face a = mesh.faces[2 * side], b = mesh.faces[2 * side + 1];
    for (const uint32_t vertex : {a[0], a[1], a[2]}) mesh.polygons.corners.push_back(vertex);
    for (const uint32_t vertex : b)
      if (std::find(a.begin(), a.end(), vertex) == a.end()) mesh.polygons.corners.push_back(vertex);
    mesh.polygons.firstCorner.push_back(mesh.polygons.corners.size());
    mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.end(), {side, side});
  }
  const Result result = referenceSession().compute(mesh, allSeeds());
  CHECK(result.sdf().size() == 6);
  CHECK(result.report.faceCount == 6);
  CHECK(result.report.triangleCount == 12);
  const Result each = referenceSession().compute(makeCube(12).mesh, allSeeds());
  for (size_t side = 0; side < 6; ++side)
    CHECK(result.sdf()[side] == doctest::Approx(0.5 * (each.sdf()[2 * side] + each.sdf()[2 * side + 1])));
}

TEST_CASE("a warning names an inverted sphere, which is reversed on request; the input does not change") {
  const Mesh sphere = makeSphere(500).mesh;
  Mesh mesh = sphere;
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  const Mesh inverted = mesh;
  const Result kept = vulkanSession().compute(mesh, test::tenthOfFaces());
  CHECK(kept.report.noValueCount == 500);
  CHECK(kept.reversedFaces.empty());
  CHECK(findWarning(kept.report, WarningCode::InvertedComponents) != nullptr);
  CHECK(findWarning(kept.report, WarningCode::ComponentsReversed) == nullptr);
  const std::vector<double> expected = vulkanSession().compute(sphere, test::tenthOfFaces()).sdf();
  for (const Orientation orientation : {Orientation::Auto, Orientation::Flip}) {
    Options options = test::tenthOfFaces();
    options.orientation = orientation;
    const Result reversed = vulkanSession().compute(mesh, options);
    CHECK(reversed.report.noValueCount == 0);
    CHECK(reversed.sdf() == expected);
    CHECK(reversed.reversedFaces.size() == 500);
    CHECK(findWarning(reversed.report, WarningCode::InvertedComponents) == nullptr);
    CHECK((findWarning(reversed.report, WarningCode::ComponentsReversed) != nullptr) ==
          (orientation == Orientation::Auto));
    CHECK(mesh.faces == inverted.faces);
    CHECK(mesh.vertices == inverted.vertices);
  }
}

TEST_CASE("a mesh without faces, and one with an index out of range, are errors of the input") {
  requireFailure([] { (void)referenceSession().compute(Mesh{}); }, ErrorCode::EmptyMesh, "no faces");
  Mesh broken = makeSphere(20).mesh;
  broken.faces[3][1] = 12;
  requireFailure([&] { (void)referenceSession().compute(broken); }, ErrorCode::IndexOutOfRange,
                 "1 face with a vertex that does not exist: the mesh has 12 vertices");
}

TEST_CASE("a mesh that is all degenerate has no values and is no error") {
  Mesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.faces = {{0, 1, 2}, {2, 1, 0}};
  const Result result = vulkanSession().compute(line, test::tenthOfFaces());
  CHECK(result.report.noValueCount == 2);
  CHECK(result.report.seedCount == 0);
}

TEST_CASE("a few faces with most of the range are a warning where errors over the range are reported") {
  Mesh mesh = makeAnimal(3000).mesh;
  Options options = test::tenthOfFaces();
  CHECK(findWarning(referenceSession().compute(mesh, options).report, WarningCode::RangeDominated) == nullptr);
  const Mesh large = shapes::scaledAndShifted(makeSphere(20).mesh, 50, {200, 0, 0});
  const auto offset = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), large.vertices.begin(), large.vertices.end());
  for (const auto& [a, b, c] : large.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  const Result result = referenceSession().compute(mesh, options);
  const Warning* warning = findWarning(result.report, WarningCode::RangeDominated);
  REQUIRE(warning != nullptr);
  REQUIRE(warning->details.size() == 1);
  CHECK(warning->details[0].name == "robustShare");
  const ValueRange& range = result.report.sdf;
  CHECK(std::stod(warning->details[0].value) ==
        doctest::Approx(range.robustRange() / (range.max - range.min)).epsilon(1e-3));
  REQUIRE(result.report.estimatedError);
  CHECK(result.report.estimatedError->robustAverage > 10 * result.report.estimatedError->average);
  options.estimatesError = false;
  CHECK(findWarning(referenceSession().compute(mesh, options).report, WarningCode::RangeDominated) == nullptr);
  options.checkCount = 10;
  CHECK(findWarning(referenceSession().compute(mesh, options).report, WarningCode::RangeDominated) != nullptr);
}

TEST_CASE("a mesh that double precision does not resolve at its place is refused on every backend") {
  const auto at = [](double shift) { return shapes::scaledAndShifted(shapes::sphere(2), 1, {shift, 2 * shift, 0}); };
  for (Session* const session : test::allSessions()) {
    CAPTURE(session->backend());
    for (const double shift : {1e13, -1e15})
      requireFailure([&] { (void)session->compute(at(shift)); }, ErrorCode::FarFromOrigin, "too far from the origin");
    const std::vector<double> here = session->compute(at(0), allSeeds()).sdf(),
                              far = session->compute(at(1e8), allSeeds()).sdf();
    for (size_t face = 0; face < here.size(); ++face) CHECK(far[face] == doctest::Approx(here[face]).epsilon(1e-4));
  }
  // Faces without area have no place.
  Mesh point = shapes::tetrahedron();
  for (Vec3d& vertex : point.vertices) vertex = {1e13, 0, 0};
  CHECK(std::isnan(referenceSession().compute(point).sdf()[0]));
}
