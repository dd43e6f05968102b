#pragma once

#include <cstdint>

#include "core/vec3.h"
#include "generate/generated_shape.h"

namespace asdfvk {

// Shapes with diameters in closed form, centred at the origin, triangulated evenly. faceCount is approximate.

/// A geodesic sphere: each face of an icosahedron is divided into n^2 triangles, whose vertices are projected onto the
/// sphere. n is chosen so that 20 n^2 is about faceCount. Diameter: 2 * radius.
[[nodiscard]] GeneratedShape makeSphere(uint64_t faceCount, double radius = 1);
/// An icosahedron after n steps of OpenMesh's Loop subdivision; a projection onto the sphere follows each step. n is
/// chosen so that the ratio of 20 * 4^n to faceCount is closest to 1. Radius 1, diameter 2.
[[nodiscard]] GeneratedShape makeIcosphere(uint64_t faceCount);
/// Diameter: the smallest of the three sizes.
[[nodiscard]] GeneratedShape makeBox(uint64_t faceCount, const Vec3d& size);
/// width: size along x and y. thickness: size along z. Diameter: the thickness.
[[nodiscard]] GeneratedShape makeSlab(uint64_t faceCount, double width = 2, double thickness = 0.1);
/// Diameter: the length of the edge.
[[nodiscard]] GeneratedShape makeCube(uint64_t faceCount, double edge = 1);
/// A cylinder along z with flat caps. Diameter: 2 * radius.
[[nodiscard]] GeneratedShape makeCylinder(uint64_t faceCount, double radius = 0.25, double length = 5);
/// ringRadius: distance of the centre of the tube from the z axis. Diameter: 2 * tubeRadius.
[[nodiscard]] GeneratedShape makeTorus(uint64_t faceCount, double ringRadius = 1, double tubeRadius = 0.3);

}  // namespace asdfvk
