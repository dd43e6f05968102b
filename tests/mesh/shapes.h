#pragma once

#include <cstdint>

#include "mesh/mesh.h"

/// Small shapes for the tests of this folder; faces of closed shapes point outwards.
namespace shapes {

asdfvk::Mesh tetrahedron();
/// The cube [-1, 1]^3 of 12 faces.
asdfvk::Mesh cube();
/// n by n squares of two faces each in the plane z = 0, looking up.
asdfvk::Mesh grid(uint32_t n);
/// A ring of rings around the z axis: quads (major x minor) cut in two.
asdfvk::Mesh torus(double majorRadius, double minorRadius, uint32_t majorCount, uint32_t minorCount);
/// An octahedron whose faces are cut in four `levels` times, on the unit sphere.
asdfvk::Mesh sphere(uint32_t levels);
/// Faces (0, 1, i) for i = 2 .. pageCount + 1: all share the edge 0-1.
asdfvk::Mesh book(uint32_t pageCount);
/// An open disk of faces around vertex `apex`, which is 0 or the last one.
asdfvk::Mesh fan(uint32_t faceCount, bool apexFirst);
/// Random faces over few vertices: repeated vertices, duplicates, edges of many faces.
asdfvk::Mesh soup(uint32_t vertexCount, uint32_t faceCount, uint64_t seed);

asdfvk::Mesh placed(asdfvk::Mesh mesh, double scale, const asdfvk::Vec3d& shift = {});
asdfvk::Mesh inverted(asdfvk::Mesh mesh);
asdfvk::Mesh together(asdfvk::Mesh mesh, const asdfvk::Mesh& other);

}  // namespace shapes
