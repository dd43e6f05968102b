#pragma once

#include <string>

#include "machine.h"
#include "stage_measurement.h"

namespace asdfvk::bench {

/// A JSON document per row, each on a line.
[[nodiscard]] std::string stageJson(const StageMeasurement& measurement, const Machine& machine);

}  // namespace asdfvk::bench
