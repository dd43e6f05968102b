#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "generate/shapes.h"
#include "pipeline/average_error.h"
#include "pipeline/prepared_mesh.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/shapes.h"

using namespace asdfvk;
using test::allSeeds;
using test::referenceSession;
using test::requireFailure;

namespace {

/// The arrays of a caller.
struct Arrays {
  std::vector<double> positions;
  std::vector<uint32_t> corners;
  std::vector<uint64_t> firstCorner;

  explicit Arrays(const Mesh& mesh) {
    for (const Vec3d& vertex : mesh.vertices) positions.insert(positions.end(), {vertex.x, vertex.y, vertex.z});
    for (const Face& face : mesh.faces) corners.insert(corners.end(), face.begin(), face.end());
  }
  [[nodiscard]] MeshView triangles() const { return {positions, corners}; }
  [[nodiscard]] MeshView polygons() const { return {positions, corners, firstCorner}; }
  [[nodiscard]] std::vector<float> floats() const { return {positions.begin(), positions.end()}; }
};

/// A cube of six squares, counter-clockwise seen from outside.
Arrays squares() {
  Arrays cube(Mesh{});
  cube.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  cube.corners = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  for (uint64_t i = 0; i <= 6; ++i) cube.firstCorner.push_back(4 * i);
  return cube;
}

void reverse(Mesh& mesh, size_t begin, size_t end) {
  for (size_t face = begin; face < end; ++face) std::swap(mesh.faces[face][1], mesh.faces[face][2]);
}

void requireSameResult(const Result& a, const Result& b) {
  CHECK(test::haveSameBits(a.sdf(), b.sdf()));
  CHECK(a.seed() == b.seed());
  CHECK(test::haveSameBits(test::expectedErrors(a), test::expectedErrors(b)));
}

Options with(Orientation orientation) {
  Options options = test::tenthOfFaces();
  options.orientation = orientation;
  return options;
}

}  // namespace

TEST_CASE("arrays of double positions and triangles give the same bits as a Mesh") {
  const Mesh mesh = makeAnimal(2000).mesh;
  const Arrays arrays(mesh);
  requireSameResult(referenceSession().compute(arrays.triangles(), test::tenthOfFaces()),
                    referenceSession().compute(mesh, test::tenthOfFaces()));
}

TEST_CASE("double positions and triangles are used in place") {
  const Arrays arrays(makeTorus(400).mesh);
  const PreparedMesh prepared = prepareMesh(arrays.triangles(), Orientation::Keep);
  CHECK(static_cast<const void*>(prepared.mesh.vertices.data()) == arrays.positions.data());
  CHECK(static_cast<const void*>(prepared.mesh.faces.data()) == arrays.corners.data());
  CHECK(prepared.storage.vertices.empty());
  CHECK(prepared.storage.faces.empty());

  const Mesh mesh = makeTorus(400).mesh;
  const PreparedMesh ofMesh = prepareMesh(mesh, Orientation::Auto);  // Nothing is inverted.
  CHECK(ofMesh.mesh.vertices.data() == mesh.vertices.data());
  CHECK(ofMesh.mesh.faces.data() == mesh.faces.data());
}

TEST_CASE("float positions give the same bits as a Mesh of the same numbers in double") {
  const Arrays arrays(makeAnimal(2000).mesh);
  const std::vector<float> floats = arrays.floats();
  Arrays rounded = arrays;
  rounded.positions.assign(floats.begin(), floats.end());
  REQUIRE(rounded.positions != arrays.positions);
  const MeshView view(floats, arrays.corners);
  CHECK(view.vertexCount() == arrays.positions.size() / 3);
  requireSameResult(referenceSession().compute(view, test::tenthOfFaces()),
                    referenceSession().compute(rounded.triangles(), test::tenthOfFaces()));
}

