#include "describe/unjudged_text.h"

#include <fmt/core.h>

#include <string>
#include <utility>

#include "core/text.h"
#include "describe/computation_options.h"

namespace asdfvk {
namespace {

constexpr size_t kShortTextSize = 88;  // A line of the short report has at most 100 columns.

uint64_t negativeCountOf(const UnjudgedReason& reason) { return static_cast<uint64_t>(reason.amount); }

}  // namespace

std::pair<std::string, std::string> unjudgedTexts(const UnjudgedReason& reason, OptionSpelling spelling) {
  const std::string faces = counted(reason.faceCount, "face"), edges = counted(reason.edgeCount, "edge");
  const std::string place = placeText(reason.place, reason.face) + bodiesText(reason.bodies);
  const char* const have = reason.edgeCount == 1 ? "has" : "have";
  const std::string orient = withSpelledOptions("{orient=auto}", spelling);  // Names of bodies may have braces.
  switch (reason.cause) {
    case UnjudgedCause::Border:
      return {fmt::format("{} of open components: {} {} one face, the first {}", faces, edges, have, place),
              "close the mesh, a wall may be missing"};
    case UnjudgedCause::Branching:
      return {fmt::format("{} of ambiguous components: {} {} three faces or more, an odd number, the first {}", faces,
                          edges, have, place),
              "give each body its own faces, or remove the faces inside"};
    case UnjudgedCause::WoundAgainst:
      return {
          fmt::format("{} of components with faces wound against each other: {}, the first {}", faces, edges, place),
          reason.isRepairable ? orient + " reverses them" : "the surface has no consistent orientation, repair it"};
    case UnjudgedCause::Inverted:
      return {fmt::format("{} of components oriented inwards, the first {}", faces, place), orient + " reverses them"};
    case UnjudgedCause::DoubleSided:
      return {fmt::format("{} have a copy that is wound the other way, the first {}: a double-sided surface bounds no "
                          "material",
                          faces, place),
              "remove the copies"};
    case UnjudgedCause::NegativeVolumes:
      return {fmt::format("{}: {} of the file {} not subtracted", faces,
                          counted(negativeCountOf(reason), "negative volume"),
                          negativeCountOf(reason) == 1 ? "was" : "were"),
              fmt::format("subtract {} in the program that wrote the file, and export the result",
                          negativeCountOf(reason) == 1 ? "it" : "them")};
    case UnjudgedCause::CoarseCoordinates:
      break;
  }
  return {fmt::format("{}: the coordinates have steps of {:.3g}, more than a quarter of the limit, because they are "
                      "float32 values far from the origin",
                      faces, reason.amount),
          "move the mesh to the origin before it is written"};
}

ReportRows unjudgedRows(const UnjudgedFaces& unjudged, OptionSpelling spelling) {
  ReportRows rows;
  const auto add = [&rows](const std::string& text) { rows.emplace_back(rows.empty() ? "unjudged" : "", text); };
  for (const UnjudgedReason& reason : unjudged.reasons) {
    const auto [text, remedy] = unjudgedTexts(reason, spelling);
    add(fmt::format("{}; {}", text, remedy));
  }
  const auto addCount = [&](uint64_t count, const char* noun, const char* rest) {
    if (count > 0) add(fmt::format("{} {}", counted(count, noun), rest));
  };
  addCount(unjudged.degenerateCount, "degenerate face",
           "left out: without a normal, or with a corner that is not finite");
  addCount(unjudged.crossedCount, "face", "crossed by other faces: judged in pieces, as the union of the bodies");
  addCount(unjudged.insideCount, "face", "inside of the material, wholly or partly: no wall there");
  return rows;
}

ReportRows shortUnjudgedRows(const UnjudgedFaces& unjudged, OptionSpelling spelling) {
  if (unjudged.reasons.empty()) return {};
  const UnjudgedReason& reason = unjudged.reasons[0];
  std::string text, remedy = reason.isRepairable ? "; {orient=auto}" : "";
  switch (reason.cause) {
    case UnjudgedCause::Border:
      text = counted(reason.edgeCount, "open edge");
      remedy = "; close the mesh";
      break;
    case UnjudgedCause::Branching:
      text = counted(reason.edgeCount, "edge") + " of three faces or more";
      break;
    case UnjudgedCause::WoundAgainst:
      text = counted(reason.edgeCount, "inconsistent edge");
      break;
    case UnjudgedCause::Inverted:
      text = counted(reason.faceCount, "face") + " oriented inwards";
      break;
    case UnjudgedCause::DoubleSided:
      text = counted(reason.faceCount, "double-sided face");
      break;
    case UnjudgedCause::NegativeVolumes:
      text = counted(negativeCountOf(reason), "negative volume") + " not subtracted";
      remedy = "; subtract before the export";
      break;
    case UnjudgedCause::CoarseCoordinates:
      text = fmt::format("coordinates have steps of {:.3g}", reason.amount);
      remedy = "; move the mesh to the origin";
      break;
  }
  if (!concernsWholeMesh(reason.cause))
    text += ", first " + placeText(reason.place, reason.face) + bodiesText(reason.bodies);
  remedy = withSpelledOptions(remedy, spelling);
  if (text.size() + remedy.size() <= kShortTextSize) text += remedy;
  if (const std::string more = fmt::format("; {} more", unjudged.reasons.size() - 1);
      unjudged.reasons.size() > 1 && text.size() + more.size() <= kShortTextSize)
    text += more;
  return {{"unjudged", text}};
}

}  // namespace asdfvk
