#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/analytic_shapes.h"

namespace asdfvk {

GeneratedShape makeTorus(uint64_t faceCount, const TorusParameters& parameters) {
  const double quads = double(faceCount) / 2;
  const double tube = std::max(3.0, std::round(std::sqrt(quads * parameters.tubeRadius / parameters.ringRadius)));
  const auto tubeCount = static_cast<uint32_t>(tube);
  const auto ringCount = static_cast<uint32_t>(std::max(3.0, std::round(quads / tube)));
  Mesh mesh;
  for (uint32_t i = 0; i < ringCount; ++i) {
    const double u = 2 * std::numbers::pi * i / ringCount;
    for (uint32_t j = 0; j < tubeCount; ++j) {
      const double v = 2 * std::numbers::pi * j / tubeCount;
      const double fromAxis = parameters.ringRadius + parameters.tubeRadius * std::cos(v);
      mesh.vertices.push_back({fromAxis * std::cos(u), fromAxis * std::sin(u), parameters.tubeRadius * std::sin(v)});
    }
  }
  for (uint32_t i = 0; i < ringCount; ++i) {
    const uint32_t row = i * tubeCount, nextRow = (i + 1) % ringCount * tubeCount;
    for (uint32_t j = 0; j < tubeCount; ++j) {
      const uint32_t next = (j + 1) % tubeCount;
      mesh.faces.push_back({row + j, nextRow + j, nextRow + next});
      mesh.faces.push_back({row + j, nextRow + next, row + next});
    }
  }
  return withUniformDiameter(std::move(mesh), 2 * parameters.tubeRadius);
}

}  // namespace asdfvk
