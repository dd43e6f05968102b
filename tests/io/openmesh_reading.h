#pragma once

#include <doctest/doctest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>
#include <string>
#include <vector>

#include "reading.h"

// Comparison of the readers with those of OpenMesh, on files that both read.
namespace asdfvk::test {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

/// The faces of the file, polygons included.
inline std::vector<std::vector<uint32_t>> inputFaces(const Mesh& mesh) {
  std::vector<std::vector<uint32_t>> faces;
  if (mesh.polygons.isEmpty()) {
    for (const Face& face : mesh.faces) faces.emplace_back(face.begin(), face.end());
    return faces;
  }
  const auto begin = mesh.polygons.corners.begin();
  for (size_t i = 0; i + 1 < mesh.polygons.firstCorner.size(); ++i)
    faces.emplace_back(begin + static_cast<ptrdiff_t>(mesh.polygons.firstCorner[i]),
                       begin + static_cast<ptrdiff_t>(mesh.polygons.firstCorner[i + 1]));
  return faces;
}

/// The corners of a face, starting at its lowest vertex: a half-edge mesh may start at any corner.
inline std::vector<uint32_t> fromLowest(std::vector<uint32_t> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

inline void requireSameAsOpenMesh(const std::string& path) {
  CAPTURE(path);
  PolyMesh theirs;
  REQUIRE(OpenMesh::IO::read_mesh(theirs, path));
  const Mesh ours = readMesh(path);
  const std::vector<std::vector<uint32_t>> faces = inputFaces(ours);
  REQUIRE(ours.vertices.size() == theirs.n_vertices());
  REQUIRE(faces.size() == theirs.n_faces());
  size_t differentCount = 0;
  for (const auto vertex : theirs.vertices()) {
    // OpenMesh rounds coordinates to float32.
    const Vec3d& p = ours.vertices[static_cast<size_t>(vertex.idx())];
    const PolyMesh::Point q = theirs.point(vertex);
    for (size_t axis = 0; axis < 3; ++axis)
      differentCount += static_cast<float>(p[axis]) == static_cast<float>(q[axis]) ? 0 : 1;
  }
  for (const auto face : theirs.faces()) {
    std::vector<uint32_t> corners;
    for (const auto vertex : face.vertices()) corners.push_back(static_cast<uint32_t>(vertex.idx()));
    differentCount += fromLowest(corners) == fromLowest(faces[static_cast<size_t>(face.idx())]) ? 0 : 1;
  }
  CHECK(differentCount == 0);
}

}  // namespace asdfvk::test
