#include "bvh/device_bvh.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "bvh_invariants.h"
#include "bvh_meshes.h"
#include "device_hierarchy.h"

using namespace asdfvk;

namespace {

using Texel = std::array<uint32_t, 4>;

template <typename T>
std::vector<Texel> texelsOf(const std::vector<T>& items) {
  std::vector<Texel> texels(items.size() * sizeof(T) / sizeof(Texel));
  if (!items.empty()) std::memcpy(texels.data(), items.data(), items.size() * sizeof(T));
  return texels;
}

float asFloat(uint32_t bits) {
  float f = 0;
  std::memcpy(&f, &bits, 4);
  return f;
}

Vec3f pointOf(const Texel& texel) { return {asFloat(texel[0]), asFloat(texel[1]), asFloat(texel[2])}; }

// The octahedral map of Cigolle et al. 2014, back to a direction.
Vec3d normalOf(float u, float v) {
  Vec3d n{u, v, 1.0 - std::abs(u) - std::abs(v)};
  if (n.z < 0) {
    n.x = std::copysign(1.0 - std::abs(v), u);
    n.y = std::copysign(1.0 - std::abs(u), v);
  }
  return n / length(n);
}

}  // namespace

TEST_CASE("the device's texels decode to the triangles") {
  const Mesh mesh = soup(1000, 2);
  const Bvh bvh = buildOver(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const std::vector<Texel> texels = texelsOf(encodeForDevice(bvh, mesh, geometry).triangles);
  REQUIRE(texels.size() == 3 * mesh.faces.size());
  for (size_t primitive = 0; primitive < mesh.faces.size(); ++primitive) {
    const uint32_t face = texels[3 * primitive][3];
    const Vec3d normal = normalOf(asFloat(texels[3 * primitive + 1][3]), asFloat(texels[3 * primitive + 2][3]));
    REQUIRE(length(normal - geometry.normals[face]) < 3e-7);
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d p = bvh.normalization.toNormalized(mesh.vertices[mesh.faces[face][k]]);
      REQUIRE(pointOf(texels[3 * primitive + k]) == Vec3f(p));
    }
  }
}
