#include "segment/parts.h"
#include "segment/assembly_parts.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "generate/analytic_shapes.h"
#include "generate/shapes.h"
#include "part_samples.h"
#include "segment/rand_index.h"
#include "support/require_failure.h"
#include "support/shapes.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

using Labels = std::vector<uint32_t>;

struct Creature {
  CapsuleUnion field;
  GeneratedShape shape;
  PartSample sample;

  explicit Creature(const CapsuleUnion& capsules, GeneratedShape made)
      : field(capsules), shape(std::move(made)), sample(shape.mesh, diametersOf(shape)) {}

  [[nodiscard]] Parts segment(const PartsOptions& options = {}) const {
    return segmentIntoParts(sample.input(), options, sightInside(field));
  }
};

const Creature& animal() {
  static const Creature creature(animalField(), makeAnimal(3000));
  return creature;
}

const Parts& animalParts() {
  static const Parts parts = animal().segment();
  return parts;
}

Parts segment(Mesh mesh, std::vector<double> values, const PartsOptions& options = {}) {
  const PartSample sample(std::move(mesh), std::move(values));
  return segmentIntoParts(sample.input(), options, seeEverything);
}

/// The value 1 at every face.
Parts segment(const Mesh& mesh, const PartsOptions& options = {}) {
  return segment(mesh, std::vector<double>(mesh.faces.size(), 1.0), options);
}

void checkParts(const Parts& parts, size_t faceCount) {
  CHECK(parts.partOf.size() == faceCount);
  CHECK(areConsecutive(parts.partOf, parts.partCount));
  CHECK(parts.fewest <= parts.partCount);
  CHECK(parts.most >= parts.partCount);
  CHECK(parts.agreement.value_or(0) >= 0);
  CHECK(parts.agreement.value_or(1) <= 1);
}

}  // namespace

TEST_CASE("the parts of creatures are those that they were made of") {
  struct Case {
    const char* name;
    CapsuleUnion field;
    GeneratedShape shape;
    double error;
  };
  for (const Case& c :
       {Case{"animal", animalField(), makeAnimal(3000), 0.08}, Case{"hand", handField(), makeHand(3000), 0.19},
        Case{"figure", figureField(), makeFigure(3000), 0.10}}) {
    CAPTURE(c.name);
    const PartSample sample(c.shape.mesh, diametersOf(c.shape));
    const Parts parts = segmentIntoParts(sample.input(), {}, sightInside(c.field));
    checkParts(parts, c.shape.part.size());
    CHECK(1 - randIndex(parts.partOf, c.shape.part) < c.error);
    CHECK(parts.agreement.value_or(0) > 0.8);
    CHECK_FALSE(parts.isThinShell);
  }
}

TEST_CASE("a requested number of parts is met") {
  for (const uint32_t count : {1u, 2u, 9u, 40u}) {
    CAPTURE(count);
    const Parts parts = animal().segment({.partCount = count});
    checkParts(parts, animal().shape.part.size());
    CHECK(parts.partCount == count);
  }
}

TEST_CASE("more detail gives more parts") {
  uint32_t last = 0;
  for (const double detail : {0.1, 1.0, 10.0}) {
    const Parts parts = animal().segment({.detail = detail});
    checkParts(parts, animal().shape.part.size());
    if (detail > 0.1) CHECK(parts.partCount > last);
    last = parts.partCount;
  }
}

TEST_CASE("parts are connected and not smaller than a share of the area") {
  for (const double detail : {1.0, 10.0}) {
    const Parts parts = detail > 1 ? animal().segment({.detail = detail}) : animalParts();
    std::vector<double> areas(parts.partCount, 0);
    double sum = 0;
    for (uint32_t face = 0; face < parts.partOf.size(); ++face) {
      areas[parts.partOf[face]] += animal().sample.geometry.areas[face];
      sum += animal().sample.geometry.areas[face];
    }
    // The graph cut may take some of it.
    for (const double area : areas) CHECK(area > 0.7 * kMinPartArea * sum);
  }
  const Parts& parts = animalParts();
  // There are as many connected pieces as parts.
  Labels pieces(parts.partOf.size(), 0);
  uint32_t pieceCount = 0;
  for (uint32_t first = 0; first < pieces.size(); ++first) {
    if (pieces[first] != 0) continue;
    ++pieceCount;
    Labels stack{first};
    pieces[first] = pieceCount;
    while (!stack.empty()) {
      const uint32_t face = stack.back();
      stack.pop_back();
      for (const uint32_t other : animal().sample.edges.graph.neighboursOf(face))
        if (pieces[other] == 0 && parts.partOf[other] == parts.partOf[face]) {
          pieces[other] = pieceCount;
          stack.push_back(other);
        }
    }
  }
  CHECK(pieceCount == parts.partCount);
}

