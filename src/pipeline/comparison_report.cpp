#include "pipeline/comparison_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/disjoint_sets.h"
#include "pipeline/thickness_report.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxListedRegions = 100;

/// The face of a triangle whose thickness decreased most. The ratio is 1 if none did.
struct GreatestDecrease {
  uint32_t face = kNoFace;
  double ratio = 1;
};

/// By triangle of the mesh.
std::vector<GreatestDecrease> decreasesOf(const MeasuredVersion& now, std::span<const double> formerThickness) {
  std::vector<GreatestDecrease> decreases(now.surface.original().prepared.mesh.faceCount());
  for (uint32_t face = 0; face < formerThickness.size(); ++face) {
    const double ratio = now.thickness.atBarycentre[face] / formerThickness[face];
    GreatestDecrease& least = decreases[now.surface.triangleOf(face)];
    if (ratio < kThinnerShare && ratio < least.ratio) least = {face, ratio};
  }
  return decreases;
}

/// Adds the regions that became thinner.
void addThinnerRegions(const MeasuredVersion& now, std::span<const double> formerThickness, ComparisonReport& report) {
  const PreparedMesh& original = now.surface.original().prepared;
  const std::vector<GreatestDecrease> decreases = decreasesOf(now, formerThickness);
  DisjointSets sets(decreases.size());
  for (uint32_t triangle = 0; triangle < decreases.size(); ++triangle) {
    if (decreases[triangle].face == kNoFace) continue;
    for (const uint32_t neighbour : original.graph.neighboursOf(triangle))
      if (decreases[neighbour].face != kNoFace) sets.join(triangle, neighbour);
  }
  struct Found {
    ThinnerRegion region;
    double ratio = 1;
    uint64_t lastInputFace = UINT64_MAX;
  };
  std::map<uint32_t, Found> regions;
  const double total = computedArea(now.computation);
  for (uint32_t triangle = 0; triangle < decreases.size(); ++triangle) {
    const auto& [face, ratio] = decreases[triangle];
    if (face == kNoFace) continue;
    Found& found = regions[sets.lowestOf(triangle)];
    ThinnerRegion& region = found.region;
    const uint64_t inputFace = original.mesh.inputFaceOf(triangle);
    if (inputFace != found.lastInputFace) ++region.faceCount;
    found.lastInputFace = inputFace;
    region.area += original.geometry.areas[triangle];
    if (!(ratio < found.ratio)) continue;
    found.ratio = ratio;
    region.face = inputFace;
    region.thickness = now.thickness.atBarycentre[face];
    region.formerThickness = formerThickness[face];
    region.place = now.computation.prepared.geometry.barycentres[face];
  }
  for (auto& [first, found] : regions) {
    found.region.areaShare = total > 0 ? found.region.area / total : 0;
    report.thinnerArea += found.region.area;
    report.thinnerAreaShare += found.region.areaShare;
    report.thinner.push_back(found.region);
  }
  std::stable_sort(report.thinner.begin(), report.thinner.end(),
                   [](const ThinnerRegion& a, const ThinnerRegion& b) { return a.area > b.area; });
  if (report.thinner.size() > kMaxListedRegions) report.thinner.resize(kMaxListedRegions);
}

/// A new or thinner wall fails only if the former version is known: where it is open, a wall may have been missing.
ThicknessVerdict verdictOf(const MeasuredVersion& former, const ComparisonReport& report,
                           const ThicknessReport& described) {
  const std::vector<UnjudgedReason>& reasons = described.unjudged.reasons;
  if (std::any_of(reasons.begin(), reasons.end(),
                  [](const UnjudgedReason& reason) { return concernsWholeMesh(reason.cause); }))
    return ThicknessVerdict::NotJudged;
  const bool isWorse = report.newCount + report.thinnerCount > 0,
             isFormerKnown =
                 !former.thickness.unjudged.preventVerdict() && !former.computation.prepared.traceableFaces.empty();
  if (isWorse && isFormerKnown) return ThicknessVerdict::Failed;
  const bool isUnclear =
      isWorse || report.matchedFaceCount == 0 || *described.verdict == ThicknessVerdict::NotJudged || !reasons.empty();
  return isUnclear ? ThicknessVerdict::NotJudged : ThicknessVerdict::Passed;
}

}  // namespace

std::vector<double> thicknessChange(const MeasuredVersion& now, std::span<const double> formerThickness) {
  std::vector<double> change(formerThickness.size());
  for (size_t face = 0; face < change.size(); ++face)
    change[face] = now.thickness.atBarycentre[face] - formerThickness[face];
  return thicknessOfInputFaces(now.computation.prepared.mesh, change);
}

ComparisonReport describeComparison(const MeasuredVersion& now, std::span<const double> formerThickness,
                                    std::span<const double> change, const ThicknessReport& described,
                                    const MeasuredVersion& before, const ThicknessReport& former) {
  ComparisonReport report;
  for (const ThinRegion& region : described.regions) {
    if (region.change == WallChange::New) ++report.newCount;
    if (region.change == WallChange::Thinner) ++report.thinnerCount;
    if (region.change == WallChange::Kept) ++report.keptCount;
  }
  for (const ThinRegion& region : former.regions)
    if (region.change == WallChange::Gone) report.gone.push_back(region);
  report.goneCount = report.gone.size();
  report.formerVerdict = former.verdict;
  const std::vector<double> values = thicknessOfInputFaces(now.computation.prepared.mesh, now.thickness.atBarycentre);
  for (size_t face = 0; face < values.size(); ++face)
    if (!std::isnan(values[face])) ++(std::isnan(change[face]) ? report.unmatchedFaceCount : report.matchedFaceCount);
  addThinnerRegions(now, formerThickness, report);
  if (described.verdict) report.verdict = verdictOf(before, report, described);
  return report;
}

}  // namespace asdfvk
