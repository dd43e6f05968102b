#include "web/joined_results.h"

#include <algorithm>

#include "describe/findings.h"

namespace asdfvk {
namespace {

bool isSame(const Warning& a, const Warning& b) { return a.code == b.code && a.message == b.message; }

}  // namespace

Result joined(const Result& checked, const Result& computed) {
  Result result = computed;
  for (const Field& field : checked.fields)
    if (result.field(field.name) == nullptr) result.fields.push_back(field);
  result.thinSurface = checked.thinSurface;
  Report& report = result.report;
  const Report& walls = checked.report;
  report.thickness = walls.thickness;
  report.gap = walls.gap;
  report.voids = walls.voids;
  report.contacts = walls.contacts;
  for (const Warning& warning : walls.warnings)
    if (std::none_of(report.warnings.begin(), report.warnings.end(),
                     [&](const Warning& other) { return isSame(warning, other); }))
      report.warnings.push_back(warning);
  for (size_t i = 0; i < kStageCount; ++i) report.stageSeconds.seconds[i] += walls.stageSeconds.seconds[i];
  report.findings = findingsOf(report);
  return result;
}

}  // namespace asdfvk
