#pragma once

#include <string>

#include "comparison.h"
#include "machine.h"

namespace asdfvk::bench {

/// A heading, a Markdown table with a row per seeds and tracer, and the ratios of builds and against CGAL.
[[nodiscard]] std::string comparisonTable(const Comparison& comparison, const Machine& machine);

/// One line.
[[nodiscard]] std::string comparisonJson(const Comparison& comparison, const Machine& machine);

}  // namespace asdfvk::bench
