#include "random_solids/assembly.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "topology.h"

using namespace asdfvk;

namespace {

constexpr uint64_t kAssemblyCount = 60;

struct AssemblyPart {
  Mesh mesh;  ///< With its own vertices only, in their order.
  std::vector<uint32_t> vertices;
};

std::vector<AssemblyPart> partsOf(const GeneratedShape& shape) {
  std::vector<AssemblyPart> parts(shape.part.back() + 1);
  std::vector<uint32_t> local(shape.mesh.vertices.size(), ~0u);
  for (size_t f = 0; f < shape.part.size(); ++f) {
    AssemblyPart& part = parts[shape.part[f]];
    Face face = shape.mesh.faces[f];
    for (uint32_t& v : face) {
      if (local[v] == ~0u) {
        local[v] = static_cast<uint32_t>(part.vertices.size());
        part.vertices.push_back(v);
        part.mesh.vertices.push_back(shape.mesh.vertices[v]);
      }
      v = local[v];
    }
    part.mesh.faces.push_back(face);
  }
  return parts;
}

Vec3d areaVector(const Mesh& mesh, const Face& face) {
  const Vec3d& a = mesh.vertices[face[0]];
  return 0.5 * cross(mesh.vertices[face[1]] - a, mesh.vertices[face[2]] - a);
}

/// The polygon of the first face, clipped by the sides of the other one, which faces it in the same plane; else 0.
double commonArea(const Mesh& mesh, const Face& face, const Mesh& otherMesh, const Face& other) {
  const Vec3d area = areaVector(mesh, face), otherArea = areaVector(otherMesh, other);
  const Vec3d normal = area / length(area), otherNormal = otherArea / length(otherArea);
  const Vec3d& origin = otherMesh.vertices[other[0]];
  if (dot(normal, otherNormal) > -1 + 1e-9) return 0;
  if (std::abs(dot(mesh.vertices[face[0]] - origin, otherNormal)) > 1e-9) return 0;
  std::vector<Vec3d> polygon;
  for (const uint32_t v : face) polygon.push_back(mesh.vertices[v]);
  for (size_t side = 0; side < 3 && !polygon.empty(); ++side) {
    const Vec3d& from = otherMesh.vertices[other[side]];
    const Vec3d inwards = cross(otherNormal, otherMesh.vertices[other[(side + 1) % 3]] - from);
    std::vector<Vec3d> clipped;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double atP = dot(p - from, inwards), atQ = dot(q - from, inwards);
      if (atP >= 0) clipped.push_back(p);
      if ((atP >= 0) != (atQ >= 0)) clipped.push_back(p + atP / (atP - atQ) * (q - p));
    }
    polygon = std::move(clipped);
  }
  double sum = 0;
  for (size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += dot(cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]), normal) / 2;
  return sum;
}

/// The contact of a part with the other parts.
struct Contact {
  double area = 0;
  double sameTriangleArea = 0;  ///< Area of the contact between triangles that have the same corners.
};

Contact contactOf(const std::vector<AssemblyPart>& parts, size_t part) {
  Contact contact;
  for (size_t other = 0; other < parts.size(); ++other) {
    if (other == part) continue;
    for (const Face& face : parts[part].mesh.faces)
      for (const Face& otherFace : parts[other].mesh.faces) {
        const double area = commonArea(parts[part].mesh, face, parts[other].mesh, otherFace);
        contact.area += area;
        if (area > 0.999 * length(areaVector(parts[part].mesh, face)) &&
            area > 0.999 * length(areaVector(parts[other].mesh, otherFace)))
          contact.sameTriangleArea += area;
      }
  }
  return contact;
}

}  // namespace

TEST_CASE("an assembly has 2 to 8 closed parts, oriented outwards, in a moderate number of faces") {
  std::vector<size_t> counts(9);
  for (uint64_t seed = 1; seed <= kAssemblyCount; ++seed) {
    CAPTURE(seed);
    const GeneratedShape shape = makeAssembly({.seed = seed});
    REQUIRE(shape.part.size() == shape.mesh.faces.size());
    REQUIRE(shape.diameter.size() == shape.mesh.faces.size());
    CHECK(std::is_sorted(shape.part.begin(), shape.part.end()));
    CHECK(shape.mesh.faces.size() < 8000);
    const std::vector<AssemblyPart> parts = partsOf(shape);
    REQUIRE(parts.size() >= 2);
    REQUIRE(parts.size() <= 8);
    ++counts[parts.size()];
    size_t vertexCount = 0;
    for (const AssemblyPart& part : parts) {
      const Topology topology = topologyOf(part.mesh);
      CHECK(topology.badEdgeCount == 0);
      CHECK(topology.badVertexCount == 0);
      CHECK(topology.componentCount <= 2);  // Two where there is a cavity.
      CHECK(volumeOf(part.mesh) > 0);
      const std::vector<double> qualities = triangleQualities(part.mesh);
      CHECK(*std::min_element(qualities.begin(), qualities.end()) > 1e-3);
      vertexCount += part.vertices.size();
    }
    CHECK(vertexCount == shape.mesh.vertices.size());  // No vertex is shared or unused.
  }
  for (size_t count = 2; count <= 8; ++count) CHECK(counts[count] > 0);
}

