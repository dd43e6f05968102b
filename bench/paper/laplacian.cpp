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

std::vector<double> overPercentile(std::vector<double> values, double share) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present), [](double v) { return !std::isnan(v); });
  if (present.empty()) return values;
  const auto rank = std::lround(share * static_cast<double>(present.size() - 1));
  std::nth_element(present.begin(), present.begin() + rank, present.end());
  const double whole = present[static_cast<size_t>(rank)];
  for (double& value : values)
    if (!std::isnan(value)) value = whole > 0 ? std::min(value / whole, 1.0) : 0;
  return values;
}

}  // namespace asdfvk::bench
