#pragma once

#include <cstdint>

#include "mesh/mesh.h"

// Small shapes with known diameters. Closed ones are oriented outwards.
namespace asdfvk::shapes {

/// A refined icosahedron with its vertices on the sphere: 20 * 4^levels faces.
Mesh icosphere(uint32_t levels, double radius = 1);

/// Axis-aligned, centred; each side is cut into side * side squares of two triangles.
Mesh box(const Vec3d& size, uint32_t side = 1);

/// Without its top.
Mesh openBox(const Vec3d& size, uint32_t side);

/// A closed prism along z.
Mesh cylinder(double radius, double height, uint32_t sideCount, uint32_t ringCount);

/// Random triangles through each other.
Mesh soup(uint32_t faceCount, uint64_t seed);

/// A sphere with a smaller, inverted one inside: a shell.
Mesh shell(double outerRadius, double innerRadius);

/// Two boxes that share one edge, which therefore has four faces.
Mesh boxesWithSharedEdge();

/// Moves each vertex by up to `amount`, so that the vertices are in general position.
Mesh jittered(Mesh mesh, double amount, uint64_t seed);

Mesh scaledAndShifted(Mesh mesh, double scale, const Vec3d& shift);
Mesh inverted(Mesh mesh);
Mesh joined(const Mesh& a, const Mesh& b);

}  // namespace asdfvk::shapes
