#pragma once

#include <array>

/// What the ASDF paper prints.
namespace asdfvk::bench {

/// A row of its Table 1, for its horse: errors over the range of the values.
struct PrintedErrors {
  double percent = 0;  ///< Of the faces that cast rays.
  double maximum = 0, average = 0;
};
inline constexpr std::array<PrintedErrors, 6> kPrintedErrors{{{50, .4022, .0099},
                                                              {20, .5054, .0198},
                                                              {10, .5292, .0272},
                                                              {5, .5538, .0374},
                                                              {2, .5374, .0575},
                                                              {1, .5813, .0695}}};

// Section 5: 10 % of the faces take the horse "from sixty to slightly more than six seconds".
inline constexpr double kPrintedFullSeconds = 60, kPrintedTenthSeconds = 6;

// The shares of its pictures, in percent.
inline constexpr double kTeaserPercent = 10;  ///< Figures 1, 4 and 8; the paper tells it of Figure 4.
inline constexpr double kSparsePercent = 5;   ///< Figure 3.
inline constexpr double kSamplerPercent = 7;  ///< Figure 7.

}  // namespace asdfvk::bench
