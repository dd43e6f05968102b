#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "generate/brick_lattice.h"
#include "generate/shapes.h"
#include "generate/surface_nets.h"
#include "topology.h"

using namespace asdfvk;

namespace {

struct Creature {
  const char* name;
  CapsuleUnion field;
  size_t partCount;
};
std::vector<Creature> creatures() {
  return {{"animal", animalField(), 10},
          {"hand", handField(), 7},
          {"figure", figureField(), 15},
          {"tree", treeField(), 31}};
}

Vec3d barycentre(const Mesh& mesh, const Face& face) {
  return (mesh.vertices[face[0]] + mesh.vertices[face[1]] + mesh.vertices[face[2]]) / 3.0;
}

}  // namespace

TEST_CASE("every part of a creature is there, already in a hundred faces or so") {
  for (const auto& [creature, field, partCount] : creatures()) {
    const std::string_view name = creature;
    CAPTURE(name);
    const GeneratedShape coarse = generateShape(name, 300), fine = generateShape(name, 20000);
    CHECK(std::set<uint32_t>(coarse.part.begin(), coarse.part.end()).size() == partCount);
    const std::set<uint32_t> parts(fine.part.begin(), fine.part.end());
    CHECK(parts.size() == partCount);
    CHECK(*parts.rbegin() == partCount - 1);
  }
}

TEST_CASE("the vertices of a creature are on its surface and its faces are oriented outwards") {
  for (const auto& [creature, field, partCount] : creatures()) {
    const std::string_view name = creature;
    CAPTURE(name);
    const Mesh mesh = generateShape(name, 100000).mesh;
    size_t offCount = 0, turnedCount = 0;
    for (const Vec3d& p : mesh.vertices) offCount += std::abs(field.value(p)) > 1e-5;
    for (const Face& face : mesh.faces) {
      const Vec3d a = mesh.vertices[face[0]];
      const Vec3d normal = cross(mesh.vertices[face[1]] - a, mesh.vertices[face[2]] - a);
      const Vec3d gradient = field.sample(barycentre(mesh, face)).gradient;
      turnedCount += dot(normal, gradient) < 0.8 * length(normal) * length(gradient);
    }
    CHECK(offCount == 0);
    CHECK(double(turnedCount) < 1e-4 * double(mesh.faces.size()));
  }
}

TEST_CASE("the diameter of a face is that of the nearest ball of its part") {
  // Away from joints a limb is a cone: walking inwards by the diameter's half comes to its axis.
  const CapsuleUnion field({{{0, 0, 0}, {4, 0, 0}, 1, 0.5, 3, 0}});
  const GeneratedShape shape = polygonise(field, 20000);
  const double slope = -0.5 / 4, lean = slope / std::sqrt(1 - slope * slope);
  for (size_t f = 0; f < shape.mesh.faces.size(); ++f) {
    const Vec3d c = barycentre(shape.mesh, shape.mesh.faces[f]);
    const double s = std::clamp(c.x + lean * std::hypot(c.y, c.z), 0.0, 4.0);
    REQUIRE(shape.part[f] == 3);
    REQUIRE(shape.diameter[f] == doctest::Approx(2 * (1 - s / 8)).epsilon(1e-6));
    REQUIRE(length(c - Vec3d{s, 0, 0}) == doctest::Approx(shape.diameter[f] / 2).epsilon(2e-3));
  }
}

TEST_CASE("volume and area of one capsule converge to the exact ones") {
  const double radius = 0.5, reach = 3, pi = 3.14159265358979323846;
  const CapsuleUnion field({{{0, 0, 0}, {reach, 0, 0}, radius, radius, 0, 0}});
  const double volume = pi * radius * radius * (reach + 4 * radius / 3), area = 2 * pi * radius * (reach + 2 * radius);
  const Mesh coarse = polygonise(field, 2000).mesh, fine = polygonise(field, 128000).mesh;
  CHECK(std::abs(volumeOf(fine) - volume) < 3e-4 * volume);
  CHECK(std::abs(areaOf(fine) - area) < 3e-4 * area);
  CHECK(std::abs(volumeOf(fine) - volume) < std::abs(volumeOf(coarse) - volume) / 30);
}

TEST_CASE("the field changes no faster than the distance walked, and its gradient is its derivative") {
  for (const auto& [creature, field, partCount] : creatures()) {
    const std::string_view name = creature;
    CAPTURE(name);
    const Vec3d size = field.bounds().size();
    for (int i = 0; i < 2000; ++i) {
      const auto share = [&](int k) {
        return std::fmod(0.5 + i * std::array{0.754877, 0.569840, 0.245122}[size_t(k)], 1.0);
      };
      const Vec3d p = field.bounds().min + Vec3d{size.x * share(0), size.y * share(1), size.z * share(2)};
      const CapsuleUnion::Sample sample = field.sample(p);
      REQUIRE(sample.value == doctest::Approx(field.value(p)).epsilon(1e-12));
      REQUIRE(length(sample.gradient) <= 1 + 1e-9);
      REQUIRE(std::abs(field.value(field.bounds().centre()) - sample.value) <=
              length(p - field.bounds().centre()) * (1 + 1e-9));
      const Vec3d step{1e-7, -2e-7, 1e-7};
      REQUIRE(std::abs(field.value(p + step) - sample.value - dot(sample.gradient, step)) < 2e-10);
    }
  }
}

TEST_CASE("the same bits come on one thread and on two") {
  for (const std::string_view name : {"animal", "hand", "figure", "tree", "icosphere"}) {
    CAPTURE(name);
    const auto makeOn = [&](size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return generateShape(name, 50000);
    };
    const GeneratedShape one = makeOn(1), two = makeOn(2);
    CHECK(one.mesh.vertices == two.mesh.vertices);
    CHECK(one.mesh.faces == two.mesh.faces);
    CHECK(one.part == two.part);
    CHECK(one.diameter == two.diameter);
  }
}

TEST_CASE("filling corners ends in a well-composed cell") {
  CHECK(cornerToFill(0b00000110) >= 0);  // across a side's diagonal
  CHECK(cornerToFill(0b10000001) >= 0);  // across the cell's diagonal
  CHECK(cornerToFill(0b01111110) >= 0);  // and the same outside
  CHECK(cornerToFill(0b00001111) == -1);
  CHECK(cornerToFill(0b00010111) == -1);
  for (uint32_t start = 0; start < 256; ++start) {
    uint32_t mask = start;
    for (int32_t corner = cornerToFill(mask); corner >= 0; corner = cornerToFill(mask)) {
      REQUIRE((mask >> corner & 1) == 0);
      mask |= 1u << corner;
    }
  }
}
