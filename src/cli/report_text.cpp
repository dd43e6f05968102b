#include "cli/report_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "core/text.h"
#include "describe/report_text.h"

namespace asdfvk {
namespace {

/// Replaces the rows of the checks of the space that were requested by their verdicts.
void addSpaceVerdicts(const ComputationSettings& computation, const Report& report, ReportRows& rows) {
  const auto voids = std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row.first == "voids"; });
  if (voids == rows.end()) return;
  if (computation.failsIfVoids) voids->second = voidsVerdict(report).second;
  if (!computation.failsIfContact) return;
  const auto contact = std::next(voids);
  const std::string sentence = contactVerdict(report).second;
  if (contact != rows.end() && contact->first == "contact")
    contact->second = sentence;
  else
    rows.insert(contact, {"contact", sentence});
}

}  // namespace

std::string textReport(const MeshOutcome& outcome) {
  const Report& report = outcome.result.report;
  ReportRows rows = outcome.outputs.verbose ? reportRows(report, OptionSpelling::Flag)
                                            : shortReportRows(report, OptionSpelling::Flag);
  addSpaceVerdicts(outcome.computation, report, rows);
  const auto placeText = [](const std::string& place) { return place == "-" ? "standard output" : place; };
  std::vector<std::string> files;
  if (!outcome.output.empty()) files.push_back(placeText(outcome.output));
  if (!outcome.outputs.points.empty()) files.push_back("points " + placeText(outcome.outputs.points));
  if (!outcome.outputs.picture.empty()) files.push_back("picture " + placeText(outcome.outputs.picture));
  if (!files.empty()) rows.emplace_back("output", joined(files, ", "));
  std::string text = fmt::format("{}: {}\n", outcome.mesh, rows.front().second);
  for (size_t i = 1; i < rows.size(); ++i) text += fmt::format("  {:<9} {}\n", rows[i].first, rows[i].second);
  return text;
}

}  // namespace asdfvk