TEST_CASE("parts ascend by their mean value") {
  const Parts& parts = animalParts();
  std::vector<double> sums(parts.partCount, 0), areas(parts.partCount, 0);
  for (uint32_t face = 0; face < parts.partOf.size(); ++face) {
    const double area = animal().sample.geometry.areas[face];
    sums[parts.partOf[face]] += area * animal().sample.values[face];
    areas[parts.partOf[face]] += area;
  }
  for (uint32_t part = 1; part < parts.partCount; ++part)
    CHECK(sums[part] / areas[part] > sums[part - 1] / areas[part - 1]);
}

TEST_CASE("the same parts on one thread and on many, and with a power of two as the unit") {
  const auto onThreads = [&](size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return animal().segment();
  };
  const Parts expected = animalParts(), parallel = onThreads(4);
  CHECK(onThreads(1).partOf == expected.partOf);
  CHECK(parallel.partOf == expected.partOf);
  CHECK(parallel.agreement == expected.agreement);
  for (const int exponent : {-600, 600}) {
    CAPTURE(exponent);
    Mesh mesh = animal().shape.mesh;
    for (Vec3d& v : mesh.vertices) v = v * std::ldexp(1.0, exponent);
    std::vector<double> values = animal().sample.values;
    for (double& value : values) value = std::ldexp(value, exponent);
    const PartSample sample(std::move(mesh), std::move(values));
    const LineOfSight inside = sightInside(animal().field);
    const Parts parts = segmentIntoParts(sample.input(), {}, [&](std::span<const LineSegment> segments) {
      std::vector<LineSegment> scaled(segments.begin(), segments.end());
      for (LineSegment& s : scaled) s = {s.from * std::ldexp(1.0, -exponent), s.to * std::ldexp(1.0, -exponent)};
      return inside(scaled);
    });
    CHECK(parts.partOf == expected.partOf);
    CHECK(parts.areas == expected.areas);
  }
}

TEST_CASE("missing values, zero values and holes change little") {
  const Labels& expected = animalParts().partOf;
  std::vector<double> values = animal().sample.values;
  for (size_t face = 0; face < values.size(); face += 3) values[face] = std::nan("");
  values[1] = 0;
  const PartSample gaps(animal().shape.mesh, values);
  CHECK(randIndex(segmentIntoParts(gaps.input(), {}, sightInside(animal().field)).partOf, expected) > 0.9);
  Mesh open = animal().shape.mesh;
  open.faces.resize(open.faces.size() - 100);
  values = animal().sample.values;
  values.resize(open.faces.size());
  const PartSample hole(open, values);
  const Parts parts = segmentIntoParts(hole.input(), {}, sightInside(animal().field));
  checkParts(parts, open.faces.size());
  CHECK(randIndex(parts.partOf, Labels(expected.begin(), expected.begin() + static_cast<int>(open.faces.size()))) >
        0.95);
}

TEST_CASE("a part does not extend over components, unless they are small") {
  Mesh mesh = makeSphere(320).mesh;
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(makeSphere(80).mesh, 0.5), {4, 0, 0});
  // This sphere has a thousandth of the area, and is near the first one.
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(makeSphere(20).mesh, 0.05), {0, 0, 1.1});
  // An equal sphere is near the second one.
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(makeSphere(20).mesh, 0.05), {4, 0, -0.6});
  const Parts parts = segment(mesh);
  checkParts(parts, mesh.faces.size());
  CHECK(parts.partCount == 2);
  CHECK(parts.partOf[320 + 80] == parts.partOf[0]);
  CHECK(parts.partOf[320 + 80 + 20] == parts.partOf[320]);
  CHECK(parts.partOf[320] != parts.partOf[0]);
  CHECK(segment(mesh, PartsOptions{.partCount = 1}).partCount == 2);
}

TEST_CASE("equal objects are a part each, though one of them is a little larger") {
  const Mesh tetrahedron{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
  Mesh mesh;
  for (int i = 0; i < 121; ++i)
    mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(tetrahedron, i == 60 ? 1.2 : 1),
                          {2.0 * (i % 11), 2.0 * (i / 11), 0});
  // This tetrahedron is far below 1 % of the largest one.
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(tetrahedron, 0.01), {-0.1, 0, 0});
  const Parts parts = segment(mesh);
  checkParts(parts, mesh.faces.size());
  CHECK(parts.partCount == 121);
  CHECK(parts.fewest == 121);
  for (size_t face = 0; face < mesh.faces.size() - 4; ++face) CHECK(parts.partOf[face] == parts.partOf[face / 4 * 4]);
  CHECK(parts.partOf.back() == parts.partOf[0]);
  CHECK(segment(mesh, PartsOptions{.partCount = 100}).partCount == 121);
  const Parts divided = segment(mesh, PartsOptions{.partCount = 122});
  checkParts(divided, mesh.faces.size());
  CHECK(divided.partCount == 122);
}

