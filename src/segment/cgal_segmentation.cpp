#include "segment/cgal_segmentation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/free_memory.h"
#include "core/parallel.h"
#include "segment/face_windows.h"
#include "segment/soft_clustering.h"

namespace asdfvk {
namespace {

constexpr double kMinArgument = 5e-6;  ///< Least argument of the logarithms of the costs.
constexpr double kConvexFactor = 0.08, kSmoothnessUnit = 100;
constexpr size_t kFacesPerCutBlock = 4096;

double costOf(double argument) { return -std::log(std::max(kMinArgument, argument)); }

/// The unit normal of a face; 0 if the cross product is 0. For other degenerate faces, rounding errors may dominate the
/// direction.
Vec3d normalOf(const FaceGeometry& geometry, const TriangleMesh& mesh, uint32_t face) {
  if (!geometry.isDegenerate(face)) return geometry.normals[face];
  const auto [a, b, c] = mesh.faces[face];
  const Vec3d normal = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
  return normal == Vec3d{} ? normal : normal / length(normal);
}

/// Returns s angle / pi of cgalEdgeCosts() for the edge from corner i of f to the next corner. In CGAL, the angle at a
/// face of zero area is 0 or pi, by the signs of zeros, and the edge is convex. If only g has zero area, the result
/// agrees with CGAL. If f has zero area, the results may differ.
double edgeArgument(const FaceGeometry& geometry, const TriangleMesh& mesh, uint32_t f, uint32_t i, uint32_t g) {
  const Vec3d ofF = normalOf(geometry, mesh, f), ofG = normalOf(geometry, mesh, g);
  if (ofF == Vec3d{} || ofG == Vec3d{}) {
    const Vec3d signs = ofF == Vec3d{} ? -ofG : ofF;
    return signs.x > 0 && signs.y > 0 && signs.z > 0 ? 0 : kConvexFactor;
  }
  // The arc tangent is accurate for small angles; the arc cosine is not.
  const double angle = std::atan2(length(cross(ofF, ofG)), dot(ofF, ofG));
  const uint32_t from = mesh.faces[f][i], to = mesh.faces[f][(i + 1) % 3];
  const Face& other = mesh.faces[g];
  const uint32_t apex = *std::find_if(other.begin(), other.end(), [&](uint32_t v) { return v != from && v != to; });
  const bool isConvex = dot(ofF, mesh.vertices[apex] - mesh.vertices[from]) < 0;
  return angle / std::numbers::pi * (isConvex ? kConvexFactor : 1);
}

/// Returns the edges with each face replaced by its place in `order`, sorted by the lower place.
std::vector<LabelEdge> reordered(const std::vector<LabelEdge>& edges, std::span<const uint32_t> order) {
  std::vector<uint32_t> placeOf(order.size()), firstEdge(order.size() + 1);
  for (uint32_t i = 0; i < order.size(); ++i) placeOf[order[i]] = i;
  const auto lowerPlace = [&](const LabelEdge& edge) { return std::min(placeOf[edge.f], placeOf[edge.g]); };
  for (const LabelEdge& edge : edges) ++firstEdge[lowerPlace(edge) + 1];
  std::partial_sum(firstEdge.begin(), firstEdge.end(), firstEdge.begin());
  std::vector<LabelEdge> result(edges.size());
  for (const LabelEdge& edge : edges)
    result[firstEdge[lowerPlace(edge)]++] = {placeOf[edge.f], placeOf[edge.g], edge.cost};
  return result;
}

}  // namespace

CgalSegmentation segmentLikeCgal(const FaceGeometry& geometry, const TriangleMesh& mesh,
                                 const FaceNeighbours& neighbours, std::span<const double> values,
                                 const CgalSegmentationOptions& options, const RunControl& control) {
  ASDFVK_CHECK(std::isfinite(options.smoothness));
  ASDFVK_CHECK_OP(values.size(), ==, mesh.faces.size());
  ASDFVK_CHECK_OP(neighbours.size(), ==, mesh.faces.size());
  if (values.empty()) throw Error(ErrorCode::NoValues, "there are no values to cluster");
  const RunControl stopOnly = control.withoutProgress();
  std::vector<double> logarithms(values.size());
  for (size_t face = 0; face < values.size(); ++face) logarithms[face] = std::log(5 * values[face] + 1) / std::log(6.0);
  ASDFVK_CHECK(std::all_of(logarithms.begin(), logarithms.end(), [](double value) { return std::isfinite(value); }));
  const uint32_t clusterCount = options.clusterCount;
  SoftClustering clustering = clusterSoftly(logarithms, clusterCount, stopOnly);
  stopOnly.checkpoint(0);
  std::vector<double>& costs = clustering.probabilities;
  CgalSegmentation result;
  result.clusters.resize(values.size());
  // Neighbouring faces have near numbers in this order, which reduces the time of the cut to two thirds or less.
  const std::vector<uint32_t> order = orderByBlocks(neighbours, kFacesPerCutBlock);
  stopOnly.checkpoint(0);
  std::vector<double> orderedCosts(costs.size());
  std::vector<uint32_t> labels(values.size());
  forEachInParallel(values.size(), [&](uint32_t i) {
    const auto row = std::span(costs).subspan(size_t{order[i]} * clusterCount, clusterCount);
    labels[i] = static_cast<uint32_t>(std::max_element(row.begin(), row.end()) - row.begin());
    for (uint32_t c = 0; c < clusterCount; ++c) orderedCosts[size_t{i} * clusterCount + c] = costOf(row[c]);
  });
  freeMemory(costs);
  stopOnly.checkpoint(0);
  const std::vector<LabelEdge> edges = reordered(cgalEdgeCosts(geometry, mesh, neighbours, options.smoothness), order);
  const bool isFirstOnly = options.expansion == CgalExpansion::First;
  result.energy = AlphaExpansion().minimize({clusterCount, orderedCosts, edges}, labels,
                                            {.expandedLabelCount = isFirstOnly ? 1 : clusterCount}, control);
  for (size_t i = 0; i < order.size(); ++i) result.clusters[order[i]] = labels[i];
  LabelComponents components = findLabelComponents(neighbours, result.clusters, values);
  result.segments = std::move(components.componentOf);
  result.segmentCount = components.componentCount;
  return result;
}

std::vector<LabelEdge> cgalEdgeCosts(const FaceGeometry& geometry, const TriangleMesh& mesh,
                                     const FaceNeighbours& neighbours, double smoothness) {
  const auto isOwner = [&](uint32_t f, uint32_t i) { return neighbours[f][i] != kNoNeighbour && f < neighbours[f][i]; };
  std::vector<uint32_t> firstEdge(neighbours.size() + 1);
  for (uint32_t f = 0; f < neighbours.size(); ++f)
    firstEdge[f + 1] = firstEdge[f] + isOwner(f, 0) + isOwner(f, 1) + isOwner(f, 2);
  std::vector<LabelEdge> edges(firstEdge.back());
  const double unit = kSmoothnessUnit * std::max(0.0, smoothness);
  forEachInParallel(neighbours.size(), [&](uint32_t f) {
    for (uint32_t i = 0, edge = firstEdge[f]; i < 3; ++i) {
      if (!isOwner(f, i)) continue;
      const uint32_t g = neighbours[f][i];
      edges[edge++] = {f, g, unit * costOf(edgeArgument(geometry, mesh, f, i, g))};
    }
  });
  return edges;
}

LabelComponents findLabelComponents(const FaceNeighbours& neighbours, std::span<const uint32_t> labels,
                                    std::span<const double> values) {
  constexpr uint32_t kNone = kNoNeighbour;
  LabelComponents result{std::vector<uint32_t>(labels.size(), kNone)};
  std::vector<uint32_t>& componentOf = result.componentOf;
  std::vector<double> means;
  std::vector<uint32_t> faces;
  for (uint32_t first = 0; first < labels.size(); ++first) {
    if (componentOf[first] != kNone) continue;
    const auto component = static_cast<uint32_t>(means.size());
    double sum = 0;
    faces.assign(1, first);
    componentOf[first] = component;
    for (size_t i = 0; i < faces.size(); ++i) {
      sum += values[faces[i]];
      for (const uint32_t face : neighbours[faces[i]])
        if (face != kNoNeighbour && componentOf[face] == kNone && labels[face] == labels[first]) {
          componentOf[face] = component;
          faces.push_back(face);
        }
    }
    means.push_back(sum / static_cast<double>(faces.size()));
  }
  std::vector<uint32_t> order(means.size()), rankOf(means.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return means[a] < means[b]; });
  for (uint32_t rank = 0; rank < order.size(); ++rank) rankOf[order[rank]] = rank;
  for (uint32_t& component : componentOf) component = rankOf[component];
  result.componentCount = static_cast<uint32_t>(means.size());
  return result;
}

}  // namespace asdfvk
