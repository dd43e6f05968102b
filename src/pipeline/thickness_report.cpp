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
  report.min = sample.min();
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

ThinRegion describeRegion(const PreparedMesh& prepared, std::span<const uint32_t> faces,
                          std::span<const double> values) {
  ThinRegion region;
  const uint32_t thinnest =
      *std::min_element(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) { return values[a] < values[b]; });
  region.min = values[thinnest];
  region.minFace = prepared.mesh.inputFaceOf(thinnest);
  region.place = prepared.geometry.barycentres[thinnest];
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

void describeThinRegions(const PreparedMesh& prepared, const FaceDomain& domain, std::span<const double> values,
                         double limit, ThicknessReport& report) {
  std::vector<uint8_t> isThin(values.size());
  for (size_t face = 0; face < values.size(); ++face) isThin[face] = values[face] < limit ? 1 : 0;
  for (uint32_t face = 0; face < values.size(); ++face)
    if (isThin[face] != 0)
      report.thinRegions.push_back(describeRegion(prepared, takeRegion(prepared.graph, face, isThin), values));
  const double total = totalArea(prepared, domain);
  for (ThinRegion& region : report.thinRegions) {
    region.areaShare = total > 0 ? region.area / total : 0;
    report.thinArea += region.area;
    report.thinAreaShare += region.areaShare;
  }
  std::stable_sort(report.thinRegions.begin(), report.thinRegions.end(),
                   [](const ThinRegion& a, const ThinRegion& b) { return a.area > b.area; });
}

}  // namespace

ThicknessReport describeThickness(const PreparedMesh& prepared, const FaceDomain& domain,
                                  const FaceThickness& thickness, std::span<const double> field,
                                  const std::optional<double>& limit) {
  ThicknessReport report;
  describePercentiles(thickness.values, prepared.geometry.areas, report);
  report.noValueCount = countWithoutValue(domain, field);
  report.tracedCount =
      static_cast<uint64_t>(std::count(thickness.isTraced.begin(), thickness.isTraced.end(), uint8_t{1}));
  report.verifiedCount = thickness.verifiedCount;
  report.unrefinedCount = thickness.statistics.unrefinedCount;
  report.redoneBallCount = thickness.statistics.redoneBallCount;
  report.thinnerThan = limit;
  if (limit) describeThinRegions(prepared, domain, thickness.values, *limit, report);
  return report;
}

}  // namespace asdfvk
