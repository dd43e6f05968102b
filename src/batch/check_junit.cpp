#include <fmt/core.h>

#include "batch/check_report.h"
#include "core/html_text.h"

namespace asdfvk {
namespace {

std::string element(const char* name, const std::string& type, const std::string& message, const std::string& text) {
  return fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", name, escapedForHtml(type),
                     escapedForHtml(message), escapedForHtml(text));
}

struct Counts {
  size_t failures = 0, errors = 0, skipped = 0;
};

/// A failure: the check failed. An error: there is no verdict.
std::string outcomeOf(const MeshRecord& record, Counts& counts) {
  if (record.status == MeshStatus::Dropped) {
    ++counts.skipped;
    return fmt::format("      <skipped message=\"{}\"/>\n", escapedForHtml(record.message));
  }
  std::string lines;
  bool hasFailure = false;
  for (const CheckItem& item : checkItemsOf(record)) {
    if (item.level == "note") continue;
    hasFailure = hasFailure || item.level == "failure";
    lines += fmt::format("{}: {}\n", item.kind, item.message);
  }
  if (record.code == 0) return {};
  ++(hasFailure ? counts.failures : counts.errors);
  return element(hasFailure ? "failure" : "error", record.error, record.message, lines);
}

/// The path. A mesh may be in a list several times, each time with another key.
std::string nameOf(const MeshRecord& record) {
  const bool isNamed = record.key.empty() || record.input.find(record.key) != std::string::npos;
  return isNamed ? record.input : fmt::format("{} ({})", record.input, record.key);
}

}  // namespace

std::string junitOf(std::span<const MeshRecord> records) {
  Counts counts;
  std::string cases;
  double seconds = 0;
  for (const MeshRecord& record : records) {
    seconds += record.totalSeconds;
    const std::string outcome = outcomeOf(record, counts);
    cases += fmt::format("    <testcase classname=\"asdf-vk\" name=\"{0}\" time=\"{1:.3f}\"{2}>\n",
                         escapedForHtml(nameOf(record)), record.totalSeconds, outcome.empty() ? "/" : "");
    if (!outcome.empty()) cases += outcome + "    </testcase>\n";
  }
  // The schemas of Jenkins and Maven Surefire allow no further attributes.
  const std::string numbers = fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"", records.size(),
                                          counts.failures, counts.errors, seconds);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n  <testsuite name=\"asdf-vk\" {0} "
      "skipped=\"{2}\">\n{1}  </testsuite>\n</testsuites>\n",
      numbers, cases, counts.skipped);
}

}  // namespace asdfvk
