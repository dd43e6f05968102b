#pragma once

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/random.h"
#include "sample_problems.h"

namespace asdfvk::test {

struct Setting {
  uint32_t clusterCount;
  double smoothness;
};
/// Settings that users of CGAL's segmentation have; the first is CGAL's default.
inline constexpr std::array<Setting, 5> kSettings{{{5, 0.26}, {3, 0.20}, {2, 0.09}, {5, 0.08}, {5, 0.10}}};

/// Values and segments of a small generated shape as CGAL 5.5.1 computed them, for machines without CGAL.
struct StoredCase {
  std::vector<double> raw;                                       ///< NaN for no value.
  std::vector<double> normalized;                                ///< CGAL's of `raw`.
  std::array<std::vector<uint32_t>, kSettings.size()> segments;  ///< CGAL's of `normalized`.
};

inline Mesh storedCaseMesh() { return generateShape("hand", 400).mesh; }

inline std::filesystem::path storedCasePath() {
  return std::filesystem::path(ASDFVK_TEST_DIR) / "segment" / "cgal_hand_400.txt";
}

/// A line per face: raw value or "-", normalised value, segments.
inline StoredCase readStoredCase() {
  std::ifstream in(storedCasePath());
  REQUIRE(in);
  StoredCase stored;
  for (std::string raw, normalized; in >> raw >> normalized;) {
    stored.raw.push_back(raw == "-" ? kNoValue : std::stod(raw));
    stored.normalized.push_back(std::stod(normalized));
    for (std::vector<uint32_t>& segments : stored.segments) in >> segments.emplace_back();
  }
  REQUIRE(in.eof());
  return stored;
}

}  // namespace asdfvk::test
