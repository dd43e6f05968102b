#pragma once

#include <vector>

#include "asdf_vk/report.h"

namespace asdfvk {

/// What fails a check although it has no limit.
struct CheckedSpaces {
  bool voids = false, contacts = false;
};

/// The findings of a report: places that count for a verdict, thick bodies, sealed voids, bodies in contact, and causes
/// that prevent a verdict. Sealed voids and bodies in contact are notes, unless `checked` has them.
[[nodiscard]] std::vector<Finding> findingsOf(const Report& report, CheckedSpaces checked = {});

}  // namespace asdfvk
