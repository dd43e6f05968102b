#pragma once

#include <cstdint>
#include <optional>

#include "generate/generated_shape.h"

namespace asdfvk {

struct AssemblyParameters {
  uint64_t seed = 1;
  bool interpenetrates = false;  ///< The units of the stack sink into one another, instead of touching.
  /// The parts are moved apart along one line, with at least this distance between two of them. Each part is the same
  /// but for the translation, and the order of the faces too.
  std::optional<double> apart;
};

/// 2 to 8 closed parts, `part` of each face: plates, boxes side by side, prisms, cut spheres, pins in sleeves, blocks
/// in pockets and cavities, balls in cylinders. Each part has a contact area with another one, where the two are cut
/// into different triangles. Three of four assemblies are turned at random. `diameter` is 0: unknown.
[[nodiscard]] GeneratedShape makeAssembly(const AssemblyParameters& parameters = {});

/// A box or prism whose surface is there twice, cut at both diagonals of each quad. `diameter` is 0: unknown.
[[nodiscard]] GeneratedShape makeDoubledSolid(uint64_t seed);

}  // namespace asdfvk
