#include "describe/shown_places.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/text.h"
#include "describe/comparison_text.h"
#include "describe/thickness_text.h"

namespace asdfvk {
namespace {

/// The sentence for a picture, without the verdict: "2 walls thinner than 0.8: 0.3".
std::string legendOf(const std::string& sentence, ThicknessVerdict verdict) {
  return sentence.substr(std::string(verdictWord(verdict)).size() + 2);
}

/// Failed precedes NotJudged, which precedes Passed.
int severityOf(ThicknessVerdict verdict) {
  return verdict == ThicknessVerdict::Failed ? 2 : verdict == ThicknessVerdict::NotJudged ? 1 : 0;
}

}  // namespace

std::optional<ShownPlaces> shownPlaces(const Report& report) {
  std::optional<ShownPlaces> shown;
  for (const std::optional<ThicknessReport>* const measured : {&report.thickness, &report.gap}) {
    if (!*measured || !(*measured)->thinnerThan) continue;
    const ThicknessReport& thickness = **measured;
    const bool isFirst = !shown;
    if (isFirst) shown.emplace().limit = *thickness.thinnerThan;
    const bool isCompared = report.comparison && !thickness.isOfGaps;
    const auto sentence = [&](bool hasPlaces) {
      return isCompared ? comparisonSentence(report, hasPlaces) : verdictSentence(thickness, hasPlaces);
    };
    const ThicknessVerdict verdict = isCompared ? *report.comparison->verdict : *thickness.verdict;
    if (severityOf(verdict) > severityOf(shown->verdict)) shown->verdict = verdict;
    shown->sentence += (isFirst ? "" : "; gaps: ") + sentence(true);
    shown->legend += (isFirst ? "" : "; ") + legendOf(sentence(false), verdict);
    shown->title += fmt::format("{}{} than {}", isFirst ? "" : " or ", thickness.isOfGaps ? "closer" : "thinner",
                                limitText(*thickness.thinnerThan));
    shown->countsDetails = thickness.counts(ThinKind::Detail);
    shown->countsEdges = thickness.countsEdges;
    shown->regions.insert(shown->regions.end(), thickness.regions.begin(), thickness.regions.end());
  }
  if (shown) shown->voids = report.voids;
  return shown;
}

std::optional<LeastPlace> leastPlace(const Report& report) {
  std::optional<LeastPlace> least;
  bool hasFailed = false;
  for (const std::optional<ThicknessReport>* const measured : {&report.thickness, &report.gap}) {
    if (!*measured || !(*measured)->minFace || !(*measured)->minPlace || !(*measured)->minOpposite) continue;
    const ThicknessReport& thickness = **measured;
    const bool fails = thickness.verdict == ThicknessVerdict::Failed;
    if (least && (hasFailed || !fails)) continue;
    hasFailed = fails;
    const auto region = std::find_if(thickness.regions.begin(), thickness.regions.end(), [&](const ThinRegion& each) {
      return each.minFace == *thickness.minFace && each.min == thickness.min;
    });
    least = {.kind = region != thickness.regions.end() ? nameOf(region->kind)
                     : thickness.isOfGaps              ? "gap"
                                                       : "wall",
             .value = thickness.min,
             .face = *thickness.minFace,
             .place = *thickness.minPlace,
             .opposite = *thickness.minOpposite};
  }
  return least;
}

}  // namespace asdfvk
