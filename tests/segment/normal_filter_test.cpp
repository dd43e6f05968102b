#include "segment/normal_filter.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "generate/analytic_shapes.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

using namespace asdfvk;

namespace {

struct NormalSample {
  Mesh mesh;
  FaceGeometry geometry;
  DualGraph graph;
  std::vector<float> areas;

  explicit NormalSample(Mesh source) : mesh(std::move(source)), geometry(computeFaceGeometry(mesh)) {
    graph = surveyEdges(mesh).graph;
    areas.assign(geometry.areas.begin(), geometry.areas.end());
  }

  [[nodiscard]] std::vector<Vec3d> filtered() const { return filterNormals(geometry.normals, areas, graph); }
};

/// Moves the vertices by normally distributed offsets.
Mesh noisy(Mesh mesh, double deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> offset(0, deviation);
  for (Vec3d& vertex : mesh.vertices) vertex += Vec3d{offset(random), offset(random), offset(random)};
  return mesh;
}

double meanDistance(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += length(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("normals of a mesh without noise remain") {
  const NormalSample sphere(makeSphere(8000).mesh);
  const std::vector<Vec3d> filtered = sphere.filtered();
  for (size_t face = 0; face < filtered.size(); ++face) CHECK(filtered[face] == sphere.geometry.normals[face]);
}

TEST_CASE("normals of a coarse mesh remain") {
  const NormalSample cube(makeCube(12).mesh);
  const std::vector<Vec3d> filtered = cube.filtered();
  for (size_t face = 0; face < filtered.size(); ++face) CHECK(filtered[face] == cube.geometry.normals[face]);
}

TEST_CASE("the filter removes most of the noise of normals") {
  const Mesh smooth = makeSphere(8000).mesh;
  const NormalSample clean(smooth), sample(noisy(smooth, 0.01));
  const double before = meanDistance(sample.geometry.normals, clean.geometry.normals);
  CHECK(before > 0.1);
  CHECK(meanDistance(sample.filtered(), clean.geometry.normals) < 0.5 * before);
}

TEST_CASE("degenerate faces keep the normals of their neighbours finite") {
  Mesh mesh = makeSphere(2000).mesh;
  mesh.faces[5] = {mesh.faces[5][0], mesh.faces[5][0], mesh.faces[5][1]};
  const NormalSample sample(noisy(mesh, 0.02));
  for (const Vec3d& normal : sample.filtered()) CHECK(isFinite(normal));
}
