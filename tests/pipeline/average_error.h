#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/shared_session.h"

namespace asdfvk::test {

/// The mean of |values - truth| over the range of the truth: the average of the paper's Table 1. No entry is NaN.
inline double averageError(const std::vector<double>& values, const std::vector<double>& truth) {
  const auto [low, high] = std::minmax_element(truth.begin(), truth.end());
  double sum = 0;
  for (size_t i = 0; i < truth.size(); ++i) sum += std::abs(values[i] - truth[i]);
  return sum / (static_cast<double>(truth.size()) * (*high - *low));
}

/// The values with rays cast from every face, with that cone.
inline std::vector<double> tracedEverywhere(Mesh mesh, const ConeOptions& cone = {}) {
  Options options;
  options.seeds.kind = SeedCount::Kind::All;
  options.cone = cone;
  return referenceSession().compute(mesh, options).sdf;
}

/// Two meshes in one, the other moved.
inline Mesh joined(Mesh mesh, const Mesh& other, const Vec3d& shift) {
  const auto offset = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& vertex : other.vertices) mesh.vertices.push_back(vertex + shift);
  for (const auto& [a, b, c] : other.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  return mesh;
}

}  // namespace asdfvk::test
