#include "describe/comparison_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/text.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxListed = 5;

/// "0.9 instead of 1.6 at (1, 2, 3), face 12".
std::string thinnerText(const ThinnerRegion& region, bool hasPlace) {
  const std::string values =
      fmt::format("{} instead of {}", lengthText(region.thickness), lengthText(region.formerThickness));
  return hasPlace ? fmt::format("{} {}", values, placeText(region.place, region.face)) : values;
}

/// The part of the surface that became thinner, with the greatest region.
std::string thinnerAreaText(const ComparisonReport& comparison, bool hasPlace) {
  if (comparison.matchedFaceCount == 0)
    return "no face is at a place of the former version; give meshes in the same coordinates and unit";
  const std::string unmatched =
      comparison.unmatchedFaceCount == 0
          ? ""
          : fmt::format("; {} at no place of the former version", counted(comparison.unmatchedFaceCount, "face"));
  if (comparison.thinner.empty()) return "nowhere thinner than before" + unmatched;
  return fmt::format("thinner than before at {:.3g} % of the area: {}{}", 100 * comparison.thinnerAreaShare,
                     thinnerText(comparison.thinner.front(), hasPlace), unmatched);
}

/// The thinnest place that is new or thinner, with the names of the bodies there.
std::pair<ChangedPlace, std::string> worstOf(const ThicknessReport& thickness) {
  std::optional<ChangedPlace> worst;
  std::string bodies;
  for (const ThinRegion& region : thickness.regions) {
    if (!region.change || *region.change == WallChange::Kept) continue;
    const ChangedPlace place =
        region.changedPlace.value_or(ChangedPlace{region.min, std::nullopt, region.minFace, region.place});
    if (worst && worst->thickness <= place.thickness) continue;
    worst = place;
    bodies = bodiesText(region.bodies);
  }
  return {worst.value(), bodies};
}

/// What counts.
std::string nounOf(const ThicknessReport& thickness) {
  return thickness.countsDetails || thickness.countsEdges ? "thin place" : "wall";
}

/// "; 3 walls kept and 1 wall gone", or nothing.
std::string othersText(const ComparisonReport& comparison, const std::string& noun) {
  std::vector<std::string> texts;
  if (comparison.keptCount > 0) texts.push_back(counted(comparison.keptCount, noun) + " kept");
  if (comparison.goneCount > 0) texts.push_back(counted(comparison.goneCount, noun) + " gone");
  return texts.empty() ? "" : "; " + enumeration(texts);
}

}  // namespace

std::string comparisonSentence(const Report& report, bool hasPlaces) {
  const ComparisonReport& comparison = *report.comparison;
  if (!comparison.verdict) return thinnerAreaText(comparison, hasPlaces);
  const ThicknessReport& thickness = *report.thickness;
  const std::string begin = std::string(verdictWord(*comparison.verdict)) + ": ";
  const std::string noun = nounOf(thickness);
  std::vector<std::string> worse;
  if (comparison.newCount > 0) worse.push_back(counted(comparison.newCount, "new " + noun));
  if (comparison.thinnerCount > 0) worse.push_back(counted(comparison.thinnerCount, noun) + " that became thinner");
  if (worse.empty())
    return begin + fmt::format("no new {} thinner than {}{}{}", noun, limitText(*thickness.thinnerThan),
                               *comparison.verdict == ThicknessVerdict::NotJudged ? " was found" : "",
                               othersText(comparison, noun));
  const auto [worst, bodies] = worstOf(thickness);
  const std::string least = lengthText(worst.thickness, thickness.thinnerThan),
                    before = worst.formerThickness ? " instead of " + lengthText(*worst.formerThickness) : "";
  const bool isFormerUnclear = *comparison.verdict == ThicknessVerdict::NotJudged;
  return begin + fmt::format("{} (limit {}): {}{}{}{}{}", enumeration(worse), limitText(*thickness.thinnerThan), least,
                             before, hasPlaces ? " " + placeText(worst.place, worst.face) + bodies : "",
                             othersText(comparison, noun),
                             isFormerUnclear ? "; the former version cannot be judged" : "");
}

ReportRows comparisonRows(const Report& report) {
  const ComparisonReport& comparison = *report.comparison;
  if (!comparison.verdict) return {};
  const std::string all = verdictSentence(*report.thickness);
  return {{"in all", all.substr(std::string(verdictWord(*report.thickness->verdict)).size() + 2)},
          {"change", thinnerAreaText(comparison, true)}};
}

ReportRows comparedPlaceRows(const ComparisonReport& comparison) {
  ReportRows rows;
  const auto addList = [&rows](const char* title, const auto& items, const auto& textOf) {
    for (size_t i = 0; i < std::min(items.size(), kMaxListed); ++i)
      rows.emplace_back(i == 0 ? title : "", textOf(items[i]));
    if (items.size() > kMaxListed)
      rows.emplace_back("", fmt::format("and {} more", groupDigits(items.size() - kMaxListed)));
  };
  addList("gone", comparison.gone, [](const ThinRegion& region) {
    return fmt::format("{} {} {} of the former version", nameOf(region.kind), lengthText(region.min),
                       placeText(region.place, region.minFace) + bodiesText(region.bodies));
  });
  addList("thinner", comparison.thinner, [](const ThinnerRegion& region) {
    return fmt::format("{}; {}, area {} ({:.3g} %)", thinnerText(region, true), counted(region.faceCount, "face"),
                       lengthText(region.area), 100 * region.areaShare);
  });
  return rows;
}

}  // namespace asdfvk
