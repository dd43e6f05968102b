#include "mesh_changes.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "core/vec3.h"
#include "mesh/face_geometry.h"

namespace asdfvk::bench {
namespace {

using TriMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// Greatest angle between two faces whose common edge is flipped.
constexpr double kMaxFlipRadians = 20 * std::numbers::pi / 180;

TriMesh toOpenMesh(const Mesh& mesh) {
  TriMesh result;
  for (const Vec3d& v : mesh.vertices)
    result.add_vertex({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  const auto handle = [](uint32_t vertex) { return TriMesh::VertexHandle(static_cast<int>(vertex)); };
  for (const auto& [a, b, c] : mesh.faces) result.add_face(handle(a), handle(b), handle(c));
  return result;
}

Mesh fromOpenMesh(const TriMesh& source) {
  Mesh mesh;
  for (const auto vertex : source.vertices()) {
    const auto& point = source.point(vertex);
    mesh.vertices.push_back({double{point[0]}, double{point[1]}, double{point[2]}});
  }
  for (const auto face : source.faces()) {
    Face corners{};
    size_t corner = 0;
    for (const auto vertex : source.fv_range(face)) corners[corner++] = static_cast<uint32_t>(vertex.idx());
    mesh.faces.push_back(corners);
  }
  return mesh;
}

bool isFlippable(const TriMesh& mesh, TriMesh::EdgeHandle edge) {
  if (mesh.is_boundary(edge) || !mesh.is_flip_ok(edge)) return false;
  const auto half = mesh.halfedge_handle(edge, 0);
  const auto point = [&](TriMesh::VertexHandle vertex) { return mesh.point(vertex); };
  const auto a = point(mesh.from_vertex_handle(half)), b = point(mesh.to_vertex_handle(half));
  const auto c = point(mesh.opposite_vh(half));
  const auto d = point(mesh.opposite_vh(mesh.opposite_halfedge_handle(half)));
  const auto normalOf = [](const auto& p, const auto& q, const auto& r) {
    return OpenMesh::cross(q - p, r - p).normalized();
  };
  const auto limit = static_cast<float>(std::cos(kMaxFlipRadians));
  const auto before = normalOf(a, b, c), beforeOther = normalOf(b, a, d);
  const auto after = normalOf(c, d, b), afterOther = normalOf(d, c, a);
  return OpenMesh::dot(before, beforeOther) > limit && OpenMesh::dot(after, afterOther) > limit &&
         OpenMesh::dot(before, after) > limit;
}

}  // namespace

ChangedMesh unchanged(const Mesh& mesh) {
  ChangedMesh changed{mesh, std::vector<uint32_t>(mesh.faces.size())};
  std::iota(changed.originalFaces.begin(), changed.originalFaces.end(), 0u);
  return changed;
}

ChangedMesh addNoise(const Mesh& mesh, double share) {
  ChangedMesh changed = unchanged(mesh);
  std::mt19937_64 random(1);
  std::normal_distribution<double> offset(0, share * boundsOfFiniteVertices(mesh).diagonal());
  for (Vec3d& vertex : changed.mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) vertex[axis] += offset(random);
  return changed;
}

ChangedMesh turn(const Mesh& mesh) {
  ChangedMesh changed = unchanged(mesh);
  const double a = 0.7, b = 1.9;  // Angles about z and x.
  for (Vec3d& v : changed.mesh.vertices) {
    const double x = std::cos(a) * v.x - std::sin(a) * v.y, y = std::sin(a) * v.x + std::cos(a) * v.y;
    v = {x, std::cos(b) * y - std::sin(b) * v.z, std::sin(b) * y + std::cos(b) * v.z};
  }
  return changed;
}

ChangedMesh divideFaces(const Mesh& mesh) {
  ChangedMesh changed;
  changed.mesh.vertices = mesh.vertices;
  std::vector<std::array<uint32_t, 3>> edges;  // Lower vertex, upper vertex, 3 face + corner.
  for (uint32_t face = 0; face < mesh.faces.size(); ++face)
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t from = mesh.faces[face][i], to = mesh.faces[face][(i + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), 3 * face + i});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<uint32_t> middles(edges.size());
  for (size_t i = 0; i < edges.size(); ++i) {
    const auto [from, to, corner] = edges[i];
    if (i == 0 || edges[i - 1][0] != from || edges[i - 1][1] != to)
      changed.mesh.vertices.push_back((mesh.vertices[from] + mesh.vertices[to]) * 0.5);
    middles[corner] = static_cast<uint32_t>(changed.mesh.vertices.size() - 1);
  }
  for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const auto [a, b, c] = mesh.faces[face];
    const uint32_t ab = middles[3 * face], bc = middles[3 * face + 1], ca = middles[3 * face + 2];
    for (const Face& part : {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}}) {
      changed.mesh.faces.push_back(part);
      changed.originalFaces.push_back(face);
    }
  }
  return changed;
}

ChangedMesh decimate(const Mesh& mesh, double share) {
  TriMesh source = toOpenMesh(mesh);
  source.request_face_normals();
  source.update_face_normals();
  OpenMesh::Decimater::DecimaterT<TriMesh> decimater(source);
  OpenMesh::Decimater::ModQuadricT<TriMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  OpenMesh::Decimater::ModNormalFlippingT<TriMesh>::Handle flipping;
  decimater.add(flipping);
  decimater.initialize();
  decimater.decimate_to_faces(0, static_cast<size_t>(share * static_cast<double>(source.n_faces())));
  source.garbage_collection();
  return {fromOpenMesh(source), {}};
}

ChangedMesh flipEdges(const Mesh& mesh) {
  TriMesh source = toOpenMesh(mesh);
  std::mt19937_64 random(1);
  for (const auto edge : source.edges())
    if (random() % 2 == 0 && isFlippable(source, edge)) source.flip(edge);
  return {fromOpenMesh(source), {}};
}

ChangedMesh removeDiscs(const Mesh& mesh, uint32_t count, double radiusShare) {
  ChangedMesh changed;
  changed.mesh.vertices = mesh.vertices;
  std::mt19937_64 random(1);
  std::vector<Vec3d> centres;
  for (uint32_t i = 0; i < count; ++i) centres.push_back(mesh.vertices[mesh.faces[random() % mesh.faces.size()][0]]);
  const double radius = radiusShare * boundsOfFiniteVertices(mesh).diagonal();
  for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const auto isNear = [&](const Vec3d& centre) {
      return length(mesh.vertices[mesh.faces[face][0]] - centre) < radius;
    };
    if (std::any_of(centres.begin(), centres.end(), isNear)) continue;
    changed.mesh.faces.push_back(mesh.faces[face]);
    changed.originalFaces.push_back(face);
  }
  return changed;
}

}  // namespace asdfvk::bench
