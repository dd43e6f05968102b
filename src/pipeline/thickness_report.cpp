#include <algorithm>
#include <cmath>
#include <utility>

#include "core/weighted_sample.h"
#include "pipeline/result.h"
#include "pipeline/thickness.h"

namespace asdfvk {
namespace {

/// By area, over the triangles with a value.
void describePercentiles(std::span<const double> values, std::span<const double> areas, ThicknessReport& report) {
  WeightedSample sample;
  for (size_t face = 0; face < values.size(); ++face)
    if (!std::isnan(values[face])) sample.add(values[face], areas[face]);
  if (sample.isEmpty()) return;
  sample.sort();
  report.percentile1 = sample.quantile(0.01);
  report.percentile5 = sample.quantile(0.05);
  report.median = sample.quantile(0.5);
  report.percentile95 = sample.quantile(0.95);
  report.max = sample.max();
}

/// The thin faces that are connected with `first`, itself included; ascending.
std::vector<uint32_t> takeRegion(const DualGraph& graph, uint32_t first, std::vector<uint8_t>& isThin) {
  std::vector<uint32_t> region{first};
  isThin[first] = 0;
  for (size_t i = 0; i < region.size(); ++i)
    for (const uint32_t neighbour : graph.neighboursOf(region[i]))
      if (std::exchange(isThin[neighbour], uint8_t{0}) != 0) region.push_back(neighbour);
  std::sort(region.begin(), region.end());
  return region;
}

ThinRegion describeRegion(const Computation& computation, const FaceThickness& thickness,
                          std::span<const uint32_t> faces) {
  const PreparedMesh& prepared = computation.prepared;
  const std::span<const double> values = thickness.least;
  ThinRegion region;
  const uint32_t thinnest =
      *std::min_element(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) { return values[a] < values[b]; });
  region.min = values[thinnest];
  region.minFace = prepared.mesh.inputFaceOf(thinnest);
  region.place = region.opposite = prepared.geometry.barycentres[thinnest];
  if (const uint32_t wall = thickness.leastWalls[thinnest]; wall != kNoFace) {
    const TraceScene& scene = computation.scene;
    const TouchingBall ball = leastTouchingBall(triangleOf(scene, thinnest), triangleOf(scene, wall), kMinWallDepth);
    const Normalization& normalization = scene.bvh.normalization;
    region.place = ball.onFace / normalization.scale + normalization.centre;
    region.opposite = ball.onWall / normalization.scale + normalization.centre;
  }
  uint64_t lastInputFace = prepared.mesh.inputFaceCount();
  for (const uint32_t face : faces) {
    region.area += prepared.geometry.areas[face];
    region.faceCount += prepared.mesh.inputFaceOf(face) == lastInputFace ? 0 : 1;
    lastInputFace = prepared.mesh.inputFaceOf(face);
  }
  return region;
}

/// Of the faces of the domain.
double totalArea(const PreparedMesh& prepared, const FaceDomain& domain) {
  double total = 0;
  for (uint32_t face = 0; face < prepared.mesh.faceCount(); ++face)
    if (domain.contains(prepared.mesh.inputFaceOf(face))) total += prepared.geometry.areas[face];
  return total;
}

void describeThinRegions(const Computation& computation, const FaceThickness& thickness, double limit,
                         ThicknessReport& report, ThinSurface& surface) {
  const PreparedMesh& prepared = computation.prepared;
  const std::span<const double> values = thickness.least;
  std::vector<uint8_t> isThin(values.size());
  for (size_t face = 0; face < values.size(); ++face) isThin[face] = values[face] < limit ? 1 : 0;
  for (uint32_t face = 0; face < values.size(); ++face)
    if (isThin[face] != 0)
      report.thinRegions.push_back(describeRegion(computation, thickness, takeRegion(prepared.graph, face, isThin)));
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (!(values[face] < limit)) continue;
    const auto& [a, b, c] = prepared.mesh.faces[face];
    surface.triangles.push_back({prepared.mesh.vertices[a], prepared.mesh.vertices[b], prepared.mesh.vertices[c]});
    surface.regions.push_back(0);
  }
  const double total = totalArea(prepared, computation.domain);
  for (ThinRegion& region : report.thinRegions) {
    region.areaShare = total > 0 ? region.area / total : 0;
    report.thinArea += region.area;
    report.thinAreaShare += region.areaShare;
  }
  std::stable_sort(report.thinRegions.begin(), report.thinRegions.end(),
                   [](const ThinRegion& a, const ThinRegion& b) { return a.area > b.area; });
}

}  // namespace

ThicknessReport describeThickness(const Computation& computation, const FaceThickness& thickness,
                                  ThinSurface& surface) {
  const PreparedMesh& prepared = computation.prepared;
  ThicknessReport report;
  describePercentiles(thickness.atBarycentre, prepared.geometry.areas, report);
  for (const double least : thickness.least)
    if (!(report.min <= least) && !std::isnan(least)) report.min = least;
  report.noValueCount = countWithoutValue(computation.domain, thicknessOfInputFaces(prepared.mesh, thickness.least));
  if (thickness.greatestSection)
    report.greatestSection = {thickness.greatestSection->diameter, thickness.greatestSection->centre};
  report.thinnerThan = computation.options.thickness.thinnerThan;
  if (report.thinnerThan) describeThinRegions(computation, thickness, *report.thinnerThan, report, surface);
  report.allowsSharpEdges = computation.options.thickness.allowsSharpEdges;
  if (report.thinnerThan)
    report.verdict = report.min < *report.thinnerThan ? ThicknessVerdict::Failed : ThicknessVerdict::Passed;
  return report;
}

}  // namespace asdfvk
