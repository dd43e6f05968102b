#include "describe/shown_places.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/text.h"
#include "describe/report_text.h"

namespace asdfvk {
namespace {

/// The sentence for a picture, without the verdict: "2 walls thinner than 0.8: 0.3".
std::string legendOf(const ThicknessReport& thickness) {
  return verdictSentence(thickness, false).substr(std::string(verdictWord(*thickness.verdict)).size() + 2);
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
    if (severityOf(*thickness.verdict) > severityOf(shown->verdict)) shown->verdict = *thickness.verdict;
    shown->sentence += (isFirst ? "" : "; gaps: ") + verdictSentence(thickness);
    shown->legend += (isFirst ? "" : "; ") + legendOf(thickness);
    shown->title += fmt::format("{}{} than {}", isFirst ? "" : " or ", thickness.isOfGaps ? "closer" : "thinner",
                                limitText(*thickness.thinnerThan));
    shown->countsDetails = thickness.counts(ThinKind::Detail);
    shown->countsEdges = thickness.countsEdges;
    shown->regions.insert(shown->regions.end(), thickness.regions.begin(), thickness.regions.end());
  }
  return shown;
}

}  // namespace asdfvk
