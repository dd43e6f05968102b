#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/report.h"
#include "describe/option.h"

namespace asdfvk {

// Texts about a report. spelling: how the front end spells options in remedies.

/// Rows of title and text. A row without a title continues the previous row.
using ReportRows = std::vector<std::pair<std::string, std::string>>;

/// The rows of the full report. The report begins with thicknessRows(), or with the short report if the thickness was
/// not measured. Details of values, parts, seeds, device, solver and times follow. Titles have at most nine characters.
[[nodiscard]] ReportRows reportRows(const Report& report, OptionSpelling spelling);

/// The rows of the short report: at most five, so that a report has at most six lines.
[[nodiscard]] ReportRows shortReportRows(const Report& report, OptionSpelling spelling);

/// Texts about a result, for pages and notebooks.
struct ReportTexts {
  ReportRows summary;         ///< Rows of a table: title and value.
  std::string errorSentence;  ///< The origin of the values and their expected errors.
  std::vector<std::string> warnings, defects;
};
/// The summary has the rows of the full report without the lists of thin regions, which a page has elsewhere.
/// showsTimes: if false, the texts depend on mesh and options only.
[[nodiscard]] ReportTexts reportTexts(const Report& report, bool showsTimes, OptionSpelling spelling);

/// A point: "(1, 2, 3)".
[[nodiscard]] std::string pointText(const Vec3d& point);
/// A point of an input face: "at (1, 2, 3), face 4".
[[nodiscard]] std::string placeText(const Vec3d& point, uint64_t face);

/// ", between lid and base", ", in lid", or nothing. bodies: ThinRegion::bodies.
[[nodiscard]] std::string bodiesText(const std::vector<std::string>& bodies);

/// Verdict, unjudged faces, size, thin regions and more. Precondition: report.thickness or report.gap is set.
[[nodiscard]] ReportRows thicknessRows(const Report& report, OptionSpelling spelling);

/// The verdict, such as "FAIL: 2 walls thinner than 0.8: 0.3 at (0, 1, 2), face 12"; without a limit, the least wall.
/// hasPlaces: if false, the sentence has no coordinates, for pictures.
[[nodiscard]] std::string verdictSentence(const ThicknessReport& thickness, bool hasPlaces = true);

/// The verdict on thick bodies. Precondition: thickness.thick is set.
[[nodiscard]] std::string thickSentence(const ThicknessReport& thickness);

/// The word "PASS", "FAIL" or "NOT JUDGED", with which verdictSentence() begins.
[[nodiscard]] const char* verdictWord(ThicknessVerdict verdict);

/// At most three rows. The first is the verdictSentence(). The second has the numbers of unjudged faces, if there are
/// any. The last has the thickness and the share of the thin area.
[[nodiscard]] ReportRows shortThicknessRows(const ThicknessReport& thickness, OptionSpelling spelling);

/// The verdict on sealed voids, and its sentence. Precondition: report.gap is set.
[[nodiscard]] std::pair<ThicknessVerdict, std::string> voidsVerdict(const Report& report);

/// The same for bodies in contact: "FAIL: 1 pair of bodies in contact: lid and base". Precondition: as above.
[[nodiscard]] std::pair<ThicknessVerdict, std::string> contactVerdict(const Report& report);

/// Verdicts on thick bodies and, beside a thickness, on gaps; sealed voids, and bodies in contact.
[[nodiscard]] ReportRows spaceRows(const Report& report);

/// The question for the unit if the check fails at nearly the whole surface and the file states no unit: "the part is 2
/// x 1 x 0.05: inches or metres?". Empty otherwise.
[[nodiscard]] std::string unitQuestion(const Report& report);

/// One line: "the check failed: " and the reason.
[[nodiscard]] std::string checkFailure(const CheckReport& check);

/// The message of the warning, with a remedy by options if there is one.
[[nodiscard]] std::string textWarning(const Warning& warning, OptionSpelling spelling);

}  // namespace asdfvk
