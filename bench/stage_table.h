#pragma once

#include <string>

#include "machine.h"
#include "stage_measurement.h"

namespace asdfvk::bench {

/// A heading, a Markdown table with a row per seeds and backend, and the ratios within the run.
[[nodiscard]] std::string stageTable(const StageMeasurement& measurement, const Machine& machine);

}  // namespace asdfvk::bench
