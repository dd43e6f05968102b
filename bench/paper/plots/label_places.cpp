#include "paper/plots/label_places.h"

#include <algorithm>
#include <numeric>

namespace asdfvk::bench {
namespace {

/// Labels that touch: they stand around the mean of what they wish.
struct Cluster {
  double sum = 0;  ///< Of where each would have the first label of the cluster.
  size_t count = 0;
  [[nodiscard]] double first() const { return sum / static_cast<double>(count); }
};

}  // namespace

std::vector<double> placeLabels(const std::vector<double>& wished, double distance, double low, double high) {
  const size_t count = wished.size();
  if (count > 1) distance = std::min(distance, (high - low) / static_cast<double>(count - 1));
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return wished[a] < wished[b]; });

  std::vector<Cluster> clusters;
  const auto lengthOf = [&](const Cluster& cluster) { return static_cast<double>(cluster.count) * distance; };
  const auto startOf = [&](const Cluster& cluster) {
    return std::clamp(cluster.first(), low, std::max(low, high - lengthOf(cluster) + distance));
  };
  for (const size_t label : order) {
    clusters.push_back({wished[label], 1});
    while (clusters.size() > 1) {
      Cluster& last = clusters.back();
      Cluster& before = clusters[clusters.size() - 2];
      if (startOf(before) + lengthOf(before) <= startOf(last)) break;
      before.sum += last.sum - static_cast<double>(last.count) * lengthOf(before);
      before.count += last.count;
      clusters.pop_back();
    }
  }
  std::vector<double> places(count);
  size_t next = 0;
  for (const Cluster& cluster : clusters)
    for (size_t i = 0; i < cluster.count; ++i)
      places[order[next++]] = startOf(cluster) + static_cast<double>(i) * distance;
  return places;
}

}  // namespace asdfvk::bench
