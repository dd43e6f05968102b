#pragma once

#include <string>

namespace asdfvk::test {

// Files as bytes: a cube of side 1 with 8 vertices and 12 triangles facing outwards (STL: 36 corners).
std::string cubeAsciiPly();
std::string cubeBinaryPly();
std::string cubeOff();
std::string cubeObj();
std::string cubeBinaryStl();

/// A sphere of radius 1 and 4 * rings * (rings - 1) triangles as OFF.
std::string sphereOff(int rings);

}  // namespace asdfvk::test