TEST_CASE("polygons as arrays have one value per input face, in double and in float") {
  const Arrays cube = squares();
  const Result result = referenceSession().compute(cube.polygons(), allSeeds());
  CHECK(result.report.faceCount == 6);
  CHECK(result.report.triangleCount == 12);
  CHECK(result.report.vertexCount == 8);
  CHECK(result.report.noValueCount == 0);
  CHECK(result.report.warnings.empty());
  REQUIRE(result.sdf().size() == 6);
  CHECK(result.seed() == std::vector<uint8_t>(6, 1));
  for (const double value : result.sdf()) CHECK(value == doctest::Approx(1).epsilon(0.1));
  const std::vector<float> floats = cube.floats();
  const Result ofFloats = referenceSession().compute(MeshView(floats, cube.corners, cube.firstCorner), allSeeds());
  CHECK(test::haveSameBits(ofFloats.sdf(), result.sdf()));

  const PreparedMesh prepared = prepareMesh(cube.polygons(), Orientation::Keep);
  CHECK(static_cast<const void*>(prepared.mesh.vertices.data()) == cube.positions.data());
  Mesh mesh;  // A reader returns such a mesh.
  mesh.vertices.assign(prepared.mesh.vertices.begin(), prepared.mesh.vertices.end());
  mesh.faces.assign(prepared.mesh.faces.begin(), prepared.mesh.faces.end());
  const PolygonsView& polygons = prepared.mesh.polygons;
  mesh.polygons = {{polygons.firstCorner.begin(), polygons.firstCorner.end()},
                   {polygons.corners.begin(), polygons.corners.end()},
                   {polygons.inputFaceOf.begin(), polygons.inputFaceOf.end()}};
  CHECK(mesh.polygons.corners == cube.corners);
  CHECK(test::haveSameBits(referenceSession().compute(mesh, allSeeds()).sdf(), result.sdf()));
}

TEST_CASE("triangles as polygons of three corners give the same bits as triangles") {
  Arrays arrays(makeTorus(1000).mesh);
  for (uint64_t i = 0; i <= arrays.corners.size() / 3; ++i) arrays.firstCorner.push_back(3 * i);
  requireSameResult(referenceSession().compute(arrays.polygons(), test::tenthOfFaces()),
                    referenceSession().compute(arrays.triangles(), test::tenthOfFaces()));
}

TEST_CASE("input faces of fewer than three corners have no value and keep the order of the others") {
  Arrays cube = squares();
  cube.corners.insert(cube.corners.begin(), {0, 1});
  cube.firstCorner.assign({0, 2});
  for (uint64_t i = 1; i <= 6; ++i) cube.firstCorner.push_back(2 + 4 * i);
  cube.firstCorner.push_back(cube.firstCorner.back());  // No corner at all.
  const Result result = referenceSession().compute(cube.polygons(), allSeeds());
  REQUIRE(result.sdf().size() == 8);
  CHECK(std::isnan(result.sdf().front()));
  CHECK(std::isnan(result.sdf().back()));
  CHECK(result.report.noValueCount == 2);
  CHECK(result.report.defects.shortPolygonCount == 2);
}

