#pragma once

#include <vector>

namespace asdfvk::bench {

/// Moves labels that would overlap apart: positions along a line, in the order of `wished`, no two nearer than
/// `distance` and all within low .. high, in the order of the wished ones and each near its own. Where there is no room
/// for that distance, they are spread evenly.
[[nodiscard]] std::vector<double> placeLabels(const std::vector<double>& wished, double distance, double low,
                                              double high);

}  // namespace asdfvk::bench
