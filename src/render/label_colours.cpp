#include "render/label_colours.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/dual_graph.h"

namespace asdfvk {
namespace {

/// Pairs of labels that share an edge, in both orders, ascending.
std::vector<std::pair<uint32_t, uint32_t>> adjacentLabels(const TriangleMesh& mesh, std::span<const uint32_t> labels) {
  const DualGraph graph = buildDualGraph(mesh);
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (uint32_t face = 0; face < graph.faceCount(); ++face)
    for (const uint32_t neighbour : graph.neighboursOf(face))
      if (labels[face] != labels[neighbour]) pairs.emplace_back(labels[face], labels[neighbour]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<Rgb> labelColours(const TriangleMesh& mesh, std::span<const double> areas,
                              std::span<const uint32_t> labels) {
  // The labels as 0, 1, ...: they may be any numbers.
  std::vector<uint32_t> used(labels.begin(), labels.end()), ranks(labels.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<double> areaOf(used.size());
  for (size_t face = 0; face < labels.size(); ++face) {
    ranks[face] = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), labels[face]) - used.begin());
    areaOf[ranks[face]] += areas[face];
  }
  std::vector<uint32_t> order(used.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return areaOf[a] > areaOf[b]; });

  constexpr size_t kColourCount = kLabelColours.size();
  const std::vector<std::pair<uint32_t, uint32_t>> pairs = adjacentLabels(mesh, ranks);
  std::vector<size_t> colourOf(used.size(), kColourCount);
  std::array<size_t, kColourCount> useCounts{};
  for (const uint32_t label : order) {
    std::array<std::pair<size_t, size_t>, kColourCount> counts{};  // Among the neighbours, and in all.
    for (size_t colour = 0; colour < kColourCount; ++colour) counts[colour].second = useCounts[colour];
    for (auto pair = std::lower_bound(pairs.begin(), pairs.end(), std::pair(label, 0u));
         pair != pairs.end() && pair->first == label; ++pair)
      if (const size_t colour = colourOf[pair->second]; colour < kColourCount) ++counts[colour].first;
    colourOf[label] = static_cast<size_t>(std::min_element(counts.begin(), counts.end()) - counts.begin());
    ++useCounts[colourOf[label]];
  }
  std::vector<Rgb> colours(labels.size());
  for (size_t face = 0; face < labels.size(); ++face) colours[face] = kLabelColours[colourOf[ranks[face]]];
  return colours;
}

}  // namespace asdfvk
