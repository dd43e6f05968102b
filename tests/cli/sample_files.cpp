#include "cli/sample_files.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace asdfvk::test {
namespace {

constexpr std::array<std::array<float, 3>, 8> kVertices{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
constexpr std::array<std::array<int, 3>, 12> kFaces{{{0, 2, 1},
                                                     {1, 2, 3},
                                                     {4, 5, 6},
                                                     {5, 7, 6},
                                                     {0, 1, 4},
                                                     {1, 5, 4},
                                                     {2, 6, 3},
                                                     {3, 6, 7},
                                                     {0, 4, 2},
                                                     {2, 4, 6},
                                                     {1, 3, 5},
                                                     {3, 7, 5}}};

template <typename T>
void append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

std::string plyHeader(const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 12\nproperty list uchar int vertex_indices\nend_header\n",
      format);
}

/// A row per vertex and face, with a text before each.
std::string rows(const char* vertexStart, const char* faceStart, int firstIndex) {
  std::string text;
  for (const auto& v : kVertices) text += fmt::format("{}{} {} {}\n", vertexStart, v[0], v[1], v[2]);
  for (const auto& f : kFaces)
    text += fmt::format("{}{} {} {}\n", faceStart, f[0] + firstIndex, f[1] + firstIndex, f[2] + firstIndex);
  return text;
}

}  // namespace

std::string cubeAsciiPly() { return plyHeader("ascii") + rows("", "3 ", 0); }

std::string cubeBinaryPly() {
  std::string bytes = plyHeader("binary_little_endian");
  for (const auto& vertex : kVertices)
    for (const float x : vertex) append(bytes, x);
  for (const auto& face : kFaces) {
    append(bytes, uint8_t{3});
    for (const int index : face) append(bytes, int32_t{index});
  }
  return bytes;
}

std::string cubeOff() { return "OFF\n8 12 0\n" + rows("", "3 ", 0); }

std::string cubeObj() { return "# cube\n" + rows("v ", "f ", 1); }

std::string cubeBinaryStl() {
  std::string bytes(80, ' ');
  append(bytes, uint32_t{12});
  for (const auto& face : kFaces) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0f);  // The normal: to be computed.
    for (const int index : face)
      for (const float x : kVertices[static_cast<size_t>(index)]) append(bytes, x);
    append(bytes, uint16_t{0});
  }
  return bytes;
}

std::string boxObj(const Vec3d& min, const Vec3d& max, bool isReversed) {
  constexpr int kQuads[6][4]{{-8, -6, -5, -7}, {-4, -3, -1, -2}, {-8, -7, -3, -4},
                             {-6, -2, -1, -5}, {-8, -4, -2, -6}, {-7, -5, -1, -3}};
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", (i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                        (i & 4) != 0 ? max.z : min.z);
  for (const auto& [p, q, r, t] : kQuads)
    text += isReversed ? fmt::format("f {} {} {} {}\n", t, r, q, p) : fmt::format("f {} {} {} {}\n", p, q, r, t);
  return text;
}

std::string sphereOff(int rings) {
  const int sectors = 2 * rings;
  const double pi = std::numbers::pi;
  std::string vertices = "0 0 1\n0 0 -1\n";
  std::string faces;
  const auto index = [&](int ring, int sector) {
    if (ring == 0) return 0;
    if (ring == rings) return 1;
    return 2 + (ring - 1) * sectors + sector % sectors;
  };
  for (int ring = 1; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const double polar = pi * ring / rings;
      const double azimuth = 2 * pi * sector / sectors;
      vertices += fmt::format("{:.9f} {:.9f} {:.9f}\n", std::sin(polar) * std::cos(azimuth),
                              std::sin(polar) * std::sin(azimuth), std::cos(polar));
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const int a = index(ring, sector), b = index(ring, sector + 1);
      const int c = index(ring + 1, sector), d = index(ring + 1, sector + 1);
      if (ring + 1 < rings) faces += fmt::format("3 {} {} {}\n", a, c, d);
      if (ring > 0) faces += fmt::format("3 {} {} {}\n", a, d, b);
    }
  const int vertexCount = 2 + (rings - 1) * sectors;
  const int faceCount = 2 * sectors * (rings - 1);
  return fmt::format("OFF\n{} {} 0\n{}{}", vertexCount, faceCount, vertices, faces);
}

}  // namespace asdfvk::test
