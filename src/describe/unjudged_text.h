#pragma once

#include <string>
#include <utility>

#include "asdf_vk/report.h"
#include "describe/option.h"
#include "describe/thickness_text.h"

namespace asdfvk {

/// What cannot be judged, "24 faces of open components: 8 edges have one face, the first at (1, 2, 3), face 4", and
/// what to change.
[[nodiscard]] std::pair<std::string, std::string> unjudgedTexts(const UnjudgedReason& reason, OptionSpelling spelling);

/// A row per cause for which faces cannot be judged, with number, place and remedy, and a row per kind of faces that
/// are left out or judged differently.
[[nodiscard]] ReportRows unjudgedRows(const UnjudgedFaces& unjudged, OptionSpelling spelling);

/// One row for the short report: the first cause with its place, and the remedy and the number of further causes if
/// there is room. Empty without a cause.
[[nodiscard]] ReportRows shortUnjudgedRows(const UnjudgedFaces& unjudged, OptionSpelling spelling);

}  // namespace asdfvk