TEST_CASE("sizes that do not fit are ArraySize") {
  const Arrays torus(makeTorus(400).mesh);
  const auto compute = [](const MeshView& view) { return [view] { (void)referenceSession().compute(view); }; };
  for (const size_t lost : {1u, 2u}) {
    Arrays arrays = torus;
    arrays.positions.resize(arrays.positions.size() - lost);
    requireFailure(compute(arrays.triangles()), ErrorCode::ArraySize, "positions");
    const std::vector<float> floats = arrays.floats();
    requireFailure(compute(MeshView(floats, arrays.corners)), ErrorCode::ArraySize, "positions");
    arrays = torus;
    arrays.corners.resize(arrays.corners.size() - lost);
    requireFailure(compute(arrays.triangles()), ErrorCode::ArraySize, "triangle indices");
  }
  const auto withFirstCorners = [&](std::vector<uint64_t> firstCorner) {
    Arrays cube = squares();
    cube.firstCorner = std::move(firstCorner);
    requireFailure(compute(cube.polygons()), ErrorCode::ArraySize, "0 to 24");
  };
  withFirstCorners({1, 24});                // Does not begin at 0.
  withFirstCorners({0, 23});                // Ends before the last corner.
  withFirstCorners({0, 25});                // Ends after it.
  withFirstCorners({0, 8, 4, 24});          // Descends.
  withFirstCorners({0, ~uint64_t{0}, 24});  // Descends from the largest number.
  Mesh mesh = makeCube(12).mesh;
  mesh.polygons = {{0, 3}, {0, 1, 2}, {0, 0}};  // Twelve triangles, but two of input faces.
  requireFailure(compute(mesh), ErrorCode::ArraySize, "input face");
  mesh = makeCube(12).mesh;
  mesh.polygons = {{0, 3, 6}, {0, 1, 2, 0, 2, 3}, std::vector<uint32_t>(12, 1)};
  CHECK(referenceSession().compute(mesh).sdf().size() == 2);
  mesh.polygons.inputFaceOf.back() = 2;  // Beyond the last input face.
  requireFailure(compute(mesh), ErrorCode::ArraySize, "from 0 to 1");
  mesh.polygons.inputFaceOf.back() = 0;  // Descends.
  requireFailure(compute(mesh), ErrorCode::ArraySize, "from 0 to 1");
  mesh.polygons.inputFaceOf.clear();
  mesh.faces.clear();
  requireFailure(compute(mesh), ErrorCode::EmptyMesh, "no triangles");
}

TEST_CASE("more faces or vertices than 32 bits can index are MeshTooLarge") {
  // The sizes are checked before any entry is read: the arrays behind these spans are short.
  const Arrays torus(makeTorus(400).mesh);
  constexpr size_t kTooManyCorners = (size_t{1} << 32) + 2, kTooManyCoordinates = size_t{3} << 32;
  const std::span<const uint32_t> corners(torus.corners.data(), kTooManyCorners);
  const std::span<const double> positions(torus.positions.data(), kTooManyCoordinates);
  requireFailure([&] { (void)referenceSession().compute(MeshView(torus.positions, corners)); }, ErrorCode::MeshTooLarge,
                 "1431655766 faces; at most 1431655765");
  requireFailure([&] { (void)referenceSession().compute(MeshView(positions, torus.corners)); }, ErrorCode::MeshTooLarge,
                 "4294967296 vertices; at most 4294967295");
}

TEST_CASE("an index out of range is IndexOutOfRange, with the number of faces") {
  const auto compute = [](const MeshView& view) { return [view] { (void)referenceSession().compute(view); }; };
  Arrays torus(makeTorus(400).mesh);
  const auto vertexCount = static_cast<uint32_t>(torus.positions.size() / 3);
  torus.corners[0] = torus.corners[2] = vertexCount;
  torus.corners.back() = ~uint32_t{0};
  requireFailure(compute(torus.triangles()), ErrorCode::IndexOutOfRange, "2 faces with a vertex that does not exist");
  const std::vector<float> floats = torus.floats();
  requireFailure(compute(MeshView(floats, torus.corners)), ErrorCode::IndexOutOfRange, "2 faces");

  Arrays cube = squares();
  cube.corners[5] = 8;
  requireFailure(compute(cube.polygons()), ErrorCode::IndexOutOfRange,
                 "1 face with a vertex that does not exist: the mesh has 8 vertices");
  Arrays shortFace = squares();  // Also where no triangle has the corner.
  shortFace.corners.push_back(8);
  shortFace.firstCorner.push_back(25);
  requireFailure(compute(shortFace.polygons()), ErrorCode::IndexOutOfRange, "1 face");
  requireFailure(compute(MeshView(std::span<const double>(), cube.corners)), ErrorCode::IndexOutOfRange, "8 faces");
}

