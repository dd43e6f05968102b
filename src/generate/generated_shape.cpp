#include "generate/generated_shape.h"

#include <fmt/core.h>

#include <utility>

#include "core/atomic_file.h"

namespace asdfvk {
namespace {

template <typename T>
void putVertices(AtomicFile& file, const TriangleMesh& mesh) {
  for (const Vec3d& p : mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) file.put(static_cast<T>(p[axis]));
}

}  // namespace

void writeGeneratedPly(const std::filesystem::path& path, const GeneratedShape& shape, bool doubleVertices) {
  AtomicFile file(path);
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment asdf-vk-generate: true local diameter and part\n"
      "element vertex {}\nproperty {scalar} x\nproperty {scalar} y\nproperty {scalar} z\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty float diameter\n"
      "property int part\nend_header\n",
      shape.mesh.vertices.size(), shape.mesh.faces.size(), fmt::arg("scalar", doubleVertices ? "double" : "float")));
  doubleVertices ? putVertices<double>(file, shape.mesh) : putVertices<float>(file, shape.mesh);
  for (size_t f = 0; f < shape.mesh.faces.size(); ++f) {
    file.put(uint8_t{3});
    for (const uint32_t corner : shape.mesh.faces[f]) file.put(static_cast<int32_t>(corner));
    file.put(shape.diameter[f]);
    file.put(static_cast<int32_t>(shape.part[f]));
  }
  file.commit();
}

GeneratedShape withUniformDiameter(Mesh mesh, double diameter) {
  GeneratedShape shape{std::move(mesh), {}, {}};
  shape.part.assign(shape.mesh.faces.size(), 0);
  shape.diameter.assign(shape.mesh.faces.size(), static_cast<float>(diameter));
  return shape;
}

}  // namespace asdfvk
