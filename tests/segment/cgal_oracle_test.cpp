#include <fmt/format.h>

#include <sstream>

#include "cgal_comparison.h"

using namespace asdfvk;

TEST_CASE("generated shapes: values and segments of CGAL") {
  for (const std::string shape : {"animal", "figure", "cylinder"}) {
    CAPTURE(shape);
    test::checkAgainstCgal(generateShape(shape, 1000).mesh);
  }
}

TEST_CASE("the stored case is what CGAL returns") {
  test::CgalOracle oracle(test::storedCaseMesh());
  const std::vector<double> raw = oracle.rawValues(), normalized = oracle.postprocess(raw).normalized;
  std::vector<std::vector<uint32_t>> segments;
  for (const test::Setting& setting : test::kSettings)
    segments.push_back(oracle.segment(normalized, setting.clusterCount, setting.smoothness));
  std::string text;
  for (size_t face = 0; face < raw.size(); ++face) {
    text += std::isnan(raw[face]) ? "-" : fmt::format("{}", raw[face]);
    text += fmt::format(" {}", normalized[face]);
    for (const std::vector<uint32_t>& numbers : segments) text += fmt::format(" {}", numbers[face]);
    text += '\n';
  }
  std::ostringstream stored;
  stored << std::ifstream(test::storedCasePath()).rdbuf();
  if (text == stored.str()) return;
  // Other versions of CGAL may differ in the last bits.
  MESSAGE("the file should be\n", text);
  const test::StoredCase numbers = test::readStoredCase();
  REQUIRE(numbers.raw.size() == raw.size());
  for (size_t face = 0; face < raw.size(); ++face)
    REQUIRE(std::abs(numbers.normalized[face] - normalized[face]) < 1e-9);
}
