#pragma once

#include <cstdint>

#include "core/vec3.h"
#include "generate/generated_shape.h"

namespace asdfvk {

// Shapes whose diameters are known in closed form, centred at the origin, triangulated evenly. faceCount is
// approximate.

struct SphereParameters {
  double radius = 1;
};
/// A geodesic sphere of 20 n^2 faces: each side of an icosahedron divided into n^2 triangles, projected. Diameter 2
/// radius.
[[nodiscard]] GeneratedShape makeSphere(uint64_t faceCount, const SphereParameters& parameters = {});
/// An icosahedron under OpenMesh's Loop subdivision, projected after each step: 20 * 4^n faces, with the n for which 20
/// * 4^n / faceCount is closest to 1. Diameter 2 radius.
[[nodiscard]] GeneratedShape makeIcosphere(uint64_t faceCount, const SphereParameters& parameters = {});

struct BoxParameters {
  Vec3d size{1, 1, 1};
};
/// Diameter: the smallest of the three sizes.
[[nodiscard]] GeneratedShape makeBox(uint64_t faceCount, const BoxParameters& parameters = {});

struct SlabParameters {
  double width = 2;        ///< Along x and y.
  double thickness = 0.1;  ///< Along z; the diameter.
};
[[nodiscard]] GeneratedShape makeSlab(uint64_t faceCount, const SlabParameters& parameters = {});

struct CubeParameters {
  double edge = 1;  ///< The diameter.
};
[[nodiscard]] GeneratedShape makeCube(uint64_t faceCount, const CubeParameters& parameters = {});

struct CylinderParameters {
  double radius = 0.25;  ///< Half the diameter.
  double length = 5;     ///< Along z, between flat caps.
};
[[nodiscard]] GeneratedShape makeCylinder(uint64_t faceCount, const CylinderParameters& parameters = {});

struct TorusParameters {
  double ringRadius = 1;    ///< Distance of the centre of the tube from the axis z.
  double tubeRadius = 0.3;  ///< Half the diameter.
};
[[nodiscard]] GeneratedShape makeTorus(uint64_t faceCount, const TorusParameters& parameters = {});

}  // namespace asdfvk
