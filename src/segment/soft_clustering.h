#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"

/// Soft clustering of numbers by a Gaussian mixture that is initialised by k-means++. Method, random numbers and limits
/// are those of CGAL's segmentation_from_sdf_values(). These details were derived from the outputs of version 5.5.1,
/// without code of CGAL.
namespace asdfvk {

/// Clusters ascend by mean.
struct SoftClustering {
  /// One entry per cluster. A deviation may be 0; the sum of the weights is 1.
  std::vector<double> means, deviations, weights;
  std::vector<double> probabilities;  ///< #values x #clusters: a row per value, with the probability of each cluster.
};

/// Expectation and maximization (A. Dempster, N. Laird, D. Rubin: Maximum Likelihood from Incomplete Data via the EM
/// Algorithm, 1977), at most 10 steps, from the clusters of clusterByMeans(). values: finite. The result has the same
/// bits on any number of threads. clusterCount: 1 to kMaxClusterCount. Throws Error{TooFewValues} if there are fewer
/// different values than clusters, and Error{Cancelled}.
[[nodiscard]] SoftClustering clusterSoftly(std::span<const double> values, uint32_t clusterCount,
                                           const RunControl& stopOnly = {});

/// k-means (at most 10 steps) from the seeds of k-means++ (D. Arthur, S. Vassilvitskii: k-means++: The Advantages of
/// Careful Seeding, SODA 2007).
struct HardClustering {
  std::vector<double> centres;      ///< Centres of the clusters, in the order of their seeds.
  std::vector<uint32_t> clusterOf;  ///< #values: the cluster of the nearest centre.
};

/// Throws as clusterSoftly().
[[nodiscard]] HardClustering clusterByMeans(std::span<const double> values, uint32_t clusterCount,
                                            const RunControl& stopOnly = {});

}  // namespace asdfvk
