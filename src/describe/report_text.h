#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/report.h"
#include "describe/option.h"
#include "describe/thickness_text.h"

namespace asdfvk {

// Texts about a report. spelling: how the front end spells options in remedies.

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

/// Why BackendChoice::Automatic took a GPU or the CPU; for a CPU device of Vulkan, a remark; else empty.
[[nodiscard]] std::string backendReason(const Report& report, OptionSpelling spelling);

/// One line: "the check failed: " and the reason.
[[nodiscard]] std::string checkFailure(const CheckReport& check);

/// The message of the warning, with a remedy by options if there is one.
[[nodiscard]] std::string textWarning(const Warning& warning, OptionSpelling spelling);

}  // namespace asdfvk