TEST_CASE("each part of an assembly touches another one, mostly in other triangles") {
  double area = 0, sameTriangleArea = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const std::vector<AssemblyPart> parts = partsOf(makeAssembly({.seed = seed}));
    for (size_t part = 0; part < parts.size(); ++part) {
      const Contact contact = contactOf(parts, part);
      CAPTURE(part);
      CHECK(contact.area > 0.01);
      area += contact.area;
      sameTriangleArea += contact.sameTriangleArea;
    }
  }
  CHECK(sameTriangleArea < 0.5 * area);
}

TEST_CASE("parts moved apart are the same, face by face, with the distance between them") {
  constexpr double kDistance = 2.5;
  for (uint64_t seed = 1; seed <= kAssemblyCount; ++seed) {
    CAPTURE(seed);
    const GeneratedShape touching = makeAssembly({.seed = seed}),
                         apart = makeAssembly({.seed = seed, .apart = kDistance});
    REQUIRE(apart.mesh.faces == touching.mesh.faces);
    REQUIRE(apart.part == touching.part);
    const std::vector<AssemblyPart> parts = partsOf(apart);
    std::vector<Vec3d> shifts;
    double worst = 0;
    for (const AssemblyPart& part : parts) {
      const auto shiftOf = [&](uint32_t v) { return apart.mesh.vertices[v] - touching.mesh.vertices[v]; };
      shifts.push_back(shiftOf(part.vertices[0]));
      for (const uint32_t v : part.vertices) worst = std::max(worst, length(shiftOf(v) - shifts.back()));
    }
    CHECK(worst < 1e-13);
    const Vec3d axis = shifts.back() / length(shifts.back());
    double end = -std::numeric_limits<double>::infinity();
    for (const AssemblyPart& part : parts) {
      double least = std::numeric_limits<double>::infinity(), greatest = -least;
      for (const Vec3d& p : part.mesh.vertices) {
        least = std::min(least, dot(p, axis));
        greatest = std::max(greatest, dot(p, axis));
      }
      CHECK(least > end + kDistance * (1 - 1e-12));
      end = greatest;
    }
  }
}

TEST_CASE("interpenetrating parts have less contact, and each is closed") {
  double area = 0, overlappingArea = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const std::vector<AssemblyPart> touching = partsOf(makeAssembly({.seed = seed})),
                                    overlapping = partsOf(makeAssembly({.seed = seed, .interpenetrates = true}));
    REQUIRE(touching.size() == overlapping.size());
    for (size_t part = 0; part < touching.size(); ++part) {
      area += contactOf(touching, part).area;
      overlappingArea += contactOf(overlapping, part).area;
      CHECK(topologyOf(overlapping[part].mesh).badEdgeCount == 0);
    }
  }
  CHECK(overlappingArea < 0.9 * area);
}

TEST_CASE("a doubled solid has each surface twice, in other triangles") {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Mesh mesh = makeDoubledSolid(seed).mesh;
    REQUIRE(mesh.faces.size() % 2 == 0);
    const auto middle = mesh.faces.begin() + static_cast<std::ptrdiff_t>(mesh.faces.size() / 2);
    Mesh first{mesh.vertices, {mesh.faces.begin(), middle}, {}}, second{mesh.vertices, {middle, mesh.faces.end()}, {}};
    for (const Mesh* half : {&first, &second}) {
      const Topology topology = topologyOf(*half);
      CHECK(topology.badEdgeCount == 0);
      CHECK(topology.badVertexCount == 0);
      CHECK(volumeOf(*half) == doctest::Approx(volumeOf(first)).epsilon(1e-12));
    }
    const auto sorted = [](Face face) {
      std::sort(face.begin(), face.end());
      return face;
    };
    size_t otherCount = 0;
    for (size_t f = 0; f < first.faces.size(); ++f) otherCount += sorted(first.faces[f]) != sorted(second.faces[f]);
    CHECK(2 * otherCount >= first.faces.size());  // Triangles at an axis have no other diagonal.
  }
}

TEST_CASE("random solids have their seeds") {
  CHECK(makeAssembly({.seed = 3}).mesh.vertices == makeAssembly({.seed = 3}).mesh.vertices);
  CHECK(makeAssembly({.seed = 3}).mesh.vertices != makeAssembly({.seed = 4}).mesh.vertices);
  CHECK(makeDoubledSolid(3).mesh.vertices != makeDoubledSolid(4).mesh.vertices);
}
