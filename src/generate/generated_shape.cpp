#include "generate/generated_shape.h"

#include <utility>

namespace asdfvk {

GeneratedShape withUniformDiameter(Mesh mesh, double diameter) {
  GeneratedShape shape{std::move(mesh), {}, {}};
  shape.part.assign(shape.mesh.faces.size(), 0);
  shape.diameter.assign(shape.mesh.faces.size(), static_cast<float>(diameter));
  return shape;
}

}  // namespace asdfvk
