#include "render/corner_normals.h"

#include <doctest/doctest.h>

#include "generate/shapes.h"

namespace asdfvk {
namespace {

auto normalsOf(const Mesh& mesh) { return cornerNormals(mesh, computeFaceGeometry(mesh)); }

TEST_CASE("the corner normals of a sphere are along its radius") {
  const Mesh mesh = generateShape("sphere", 2000).mesh;
  const auto normals = normalsOf(mesh);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d& vertex = mesh.vertices[mesh.faces[face][k]];
      CHECK_GT(dot(normals[face][k], vertex / length(vertex)), 0.999);
    }
}

TEST_CASE("a cube keeps its edges sharp") {
  const Mesh mesh = generateShape("cube", 300).mesh;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const auto normals = cornerNormals(mesh, geometry);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (const Vec3d& normal : normals[face]) CHECK_LT(length(normal - geometry.normals[face]), 1e-12);
}

TEST_CASE("a face that is wound the other way smooths like the others") {
  Mesh mesh = generateShape("sphere", 2000).mesh;
  const auto before = normalsOf(mesh);
  std::swap(mesh.faces[5][1], mesh.faces[5][2]);
  const auto after = normalsOf(mesh);
  CHECK_LT(length(after[5][0] + before[5][0]), 1e-9);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (size_t k = 0; k < 3; ++k)
      if (face != 5) CHECK_LT(length(after[face][k] - before[face][k]), 1e-9);
}

TEST_CASE("a degenerate face has none and changes no other") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.faces = {{0, 1, 2}, {0, 1, 3}};
  const auto normals = normalsOf(mesh);
  for (size_t k = 0; k < 3; ++k) {
    CHECK(normals[0][k] == Vec3d{0, 0, 1});
    CHECK(normals[1][k] == Vec3d{});
  }
}

}  // namespace
}  // namespace asdfvk
