#include "pipeline/input_face_values.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {
namespace {

/// Numbers the labels in use 0, 1, ... in their order.
void renumber(std::vector<uint32_t>& labels, size_t labelCount) {
  std::vector<uint32_t> newLabels(labelCount, kNoSegment);
  for (const uint32_t label : labels)
    if (label != kNoSegment) newLabels[label] = 0;
  uint32_t count = 0;
  for (uint32_t& label : newLabels)
    if (label != kNoSegment) label = count++;
  for (uint32_t& label : labels)
    if (label != kNoSegment) label = newLabels[label];
}

}  // namespace

std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::vector<double> values,
                                       std::span<const double> areas) {
  if (mesh.polygons.isEmpty()) return values;
  std::vector<double> sums(mesh.inputFaceCount(), 0), weights(mesh.inputFaceCount(), 0);
  std::vector<double> last(mesh.inputFaceCount(), kNoValue);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    if (std::isnan(values[face])) continue;
    const uint32_t inputFace = mesh.polygons.inputFaceOf[face];
    sums[inputFace] += areas[face] * values[face];
    weights[inputFace] += areas[face];
    last[inputFace] = values[face];
  }
  // If all triangles with a value have zero area, the value of the last of them remains.
  for (size_t i = 0; i < sums.size(); ++i)
    if (weights[i] > 0) last[i] = sums[i] / weights[i];
  return last;
}

std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed) {
  if (mesh.polygons.isEmpty()) return {isSeed.begin(), isSeed.end()};
  std::vector<uint8_t> seeds(mesh.inputFaceCount(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) seeds[mesh.polygons.inputFaceOf[face]] |= isSeed[face];
  return seeds;
}

uint32_t labelOfLargestArea(std::vector<std::pair<uint32_t, double>>& areas) {
  std::stable_sort(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double largest = -1, sum = 0;
  uint32_t best = kNoSegment;
  for (size_t i = 0; i < areas.size(); ++i) {
    const auto [label, area] = areas[i];
    sum = i > 0 && areas[i - 1].first == label ? sum + area : area;
    if (sum <= largest) continue;
    largest = sum;
    best = label;
  }
  return best;
}

std::vector<uint32_t> labelsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> labels,
                                         std::span<const double> areas) {
  if (mesh.polygons.isEmpty()) return {labels.begin(), labels.end()};
  std::vector<uint32_t> ofInputFaces(mesh.inputFaceCount(), kNoSegment);
  std::vector<std::pair<uint32_t, double>> areaOf;  // Area of each label of a polygon.
  for (uint32_t begin = 0, end = 0; begin < mesh.faceCount(); begin = end) {
    const uint32_t inputFace = mesh.inputFaceOf(begin);
    areaOf.clear();
    for (; end < mesh.faceCount() && mesh.inputFaceOf(end) == inputFace; ++end)
      areaOf.emplace_back(labels[end], areas[end]);
    ofInputFaces[inputFace] = labelOfLargestArea(areaOf);
  }
  return ofInputFaces;
}

std::vector<uint32_t> segmentsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> segments,
                                           std::span<const double> areas) {
  std::vector<uint32_t> ofInputFaces = labelsOfInputFaces(mesh, segments, areas);
  if (!mesh.polygons.isEmpty()) renumber(ofInputFaces, *std::max_element(segments.begin(), segments.end()) + size_t{1});
  return ofInputFaces;
}

uint32_t countSegments(std::span<const uint32_t> segments) {
  uint32_t count = 0;
  for (const uint32_t segment : segments)
    if (segment != kNoSegment) count = std::max(count, segment + 1);
  return count;
}

}  // namespace asdfvk
