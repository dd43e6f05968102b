#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "describe/computation_options.h"
#include "describe/report_text.h"
#include "describe/unjudged_text.h"

namespace asdfvk {
namespace {

constexpr size_t kListedCount = 5;

std::string pointText(const Vec3d& point) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", point.x, point.y, point.z); }

/// The least thickness: "0.3 at (1, 2, 3), face 12". Precondition: a face has a thickness.
std::string leastText(const ThicknessReport& thickness) {
  return fmt::format("{} at {}, face {}{}", lengthText(thickness.min, thickness.thinnerThan),
                     pointText(*thickness.minPlace), *thickness.minFace, thickness.min == 0 ? ", a sharp edge" : "");
}

const char* sharpException(const ThicknessReport& thickness) {
  return thickness.allowsSharpEdges && !thickness.sharpEdges.empty() ? " except at sharp edges" : "";
}

std::string regionText(const ThinRegion& region, const ThicknessReport& thickness) {
  const std::string size =
      fmt::format("face {}; {}, area {} ({:.3g} %)", region.minFace, counted(region.faceCount, "face"),
                  lengthText(region.area), 100 * region.areaShare);
  if (region.isSharp) return fmt::format("sharp edge at {}, {}", pointText(region.place), size);
  return fmt::format("wall {} from {} to {}, {}", lengthText(region.min, thickness.thinnerThan),
                     pointText(region.place), pointText(region.opposite), size);
}

std::string edgeText(const SharpEdge& edge, const ThicknessReport&) {
  const std::string place = fmt::format("at {}, face {}", pointText(edge.place), edge.face);
  if (edge.edgeCount == 0) return fmt::format("tip of {:.3g} degrees {}", edge.angleDegrees, place);
  return fmt::format("edge of {:.3g} degrees, length {}, {}", edge.angleDegrees, lengthText(edge.length), place);
}

std::string verdictOf(const ThicknessReport& thickness) {
  if (!thickness.verdict) return std::isnan(thickness.min) ? "no thickness" : "least thickness " + leastText(thickness);
  switch (*thickness.verdict) {
    case ThicknessVerdict::Failed:
      return fmt::format("FAIL: thinner than {}: {}", limitText(*thickness.thinnerThan), leastText(thickness));
    case ThicknessVerdict::Passed:
      return fmt::format("PASS: nowhere thinner than {}{}", limitText(*thickness.thinnerThan),
                         sharpException(thickness));
    case ThicknessVerdict::NotJudged:
      break;
  }
  return "NOT JUDGED: none of the judged faces is thinner than " + limitText(*thickness.thinnerThan);
}

/// Adds a row with title and heading, then rows for at most kListedCount items.
template <typename Item>
void addList(const char* title, const std::string& heading, const std::vector<Item>& items,
             std::string (*textOf)(const Item&, const ThicknessReport&), const ThicknessReport& thickness,
             OptionSpelling spelling, ReportRows& rows) {
  rows.emplace_back(title, heading);
  for (size_t i = 0; i < std::min(items.size(), kListedCount); ++i) rows.emplace_back("", textOf(items[i], thickness));
  if (items.size() > kListedCount)
    rows.emplace_back("", fmt::format("and {} more{}", groupDigits(items.size() - kListedCount),
                                      spelling == OptionSpelling::Flag ? "; --json has all" : ""));
}

std::string sharpHeading(const ThicknessReport& thickness, OptionSpelling spelling) {
  const std::string count = counted(thickness.sharpEdges.size(), "sharp edge or tip", "sharp edges or tips");
  if (!thickness.thinnerThan) return count;
  if (thickness.allowsSharpEdges) return count + ": allowed, together with the thin surface around them";
  return count + withSpelledOptions(computationRows(), ": thinner than any limit; {allow-sharp-edges} leaves them out",
                                    spelling);
}

}  // namespace

ReportRows shortThicknessRows(const ThicknessReport& thickness, OptionSpelling spelling) {
  ReportRows rows{{"verdict", verdictOf(thickness)}};
  const bool hasValues = !std::isnan(thickness.median);
  for (auto& row : shortUnjudgedRows(thickness.unjudged, spelling)) rows.push_back(std::move(row));
  if (!hasValues) return rows;
  std::string text = fmt::format("median {}, greatest {}", lengthText(thickness.median), lengthText(thickness.max));
  if (!thickness.regions.empty()) {
    text += fmt::format("; {}, {:.3g} % of the area{}", counted(thickness.regions.size(), "thin region"),
                        100 * thickness.thinAreaShare, spelling == OptionSpelling::Flag ? " (--verbose)" : "");
  } else if (thickness.verdict) {
    text = fmt::format("least {}, ", lengthText(thickness.min, thickness.thinnerThan)) + text;
  }
  rows.emplace_back("thickness", text);
  return rows;
}

ReportRows thicknessRows(const Report& report, OptionSpelling spelling) {
  const ThicknessReport& thickness = *report.thickness;
  ReportRows rows{{"verdict", verdictOf(thickness)}};
  for (auto& row : unjudgedRows(thickness.unjudged, spelling)) rows.push_back(std::move(row));
  rows.emplace_back("size", fmt::format("{:.6g} x {:.6g} x {:.6g}, bounding box in the unit of the mesh", report.size.x,
                                        report.size.y, report.size.z));
  if (!thickness.regions.empty())
    addList(
        "thin",
        fmt::format("{} below {}: area {} ({:.3g} %)", counted(thickness.regions.size(), "region"),
                    limitText(*thickness.thinnerThan), lengthText(thickness.thinArea), 100 * thickness.thinAreaShare),
        thickness.regions, regionText, thickness, spelling, rows);
  if (!thickness.sharpEdges.empty())
    addList("sharp", sharpHeading(thickness, spelling), thickness.sharpEdges, edgeText, thickness, spelling, rows);
  if (const auto& ball = thickness.greatestSection)
    rows.emplace_back("section", fmt::format("{}, the diameter (to 0.1 %) of the largest ball inside, centre {}",
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
