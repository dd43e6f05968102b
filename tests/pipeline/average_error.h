#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/median.h"
#include "core/vec3.h"
#include "support/shared_session.h"

namespace asdfvk::test {

/// Mean of |values - truth| divided by the range of the truth: the average of Table 1 of the paper. No entry is NaN.
inline double averageError(const std::vector<double>& values, const std::vector<double>& truth) {
  const auto [low, high] = std::minmax_element(truth.begin(), truth.end());
  double sum = 0;
  for (size_t i = 0; i < truth.size(); ++i) sum += std::abs(values[i] - truth[i]);
  return sum / (static_cast<double>(truth.size()) * (*high - *low));
}

/// The quantile of |values - truth| / truth.
inline double relativeErrorAt(double share, const std::vector<double>& values, const std::vector<double>& truth) {
  std::vector<double> errors;
  for (size_t i = 0; i < truth.size(); ++i) errors.push_back(std::abs(values[i] - truth[i]) / truth[i]);
  return percentileOf(errors, share);
}

/// Values with rays of that cone cast from every face.
inline std::vector<double> tracedEverywhere(const Mesh& mesh, const ConeOptions& cone = {}) {
  Options options;
  options.seeds = SeedCount::all();
  options.cone = cone;
  return referenceSession().compute(mesh, options).sdf();
}

}  // namespace asdfvk::test
