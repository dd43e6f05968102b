#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/report.h"
#include "describe/option.h"

namespace asdfvk {

/// Rows of title and text. A row without a title continues the previous row.
using ReportRows = std::vector<std::pair<std::string, std::string>>;

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

}  // namespace asdfvk
