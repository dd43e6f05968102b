#pragma once

#include <cstdint>

#include "mesh/mesh.h"

/// Small shapes for all tests. Faces of closed ones point outwards.
namespace asdfvk::shapes {

Mesh tetrahedron();
/// The cube [-1, 1]^3 of 12 faces.
Mesh cube();
/// The cube with both diagonals of each side: two faces upon two others.
Mesh doubledCube();
/// A refined octahedron with its vertices on the unit sphere: 8 * 4^levels faces.
Mesh sphere(uint32_t levels);
/// A refined icosahedron with its vertices on the sphere: 20 * 4^levels faces.
Mesh icosphere(uint32_t levels, double radius = 1);
/// Axis-aligned, centred; each side is cut into side * side squares of two triangles.
Mesh box(const Vec3d& size, uint32_t side = 1);
/// Without its top.
Mesh openBox(const Vec3d& size, uint32_t side);
/// A closed prism along z.
Mesh cylinder(double radius, double height, uint32_t sideCount, uint32_t ringCount);
/// A ring of rings around the z axis: quads (major x minor) cut in two.
Mesh torus(double majorRadius, double minorRadius, uint32_t majorCount, uint32_t minorCount);
/// A sphere with a smaller, inverted one inside.
Mesh shell(double outerRadius, double innerRadius);

/// n by n squares of two faces each in the plane z = 0, looking up.
Mesh grid(uint32_t n);
/// Faces (0, 1, i) for i = 2 .. pageCount + 1: all share the edge 0-1.
Mesh book(uint32_t pageCount);
/// An open disk of faces around vertex `apex`, which is 0 or the last one.
Mesh fan(uint32_t faceCount, bool apexFirst);
/// Two boxes that share one edge, which therefore has four faces.
Mesh boxesWithSharedEdge();
/// Random triangles through each other, without common vertices.
Mesh soup(uint32_t faceCount, uint64_t seed);
/// Random faces over few vertices: repeated vertices, duplicates, edges of many faces.
Mesh randomFaces(uint32_t vertexCount, uint32_t faceCount, uint64_t seed);

/// Moves each vertex by up to `amount`, so that the vertices are in general position.
Mesh jittered(Mesh mesh, double amount, uint64_t seed);
Mesh scaledAndShifted(Mesh mesh, double scale, const Vec3d& shift = {});
Mesh inverted(Mesh mesh);
/// The faces of `mesh`, then those of `other`, moved by `shift`; without common vertices.
Mesh joined(Mesh mesh, const Mesh& other, const Vec3d& shift = {});

}  // namespace asdfvk::shapes