TEST_CASE("a soup of small components has a part for each") {
  Mesh soup;
  for (int i = 0; i < 150; ++i)
    soup = shapes::joined(std::move(soup), Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}, {2.0 * i, 0, 0});
  const Parts parts = segment(soup);
  checkParts(parts, 150);
  CHECK(parts.partCount == 150);
  CHECK_FALSE(parts.agreement.has_value());
}

TEST_CASE("two faces, a tetrahedron, needles, duplicates, a fan of many faces, and broken faces have parts") {
  std::vector<Mesh> meshes;
  meshes.push_back({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}});
  meshes.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}, {}});
  meshes.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}});
  Mesh needles = makeSphere(320).mesh;
  for (Vec3d& v : needles.vertices) v = {v.x * 1e6, v.y, v.z * 1e-3};
  meshes.push_back(needles);
  Mesh doubled = makeSphere(80).mesh;
  doubled.faces.insert(doubled.faces.end(), doubled.faces.begin(), doubled.faces.begin() + 80);
  meshes.push_back(doubled);
  Mesh fan{{{0, 0, 0}, {0, 0, 1}}, {}, {}};  // 60 faces at one edge.
  for (uint32_t i = 0; i < 60; ++i) {
    fan.vertices.push_back({std::cos(i * 0.1), std::sin(i * 0.1), 0.5});
    fan.faces.push_back({0, 1, 2 + i});
  }
  meshes.push_back(fan);
  Mesh broken = makeSphere(80).mesh;
  broken.vertices[3] = {std::nan(""), 0, INFINITY};
  broken.faces.push_back({0, 0, 1});
  broken.faces.push_back({5, 5, 5});
  meshes.push_back(broken);
  for (const Mesh& mesh : meshes) {
    CAPTURE(mesh.faces.size());
    checkParts(segment(mesh), mesh.faces.size());
    const Parts three = segment(mesh, PartsOptions{.partCount = 3});
    checkParts(three, mesh.faces.size());
    std::vector<double> values(mesh.faces.size(), 0.0);
    checkParts(segment(mesh, values), mesh.faces.size());
    values.assign(mesh.faces.size(), std::nan(""));
    values[0] = 2;
    checkParts(segment(mesh, values), mesh.faces.size());
  }
}

TEST_CASE("a mesh without any value is an error of the input") {
  requireFailure([] { (void)segment(makeSphere(80).mesh, std::vector<double>(80, std::nan(""))); }, ErrorCode::NoValues,
                 "no face has a value");
}

TEST_CASE("a wall around a cavity is a thin shell; a plate, a tube and a ball are none") {
  const auto blocked = [](std::span<const LineSegment> segments) { return std::vector<uint8_t>(segments.size(), 0); };
  const auto isShell = [](const Mesh& mesh, double value, const LineOfSight& sight) {
    const PartSample sample(mesh, std::vector<double>(mesh.faces.size(), value));
    return segmentIntoParts(sample.input(), {}, sight).isThinShell;
  };
  Mesh bowl = makeSphere(1280).mesh;
  Mesh inside = makeSphere(1280).mesh;
  for (Face& face : inside.faces) std::swap(face[1], face[2]);
  bowl = shapes::joined(std::move(bowl), shapes::scaledAndShifted(inside, 0.9));
  CHECK(isShell(bowl, 0.125, blocked));
  CHECK_FALSE(isShell(bowl, 0.125, seeEverything));
  CHECK_FALSE(isShell(makeSlab(1000).mesh, 0.125, seeEverything));
  CHECK_FALSE(isShell(makeCylinder(1000).mesh, 0.45, blocked));
  CHECK_FALSE(isShell(makeSphere(320).mesh, 1.72, blocked));
}

TEST_CASE("an assembly is a thin shell if one of its components is") {
  const auto blocked = [](std::span<const LineSegment> segments) { return std::vector<uint8_t>(segments.size(), 0); };
  Mesh inside = makeSphere(1280).mesh;
  for (Face& face : inside.faces) std::swap(face[1], face[2]);
  const Mesh bowl = shapes::joined(makeSphere(1280).mesh, shapes::scaledAndShifted(inside, 0.9)),
             ball = makeSphere(320).mesh;
  const auto isShell = [&](const Mesh& mesh, std::vector<double> values) {
    const PartSample sample(mesh, std::move(values));
    return segmentAssembly(sample.input(), {}, blocked).isThinShell;
  };
  std::vector<double> values(bowl.faces.size(), 0.125);
  values.resize(bowl.faces.size() + ball.faces.size(), 1.72);
  CHECK(isShell(shapes::joined(bowl, ball, {5, 0, 0}), values));
  std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(bowl.faces.size()), values.end());
  CHECK(isShell(shapes::joined(ball, bowl, {5, 0, 0}), values));
  CHECK_FALSE(isShell(shapes::joined(ball, ball, {5, 0, 0}), std::vector<double>(2 * ball.faces.size(), 1.72)));
}