TEST_CASE("arrays without a face are EmptyMesh") {
  const Arrays cube = squares();
  const std::vector<uint64_t> noPolygons{0};
  requireFailure([&] { (void)referenceSession().compute(MeshView(cube.positions, {})); }, ErrorCode::EmptyMesh);
  requireFailure([&] { (void)referenceSession().compute(MeshView(cube.positions, {}, noPolygons)); },
                 ErrorCode::EmptyMesh);
  const std::vector<uint32_t> corners{0, 1, 2, 3};
  const std::vector<uint64_t> allShort{0, 2, 4};
  requireFailure([&] { (void)referenceSession().compute(MeshView(cube.positions, corners, allShort)); },
                 ErrorCode::EmptyMesh, "three corners");
}

TEST_CASE("faces are reversed in a copy: the arrays of the caller do not change, and the report has the faces") {
  const Mesh torus = makeTorus(1000).mesh;
  Mesh mesh = shapes::joined(torus, makeSphere(320).mesh, {8, 0, 0});
  const size_t torusCount = torus.faces.size();
  const Mesh correct = mesh;
  reverse(mesh, torusCount, mesh.faces.size());
  const Arrays arrays(mesh), before = arrays;
  std::vector<uint64_t> sphereFaces(mesh.faces.size() - torusCount), allFaces(mesh.faces.size());
  std::iota(sphereFaces.begin(), sphereFaces.end(), torusCount);
  std::iota(allFaces.begin(), allFaces.end(), 0);

  const Result kept = referenceSession().compute(arrays.triangles(), with(Orientation::Keep));
  CHECK(kept.reversedFaces.empty());
  CHECK(test::findWarning(kept.report, WarningCode::InvertedComponents) != nullptr);
  const Result reversed = referenceSession().compute(arrays.triangles(), with(Orientation::Auto));
  CHECK(reversed.reversedFaces == sphereFaces);
  CHECK(test::findWarning(reversed.report, WarningCode::ComponentsReversed) != nullptr);
  CHECK(test::findWarning(reversed.report, WarningCode::InvertedComponents) == nullptr);
  requireSameResult(reversed, referenceSession().compute(correct, test::tenthOfFaces()));
  const Result flipped = referenceSession().compute(arrays.triangles(), with(Orientation::Flip));
  CHECK(flipped.reversedFaces == allFaces);
  CHECK(arrays.positions == before.positions);
  CHECK(arrays.corners == before.corners);

  const std::vector<float> floats = arrays.floats();
  CHECK(referenceSession().compute(MeshView(floats, arrays.corners), with(Orientation::Auto)).reversedFaces ==
        sphereFaces);
}

TEST_CASE("reversed polygons are reported by input face, once for all of their triangles") {
  Arrays cube = squares();
  for (size_t i = 0; i < 6; ++i) std::reverse(cube.corners.begin() + 4 * i, cube.corners.begin() + 4 * i + 4);
  const Arrays before = cube;
  Options options = allSeeds();
  CHECK(referenceSession().compute(cube.polygons(), options).report.noValueCount == 6);
  for (const Orientation orientation : {Orientation::Auto, Orientation::Flip}) {
    options.orientation = orientation;
    const Result result = referenceSession().compute(cube.polygons(), options);
    CHECK(result.reversedFaces == std::vector<uint64_t>{0, 1, 2, 3, 4, 5});
    CHECK(result.report.noValueCount == 0);
    CHECK(cube.corners == before.corners);
    CHECK(cube.firstCorner == before.firstCorner);
  }
}

TEST_CASE("a polygon whose first triangle collapses is reported as reversed, too") {
  Arrays cube = squares();
  cube.corners.insert(cube.corners.begin() + 1, cube.corners[1]);  // The first square begins 0 3 3 2 1.
  for (uint64_t i = 1; i <= 6; ++i) ++cube.firstCorner[i];
  CHECK(prepareMesh(cube.polygons(), Orientation::Flip).reversedFaces == std::vector<uint64_t>{0, 1, 2, 3, 4, 5});
}
