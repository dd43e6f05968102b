#include <doctest/doctest.h>
#include <fmt/core.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "generate/solids.h"
#include "generate/thickness_parts.h"
#include "support/shared_session.h"

// The verdict does not depend on the triangulation: the same part, meshed in several ways.

using namespace asdfvk;

namespace {

/// A mesh in double precision.
struct DecimatedTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using DecimatedMesh = OpenMesh::TriMesh_ArrayKernelT<DecimatedTraits>;

/// Collapses edges as long as the vertices stay within 1e-4 of the planes of their faces.
Mesh decimated(const Mesh& mesh) {
  DecimatedMesh halfEdges;
  for (const Vec3d& v : mesh.vertices) halfEdges.add_vertex({v.x, v.y, v.z});
  const auto handle = [](uint32_t vertex) { return OpenMesh::VertexHandle(static_cast<int>(vertex)); };
  for (const auto& [a, b, c] : mesh.faces) halfEdges.add_face(handle(a), handle(b), handle(c));
  halfEdges.request_face_normals();
  halfEdges.update_face_normals();
  OpenMesh::Decimater::DecimaterT<DecimatedMesh> decimater(halfEdges);
  OpenMesh::Decimater::ModQuadricT<DecimatedMesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<DecimatedMesh>::Handle flipping;
  decimater.add(quadric);
  decimater.add(flipping);
  decimater.module(quadric).set_max_err(1e-8, false);
  decimater.module(flipping).set_max_normal_deviation(1);
  decimater.initialize();
  decimater.decimate();
  halfEdges.garbage_collection();
  Mesh result;
  for (const auto vertex : halfEdges.vertices()) {
    const OpenMesh::Vec3d& p = halfEdges.point(vertex);
    result.vertices.push_back({p[0], p[1], p[2]});
  }
  for (const auto face : halfEdges.faces()) {
    Face corners{};
    size_t k = 0;
    for (const auto vertex : face.vertices()) corners[k++] = static_cast<uint32_t>(vertex.idx());
    result.faces.push_back(corners);
  }
  return result;
}

/// Each pair of faces that a quad was cut into is the quad again.
Mesh ofQuads(Mesh mesh) {
  mesh.polygons.firstCorner.push_back(0);
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    const Face& face = mesh.faces[f];
    const auto next = f + 1 < mesh.faceCount() ? mesh.faces[f + 1] : Face{};
    // A quad was cut from its first corner, or from its second one.
    const bool isQuad = face[0] == next[0] && face[2] == next[1];
    const auto input = static_cast<uint32_t>(mesh.polygons.firstCorner.size() - 1);
    mesh.polygons.corners.insert(mesh.polygons.corners.end(), face.begin(), face.end());
    mesh.polygons.inputFaceOf.push_back(input);
    if (isQuad) {
      mesh.polygons.corners.push_back(next[2]);
      mesh.polygons.inputFaceOf.push_back(input);
      ++f;
    }
    mesh.polygons.firstCorner.push_back(mesh.polygons.corners.size());
  }
  return mesh;
}

/// An export with six digits and three vertices for each face.
Mesh withSixDigits(Mesh mesh) {
  for (Vec3d& vertex : mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) vertex[axis] = std::stod(fmt::format("{:.6g}", vertex[axis]));
  return solids::separated(mesh);
}

ThicknessReport judgedAs(const Mesh& mesh, double limit) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  return test::referenceSession().compute(mesh, options).report.thickness.value();
}

}  // namespace

TEST_CASE("a part has one verdict on each side of its least wall: refined, decimated, quads, six digits, turned") {
  struct Part {
    const char* name;
    double least, passes, fails;
  };
  for (const Part& part : {Part{"pocket", 0.6, 0.59, 0.61}, Part{"shelled-box", 2, 1.96, 2.04},
                           Part{"ligament-96", 0.6, 0.58, 0.68}, Part{"flat-thread", 0.9, 0.88, 0}}) {
    CAPTURE(part.name);
    const BlockSolid solid = makeThicknessPart(part.name).solid;
    const Mesh coarse = solid.surface(), fine = solid.surface({.longestEdge = 2, .diagonalSeed = 5});
    const Mesh turned = solids::turned(coarse, 0.5, 1.1), few = decimated(fine), quads = ofQuads(coarse);
    CHECK(few.faces.size() < fine.faces.size() / 2);
    CHECK(quads.inputFaceCount() < coarse.faces.size() * 3 / 4);
    const std::vector<std::pair<const char*, Mesh>> meshes{{"coarse", coarse},
                                                           {"refined", fine},
                                                           {"decimated", few},
                                                           {"quads", quads},
                                                           {"six digits", withSixDigits(turned)},
                                                           {"turned", turned}};
    for (const auto& each : meshes) {
      CAPTURE(each.first);
      const Mesh& mesh = each.second;
      CHECK(judgedAs(mesh, part.passes).verdict == ThicknessVerdict::Passed);
      if (part.fails == 0) continue;
      const ThicknessReport failed = judgedAs(mesh, part.fails);
      CHECK(failed.verdict == ThicknessVerdict::Failed);
      CHECK(failed.min == doctest::Approx(part.least).epsilon(3e-3));
    }
  }
}
