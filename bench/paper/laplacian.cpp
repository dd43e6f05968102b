#include "paper/laplacian.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk::bench {

std::vector<double> absoluteLaplacian(const Mesh& mesh, std::span<const double> values) {
  ASDFVK_CHECK_OP(values.size(), ==, mesh.faces.size());
  const DualGraph graph = buildDualGraph(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<double> laplacian(values.size(), kNoValue);
  for (uint32_t face = 0; face < graph.faceCount(); ++face) {
    if (std::isnan(values[face])) continue;
    double sum = 0;
    for (const uint32_t neighbour : graph.neighboursOf(face)) {
      const double distance = length(geometry.barycentres[neighbour] - geometry.barycentres[face]);
      if (distance > 0 && !std::isnan(values[neighbour])) sum += (values[face] - values[neighbour]) / distance;
    }
    laplacian[face] = std::abs(sum);
  }
  return laplacian;
}

double percentileOf(std::vector<double> values, double share) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return kNoValue;
  const auto rank = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<size_t>(rank)];
}

}  // namespace asdfvk::bench
