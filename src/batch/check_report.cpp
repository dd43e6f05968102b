#include "batch/check_report.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/check.h"

namespace asdfvk {
namespace {

/// Logs may come from other programs: a missing text is empty.
std::string textAt(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string kindOf(const Json& finding) {
  const std::string kind = textAt(finding, "kind");
  return kind.empty() ? "unknown" : kind;
}

}  // namespace

std::vector<std::string> checkFormatNames() {
  std::vector<std::string> names;
  for (const auto& [name, format] : kCheckFormats) names.emplace_back(name);
  return names;
}

CheckFormat checkFormatOf(std::string_view name) {
  const auto found =
      std::find_if(kCheckFormats.begin(), kCheckFormats.end(), [&](const auto& row) { return row.first == name; });
  ASDFVK_CHECK(found != kCheckFormats.end());
  return found->second;
}

std::vector<CheckItem> checkItemsOf(const MeshRecord& record) {
  std::vector<CheckItem> items;
  for (const Json& finding : record.findings)
    if (finding.is_object())
      items.push_back({kindOf(finding), textAt(finding, "level"),
                       fmt::format("{}; {}", textAt(finding, "message"), textAt(finding, "remedy")), finding});
  const bool isExplained = std::any_of(items.begin(), items.end(), [](const CheckItem& item) {
    return item.level == "failure" || item.level == "notJudged";
  });
  // Without a result, for example from an unreadable file; or from a check that has no places.
  if (record.code != 0 && !isExplained)
    items.push_back({record.error.empty() ? "failed" : record.error, "error", record.message, nullptr});
  return items;
}

std::string checkReport(CheckFormat format, std::span<const MeshRecord> records) {
  switch (format) {
    case CheckFormat::Sarif:
      return sarifOf(records);
    case CheckFormat::Junit:
      return junitOf(records);
    case CheckFormat::Github:
      return githubAnnotationsOf(records);
  }
  ASDFVK_CHECK(!"an unknown format");
  return {};
}

}  // namespace asdfvk
