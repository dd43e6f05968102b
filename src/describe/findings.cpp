#include "describe/findings.h"

#include <fmt/core.h>

#include <utility>

#include "core/text.h"
#include "describe/thickness_text.h"
#include "describe/unjudged_text.h"

namespace asdfvk {
namespace {

FindingKind kindOf(ThinKind kind) {
  switch (kind) {
    case ThinKind::Wall:
      return FindingKind::ThinWall;
    case ThinKind::Gap:
      return FindingKind::NarrowGap;
    case ThinKind::Detail:
      return FindingKind::ThinDetail;
    case ThinKind::Edge:
      break;
  }
  return FindingKind::ThinEdge;
}

std::string remedyOf(const ThinRegion& region, const ThicknessReport& of) {
  const double limit = *of.thinnerThan;
  const std::string needed = limitText(limit), missing = lengthText(limit - region.min);
  switch (region.kind) {
    case ThinKind::Wall:
      return fmt::format("make the wall at least {} thick: move one of its surfaces outwards by {}", needed, missing);
    case ThinKind::Gap:
      return fmt::format("make the gap at least {} wide: move one of its surfaces away by {}", needed, missing);
    case ThinKind::Detail:
      return fmt::format("make the detail at least {} wide, or leave it out", needed);
    case ThinKind::Edge:
      break;
  }
  return fmt::format("round or blunt the edge to at least {}", needed);
}

/// What a thin place does: with a former version, only a new or thinner one fails.
FindingLevel levelOf(const ThinRegion& region, const Report& report, const ThicknessReport& of) {
  const bool isCompared = report.comparison && !of.isOfGaps;
  if (isCompared && region.change == WallChange::Kept) return FindingLevel::Note;
  const std::optional<ThicknessVerdict> verdict = isCompared ? report.comparison->verdict : of.verdict;
  return verdict == ThicknessVerdict::Failed ? FindingLevel::Failure : FindingLevel::NotJudged;
}

void addThinPlaces(const Report& report, const ThicknessReport& of, std::vector<Finding>& findings) {
  if (!of.thinnerThan) return;
  for (const ThinRegion& region : of.regions) {
    if (!of.counts(region.kind)) continue;
    std::string message =
        fmt::format("{} of {}, below the limit {}, {}{}", nameOf(region.kind), lengthText(region.min, of.thinnerThan),
                    limitText(*of.thinnerThan), placeText(region.place, region.minFace), bodiesText(region.bodies));
    if (region.change) message = fmt::format("{} {}", nameOf(*region.change), message);
    findings.push_back({.kind = kindOf(region.kind),
                        .level = levelOf(region, report, of),
                        .value = region.min,
                        .limit = of.thinnerThan,
                        .place = region.place,
                        .opposite = region.opposite,
                        .face = region.minFace,
                        .oppositeFace = region.oppositeFace,
                        .faceCount = region.faceCount,
                        .bodies = region.bodies,
                        .message = std::move(message),
                        .remedy = remedyOf(region, of)});
  }
}

void addUnjudged(const ThicknessReport& of, std::vector<Finding>& findings) {
  const bool hasVerdict = of.verdict || of.thick;
  for (const UnjudgedReason& reason : of.unjudged.reasons) {
    const bool hasPlace = !concernsWholeMesh(reason.cause);
    auto [message, remedy] = unjudgedTexts(reason, OptionSpelling::CamelCase);
    findings.push_back({.kind = FindingKind::Unjudged,
                        .level = hasVerdict ? FindingLevel::NotJudged : FindingLevel::Note,
                        .place = hasPlace ? std::optional(reason.place) : std::nullopt,
                        .face = hasPlace ? std::optional(reason.face) : std::nullopt,
                        .faceCount = reason.faceCount,
                        .bodies = reason.bodies,
                        .message = std::move(message),
                        .remedy = std::move(remedy)});
  }
}

void addThickBodies(const ThickReport& thick, std::vector<Finding>& findings) {
  for (const ThickBody& body : thick.bodies)
    findings.push_back(
        {.kind = FindingKind::ThickBody,
         .level = FindingLevel::Failure,
         .value = body.diameter,
         .limit = thick.thickerThan,
         .place = body.centre,
         .bodies = body.bodies,
         .message = fmt::format("body with a ball of diameter {} inside, above the limit {}, around {}{}",
                                lengthText(body.diameter, thick.thickerThan), limitText(thick.thickerThan),
                                pointText(body.centre), bodiesText(body.bodies)),
         .remedy =
             fmt::format("hollow the body there, so that no ball above {} fits in", limitText(thick.thickerThan))});
}

FindingLevel levelOf(bool isChecked, ThicknessVerdict verdict, bool isCertain) {
  if (!isChecked) return FindingLevel::Note;
  return verdict == ThicknessVerdict::Failed && isCertain ? FindingLevel::Failure : FindingLevel::NotJudged;
}

void addSpaces(const Report& report, const CheckedSpaces& checked, std::vector<Finding>& findings) {
  const ThicknessVerdict onVoids = voidsVerdict(report).first, onContacts = contactVerdict(report).first;
  for (const SealedVoid& each : report.voids)
    findings.push_back({.kind = FindingKind::SealedVoid,
                        .level = levelOf(checked.voids, onVoids, each.isCertain),
                        .value = each.volume,
                        .place = each.place,
                        .face = each.face,
                        .bodies = each.looseBodies,
                        .message = fmt::format("sealed void of volume {} {}", lengthText(each.volume),
                                               placeText(each.place, each.face)),
                        .remedy = each.isCertain ? "open a way out of the void, or fill it"
                                                 : "unite the bodies that overlap in a common plane there"});
  for (const BodyContact& contact : report.contacts)
    findings.push_back({.kind = FindingKind::BodiesInContact,
                        .level = levelOf(checked.contacts, onContacts, true),
                        .bodies = contact.bodies,
                        .message = fmt::format("bodies in contact: {} and {}", contact.bodies[0], contact.bodies[1]),
                        .remedy = "move the bodies apart, or unite them to one body"});
}

}  // namespace

std::vector<Finding> findingsOf(const Report& report, CheckedSpaces checked) {
  std::vector<Finding> findings;
  for (const auto* const of : {&report.thickness, &report.gap})
    if (*of) addThinPlaces(report, **of, findings);
  if (report.thickness && report.thickness->thick) addThickBodies(*report.thickness->thick, findings);
  if (report.gap) addSpaces(report, checked, findings);
  if (report.thickness || report.gap) addUnjudged(report.thickness ? *report.thickness : *report.gap, findings);
  return findings;
}

}  // namespace asdfvk
