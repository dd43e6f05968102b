#include "describe/thickness_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/text.h"
#include "describe/comparison_text.h"
#include "describe/unjudged_text.h"

namespace asdfvk {
namespace {

constexpr size_t kListedCount = 5;
/// Relative difference of thicknesses that are reported as different.
constexpr double kEqualThickness = 0.01;

/// The least thickness: "0.3 at (1, 2, 3), face 12", or "0.3". Precondition: there is one.
std::string leastText(const ThicknessReport& thickness, bool hasPlace) {
  const std::string value = lengthText(thickness.min, thickness.thinnerThan);
  if (!hasPlace) return value;
  const std::string place = fmt::format("{} {}", value, placeText(*thickness.minPlace, *thickness.minFace));
  const auto least = std::find_if(thickness.regions.begin(), thickness.regions.end(), [&](const ThinRegion& region) {
    return region.minFace == *thickness.minFace && region.min == thickness.min;
  });
  return least == thickness.regions.end() ? place : place + bodiesText(least->bodies);
}

struct KindCount {
  ThinKind kind;
  uint64_t count = 0;
  double least = kNoValue;
};

std::array<KindCount, 4> countKinds(const ThicknessReport& thickness) {
  std::array<KindCount, 4> counts{{{ThinKind::Wall}, {ThinKind::Gap}, {ThinKind::Detail}, {ThinKind::Edge}}};
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
                       lengthOf(region.min), placeText(region.place, region.minFace) + bodiesText(region.bodies), size);
  const std::string beside =
      region.least < region.min * (1 - kEqualThickness) ? fmt::format(", {} beside it", lengthOf(region.least)) : "";
  const std::string change = region.change ? fmt::format("{} ", nameOf(*region.change)) : "";
  return fmt::format("{}{} {} from {} to {}, face {}{}; {}", change, nameOf(region.kind), lengthOf(region.min),
                     pointText(region.place), pointText(region.opposite), region.minFace,
                     bodiesText(region.bodies) + beside, size);
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
  rows.emplace_back(thickness.isOfGaps ? "narrow" : "thin",
                    fmt::format("area {} ({:.3g} %) below {}", lengthText(thickness.thinArea),
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

/// Lists of regions, the greatest section and percentiles.
void addValues(const ThicknessReport& thickness, OptionSpelling spelling, ReportRows& rows) {
  addRegions(thickness, spelling, rows);
  if (const auto& ball = thickness.greatestSection)
    rows.emplace_back(thickness.isOfGaps ? "void" : "section",
                      fmt::format("{}, the diameter of the largest ball found inside, centre {}",
                                  lengthText(ball->diameter), pointText(ball->centre)));
  if (std::isnan(thickness.median)) return;
  std::string text = fmt::format("by area p1 {}, p5 {}, p50 {}, p95 {}, max {}", lengthText(thickness.percentile1),
                                 lengthText(thickness.percentile5), lengthText(thickness.median),
                                 lengthText(thickness.percentile95), lengthText(thickness.max));
  if (thickness.noValueCount > 0) text += fmt::format("; {} without a value", counted(thickness.noValueCount, "face"));
  rows.emplace_back(thickness.isOfGaps ? "gap" : "thickness", text);
}

/// The first names, and the number of the others.
std::string listed(const std::vector<std::string>& names) {
  const size_t count = std::min(names.size(), kListedCount);
  const std::string first =
      joined(std::vector<std::string>(names.begin(), names.begin() + static_cast<ptrdiff_t>(count)), ", ");
  return names.size() == count ? first : fmt::format("{} and {} more", first, groupDigits(names.size() - count));
}

/// "2 sealed voids, greatest volume 3.2 at (1, 2, 3), face 12; loose inside: ball".
std::string voidsText(const std::vector<SealedVoid>& voids) {
  if (voids.empty()) return "no sealed void";
  const auto largest = std::max_element(voids.begin(), voids.end(), [](const SealedVoid& a, const SealedVoid& b) {
    return std::pair(a.isCertain, a.volume) < std::pair(b.isCertain, b.volume);
  });
  std::vector<std::string> loose;
  for (const SealedVoid& each : voids) loose.insert(loose.end(), each.looseBodies.begin(), each.looseBodies.end());
  const auto uncertainCount = static_cast<uint64_t>(
      std::count_if(voids.begin(), voids.end(), [](const SealedVoid& each) { return !each.isCertain; }));
  std::string text =
      fmt::format("{}, {}volume {} {}", counted(voids.size(), "sealed void"), voids.size() > 1 ? "greatest " : "",
                  lengthText(largest->volume), placeText(largest->place, largest->face));
  if (!loose.empty()) text += "; loose inside: " + listed(loose);
  if (uncertainCount > 0)
    text += fmt::format("; {} uncertain, because bodies overlap in a common plane there: unite the bodies",
                        groupDigits(uncertainCount));
  return text;
}

/// "1 pair of bodies in contact: lid and base".
std::string contactText(const std::vector<BodyContact>& contacts) {
  if (contacts.empty()) return "no bodies in contact";
  std::vector<std::string> pairs;
  for (const BodyContact& contact : contacts)
    pairs.push_back(fmt::format("{} and {}", contact.bodies[0], contact.bodies[1]));
  return fmt::format("{} of bodies in contact: {}", counted(pairs.size(), "pair"), listed(pairs));
}

/// isFound: something that fails the check was found, certain or not.
std::pair<ThicknessVerdict, std::string> withVerdict(const ThicknessReport& gap, bool isFailed, bool isFound,
                                                     const std::string& text) {
  const std::vector<UnjudgedReason>& reasons = gap.unjudged.reasons;
  const bool isUncertain = std::any_of(reasons.begin(), reasons.end(),
                                       [](const UnjudgedReason& reason) { return concernsWholeMesh(reason.cause); });
  const ThicknessVerdict verdict = isFailed && !isUncertain      ? ThicknessVerdict::Failed
                                   : isFound || !reasons.empty() ? ThicknessVerdict::NotJudged
                                                                 : ThicknessVerdict::Passed;
  return {verdict, fmt::format("{}: {}", verdictWord(verdict), text)};
}

}  // namespace

std::string pointText(const Vec3d& point) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", point.x, point.y, point.z); }

std::string placeText(const Vec3d& point, uint64_t face) {
  return fmt::format("at {}, face {}", pointText(point), face);
}

std::string bodiesText(const std::vector<std::string>& bodies) {
  if (bodies.empty()) return "";
  return bodies.size() == 1 ? fmt::format(", in {}", bodies[0])
                            : fmt::format(", between {} and {}", bodies[0], bodies[1]);
}

const char* verdictWord(ThicknessVerdict verdict) {
  constexpr std::array kWords{"PASS", "FAIL", "NOT JUDGED"};
  return kWords[static_cast<size_t>(verdict)];
}

std::string verdictSentence(const ThicknessReport& thickness, bool hasPlaces) {
  const std::string least = std::isnan(thickness.min) ? "" : leastText(thickness, hasPlaces);
  const char* const noun = thickness.isOfGaps ? "gap" : "wall";
  if (!thickness.verdict)
    return !least.empty()                  ? fmt::format("least {} {}", noun, least)
           : !std::isnan(thickness.median) ? fmt::format("the least {} was not found", noun)
                                           : fmt::format("no {}", thickness.isOfGaps ? noun : "thickness");
  const std::string limit =
      fmt::format("{} than {}", thickness.isOfGaps ? "closer" : "thinner", limitText(*thickness.thinnerThan));
  const std::string others = kindsText(thickness, false);
  const std::string begin = std::string(verdictWord(*thickness.verdict)) + ": ";
  const std::string notCounted = others.empty() ? "" : fmt::format("; {} not counted", others);
  switch (*thickness.verdict) {
    case ThicknessVerdict::Failed:
      return begin + fmt::format("{} {}: {}", kindsText(thickness, true), limit, least);
    case ThicknessVerdict::Passed:
      return begin + fmt::format("{} {}{}{}", thickness.countsEdges ? "nowhere" : fmt::format("no {}", noun), limit,
                                 least.empty() ? "" : "; the next is " + least, notCounted);
    case ThicknessVerdict::NotJudged:
      break;
  }
  const bool isFound = std::any_of(thickness.regions.begin(), thickness.regions.end(),
                                   [&](const ThinRegion& region) { return thickness.counts(region.kind); });
  return begin + fmt::format("{} {} {} found{}", isFound ? fmt::format("{}s", noun) : fmt::format("no {}", noun), limit,
                             isFound ? "were" : "was", notCounted);
}

std::string thickSentence(const ThicknessReport& thickness) {
  const ThickReport& thick = *thickness.thick;
  const std::string limit = limitText(thick.thickerThan);
  const std::string ratio = std::isnan(thick.ratio) ? "" : fmt::format("; {:.3g} times the least wall", thick.ratio);
  const auto ballText = [&](double diameter, const Vec3d& centre) {
    return fmt::format("{} around {}", lengthText(diameter, thick.thickerThan), pointText(centre));
  };
  const std::string begin = std::string(verdictWord(thick.verdict)) + ": ";
  if (!thick.bodies.empty()) {
    const ThickBody& first = thick.bodies.front();
    return begin + fmt::format("{} thicker than {}: {}{}{}", counted(thick.bodies.size(), "body", "bodies"), limit,
                               ballText(first.diameter, first.centre), bodiesText(first.bodies), ratio);
  }
  const std::optional<SectionBall>& greatest = thickness.greatestSection;
  return begin + fmt::format("no body thicker than {}{}{}", limit,
                             greatest ? "; the thickest has " + ballText(greatest->diameter, greatest->centre) : "",
                             ratio);
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
  rows.emplace_back(thickness.isOfGaps ? "gap" : "thickness", text);
  return rows;
}

std::string unitQuestion(const Report& report) {
  constexpr double kThinEverywhere = 0.9;
  const bool isSuspect = report.thickness && report.unit.empty() &&
                         report.thickness->verdict == ThicknessVerdict::Failed &&
                         report.thickness->thinAreaShare >= kThinEverywhere;
  return isSuspect ? fmt::format("the part is {:.6g} x {:.6g} x {:.6g}: inches or metres?", report.size.x,
                                 report.size.y, report.size.z)
                   : "";
}

std::pair<ThicknessVerdict, std::string> voidsVerdict(const Report& report) {
  const bool isFailed =
      std::any_of(report.voids.begin(), report.voids.end(), [](const SealedVoid& each) { return each.isCertain; });
  return withVerdict(*report.gap, isFailed, !report.voids.empty(), voidsText(report.voids));
}

std::pair<ThicknessVerdict, std::string> contactVerdict(const Report& report) {
  const bool isFailed = !report.contacts.empty();
  return withVerdict(*report.gap, isFailed, isFailed, contactText(report.contacts));
}

ReportRows spaceRows(const Report& report) {
  ReportRows rows;
  if (report.thickness && report.thickness->thick) rows.emplace_back("thick", report.thickness->thick->sentence);
  if (report.thickness && report.gap) rows.emplace_back("clearance", verdictSentence(*report.gap));
  if (report.gap) rows.emplace_back("voids", voidsText(report.voids));
  if (!report.contacts.empty()) rows.emplace_back("contact", contactText(report.contacts));
  return rows;
}

ReportRows thicknessRows(const Report& report, OptionSpelling spelling) {
  const ThicknessReport& first = report.thickness ? *report.thickness : *report.gap;
  ReportRows rows{{"verdict", verdictSentence(first)}};
  if (report.comparison) {
    rows.front().second = comparisonSentence(report);
    for (auto& row : comparisonRows(report)) rows.push_back(std::move(row));
    for (auto& row : comparedPlaceRows(*report.comparison)) rows.push_back(std::move(row));
  }
  if (std::string question = unitQuestion(report); !question.empty()) rows.emplace_back("unit", std::move(question));
  for (auto& row : unjudgedRows(first.unjudged, spelling)) rows.push_back(std::move(row));
  rows.emplace_back("size", fmt::format("{:.6g} x {:.6g} x {:.6g}, bounding box in the unit of the mesh", report.size.x,
                                        report.size.y, report.size.z));
  if (report.thickness) addValues(*report.thickness, spelling, rows);
  for (auto& row : spaceRows(report)) rows.push_back(std::move(row));
  if (report.gap) addValues(*report.gap, spelling, rows);
  return rows;
}

}  // namespace asdfvk
