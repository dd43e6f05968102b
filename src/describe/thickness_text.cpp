#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/text.h"
#include "describe/computation_options.h"
#include "describe/report_text.h"
#include "describe/unjudged_text.h"

namespace asdfvk {
namespace {

constexpr size_t kListedCount = 5;
/// Relative difference of thicknesses that are reported as different.
constexpr double kEqualThickness = 0.01;

/// The least thickness: "0.3 at (1, 2, 3), face 12", or "0.3". Precondition: there is one.
std::string leastText(const ThicknessReport& thickness, bool hasPlace) {
  const std::string value = lengthText(thickness.min, thickness.thinnerThan);
  return hasPlace ? fmt::format("{} {}", value, placeText(*thickness.minPlace, *thickness.minFace)) : value;
}

struct KindCount {
  ThinKind kind;
  uint64_t count = 0;
  double least = kNoValue;
};

std::array<KindCount, 3> countKinds(const ThicknessReport& thickness) {
  std::array<KindCount, 3> counts{{{ThinKind::Wall}, {ThinKind::Detail}, {ThinKind::Edge}}};
  for (const ThinRegion& region : thickness.regions) {
    KindCount& of = counts[static_cast<size_t>(region.kind)];
    if (of.count++ == 0) of.least = region.min;
  }
  return counts;
}

/// For example "6 details (least 0.32) and 14 edges". Only kinds that count, or only kinds that do not.
std::string kindsText(const ThicknessReport& thickness, bool areCounted) {
  std::vector<std::string> texts;
  for (const auto& [kind, count, least] : countKinds(thickness)) {
    if (count == 0 || thickness.counts(kind) != areCounted) continue;
    texts.push_back(counted(count, nameOf(kind)));
    if (!areCounted && kind == ThinKind::Detail)
      texts.back() += fmt::format(" (least {})", lengthText(least, thickness.thinnerThan));
  }
  return enumeration(texts);
}

std::string regionText(const ThinRegion& region, const ThicknessReport& thickness) {
  const auto lengthOf = [&](double value) { return lengthText(value, thickness.thinnerThan); };
  const std::string size = fmt::format("{}, area {} ({:.3g} %)", counted(region.faceCount, "face"),
                                       lengthText(region.area), 100 * region.areaShare);
  if (region.kind == ThinKind::Edge)
    return fmt::format("edge of {:.3g} degrees, thin over {}, {} {}; {}", region.angleDegrees, lengthText(region.width),
                       lengthOf(region.min), placeText(region.place, region.minFace), size);
  const std::string beside =
      region.least < region.min * (1 - kEqualThickness) ? fmt::format(", {} beside it", lengthOf(region.least)) : "";
  return fmt::format("{} {} from {} to {}, face {}{}; {}", nameOf(region.kind), lengthOf(region.min),
                     pointText(region.place), pointText(region.opposite), region.minFace, beside, size);
}

/// Adds a row with title and heading, then rows for at most kListedCount items.
template <typename Item>
void addList(const std::string& title, const std::string& heading, const std::vector<Item>& items,
             std::string (*textOf)(const Item&, const ThicknessReport&), const ThicknessReport& thickness,
             OptionSpelling spelling, ReportRows& rows) {
  rows.emplace_back(title, heading);
  for (size_t i = 0; i < std::min(items.size(), kListedCount); ++i) rows.emplace_back("", textOf(items[i], thickness));
  if (items.size() > kListedCount)
    rows.emplace_back("", fmt::format("and {} more{}", groupDigits(items.size() - kListedCount),
                                      spelling == OptionSpelling::Flag ? "; --json has all" : ""));
}

/// One list for each kind of thin regions.
void addRegions(const ThicknessReport& thickness, OptionSpelling spelling, ReportRows& rows) {
  if (thickness.regions.empty()) return;
  rows.emplace_back("thin", fmt::format("area {} ({:.3g} %) below {}", lengthText(thickness.thinArea),
                                        100 * thickness.thinAreaShare, limitText(*thickness.thinnerThan)));
  for (const KindCount& of : countKinds(thickness)) {
    if (of.count == 0) continue;
    std::vector<ThinRegion> regions;
    std::copy_if(thickness.regions.begin(), thickness.regions.end(), std::back_inserter(regions),
                 [&](const ThinRegion& region) { return region.kind == of.kind; });
    const std::string heading = counted(of.count, nameOf(of.kind)) + (thickness.counts(of.kind) ? "" : ", not counted");
    addList(fmt::format("{}s", nameOf(of.kind)), heading, regions, regionText, thickness, spelling, rows);
  }
}

}  // namespace

std::string pointText(const Vec3d& point) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", point.x, point.y, point.z); }

std::string placeText(const Vec3d& point, uint64_t face) {
  return fmt::format("at {}, face {}", pointText(point), face);
}

const char* verdictWord(ThicknessVerdict verdict) {
  constexpr std::array kWords{"PASS", "FAIL", "NOT JUDGED"};
  return kWords[static_cast<size_t>(verdict)];
}

std::string verdictSentence(const ThicknessReport& thickness, bool hasPlaces) {
  const std::string least = std::isnan(thickness.min) ? "" : leastText(thickness, hasPlaces);
  if (!thickness.verdict)
    return !least.empty()                 ? "least wall " + least
           : std::isnan(thickness.median) ? "no thickness"
                                          : "the least wall was not found";
  const std::string limit = limitText(*thickness.thinnerThan), others = kindsText(thickness, false);
  const std::string begin = std::string(verdictWord(*thickness.verdict)) + ": ";
  const std::string notCounted = others.empty() ? "" : fmt::format("; {} not counted", others);
  switch (*thickness.verdict) {
    case ThicknessVerdict::Failed:
      return begin + fmt::format("{} thinner than {}: {}", kindsText(thickness, true), limit, least);
    case ThicknessVerdict::Passed:
      return begin + fmt::format("{} thinner than {}{}{}", thickness.countsEdges ? "nowhere" : "no wall", limit,
                                 least.empty() ? "" : "; the next is " + least, notCounted);
    case ThicknessVerdict::NotJudged:
      break;
  }
  const bool isFound = std::any_of(thickness.regions.begin(), thickness.regions.end(),
                                   [&](const ThinRegion& region) { return thickness.counts(region.kind); });
  return begin + fmt::format("{} thinner than {} {} found{}", isFound ? "walls" : "no wall", limit,
                             isFound ? "were" : "was", notCounted);
}

ReportRows shortThicknessRows(const ThicknessReport& thickness, OptionSpelling spelling) {
  ReportRows rows{{"verdict", verdictSentence(thickness)}};
  const bool hasValues = !std::isnan(thickness.median);
  for (auto& row : shortUnjudgedRows(thickness.unjudged, spelling)) rows.push_back(std::move(row));
  if (!hasValues) return rows;
  std::string text = fmt::format("median {}, greatest {}", lengthText(thickness.median), lengthText(thickness.max));
  if (!thickness.regions.empty())
    text += fmt::format("; {:.3g} % of the area below {}{}", 100 * thickness.thinAreaShare,
                        limitText(*thickness.thinnerThan), spelling == OptionSpelling::Flag ? " (--verbose)" : "");
  rows.emplace_back("thickness", text);
  return rows;
}

std::string unitQuestion(const Report& report) {
  constexpr double kThinEverywhere = 0.9;
  const ThicknessReport& thickness = *report.thickness;
  const bool isSuspect = report.unit.empty() && thickness.verdict == ThicknessVerdict::Failed &&
                         thickness.thinAreaShare >= kThinEverywhere;
  return isSuspect ? fmt::format("the part is {:.6g} x {:.6g} x {:.6g}: inches or metres?", report.size.x,
                                 report.size.y, report.size.z)
                   : "";
}

ReportRows thicknessRows(const Report& report, OptionSpelling spelling) {
  const ThicknessReport& thickness = *report.thickness;
  ReportRows rows{{"verdict", verdictSentence(thickness)}};
  if (std::string question = unitQuestion(report); !question.empty()) rows.emplace_back("unit", std::move(question));
  for (auto& row : unjudgedRows(thickness.unjudged, spelling)) rows.push_back(std::move(row));
  rows.emplace_back("size", fmt::format("{:.6g} x {:.6g} x {:.6g}, bounding box in the unit of the mesh", report.size.x,
                                        report.size.y, report.size.z));
  addRegions(thickness, spelling, rows);
  if (const auto& ball = thickness.greatestSection)
    rows.emplace_back("section", fmt::format("{}, the diameter of the largest ball found inside, centre {}",
                                             lengthText(ball->diameter), pointText(ball->centre)));
  if (std::isnan(thickness.median)) return rows;
  std::string text = fmt::format("by area p1 {}, p5 {}, p50 {}, p95 {}, max {}", lengthText(thickness.percentile1),
                                 lengthText(thickness.percentile5), lengthText(thickness.median),
                                 lengthText(thickness.percentile95), lengthText(thickness.max));
  if (thickness.noValueCount > 0) text += fmt::format("; {} without a value", counted(thickness.noValueCount, "face"));
  rows.emplace_back("thickness", text);
  return rows;
}

}  // namespace asdfvk
