#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/mesh.h"

namespace asdfvk::test {

/// Separate cubes whose sides are quads, six per cube, then a face of two corners. As the arrays of a caller.
struct QuadCubes {
  struct Cube {
    double size, shift;  ///< Edge length, and shift along x.
  };
  std::vector<double> positions;
  std::vector<uint32_t> corners;
  std::vector<uint64_t> firstCorner{0};

  explicit QuadCubes(std::span<const Cube> cubes) {
    for (const Cube& cube : cubes) {
      const auto offset = static_cast<uint32_t>(positions.size() / 3);
      for (uint32_t i = 0; i < 8; ++i)
        for (uint32_t axis = 0; axis < 3; ++axis)
          positions.push_back(cube.size * ((i >> axis) & 1) + (axis == 0 ? cube.shift : 0));
      for (const auto& quad : {std::array{0u, 2u, 3u, 1u},
                               {4u, 5u, 7u, 6u},
                               {0u, 1u, 5u, 4u},
                               {2u, 6u, 7u, 3u},
                               {0u, 4u, 6u, 2u},
                               {1u, 3u, 7u, 5u}}) {
        for (const uint32_t corner : quad) corners.push_back(corner + offset);
        firstCorner.push_back(corners.size());
      }
    }
    corners.insert(corners.end(), {0, 1});
    firstCorner.push_back(corners.size());
  }

  [[nodiscard]] MeshView view() const { return {std::span<const double>(positions), corners, firstCorner}; }
};

}  // namespace asdfvk::test
