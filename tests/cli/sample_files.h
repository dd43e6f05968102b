#pragma once

#include <string>

#include "asdf_vk/mesh.h"

namespace asdfvk::test {

// Files as bytes: a cube of side 1 with 8 vertices and 12 triangles facing outwards (STL: 36 corners).
std::string cubeAsciiPly();
std::string cubeBinaryPly();
std::string cubeOff();
std::string cubeObj();
std::string cubeBinaryStl();

/// A box of OBJ, with indices relative to its last vertex, so that boxes can follow each other.
std::string boxObj(const Vec3d& min, const Vec3d& max, bool isReversed = false);

/// A sphere of radius 1 and 4 * rings * (rings - 1) triangles as OFF.
std::string sphereOff(int rings);

}  // namespace asdfvk::test
