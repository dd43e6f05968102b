#include "describe/warnings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

namespace asdfvk {
namespace {

/// Empty without a detail of that name.
std::string detailOf(const Warning& warning, const std::string& name) {
  const auto found = std::find_if(warning.details.begin(), warning.details.end(),
                                  [&](const ErrorDetail& detail) { return detail.name == name; });
  return found == warning.details.end() ? "" : found->value;
}

TEST_CASE("the warning of missing values has its likely causes") {
  Warning warning = missingValues({.count = 2, .faceCount = 12});
  CHECK_EQ(warning.message,
           "2 of 12 faces without a value: no ray from these faces, or from faces connected to them, hit the opposite "
           "side of the shape");
  CHECK_EQ(detailOf(warning, "count"), "2");
  CHECK(detailOf(warning, "cause").empty());
  warning = missingValues({.count = 1, .faceCount = 1, .isInverted = true, .keepsMissing = true});
  CHECK_EQ(
      warning.message,
      "1 of 1 face without a value: no ray from these faces hit the opposite side of the shape, most likely because "
      "their component is inverted");
  CHECK_EQ(detailOf(warning, "cause"), "inverted");
  CHECK_EQ(detailOf(missingValues({.count = 1, .faceCount = 1, .isOpen = true}), "cause"), "open");
  warning = missingValues({.count = 1, .faceCount = 1, .isInverted = true, .isOpen = true});
  CHECK(warning.message.find("is inverted, or the surface is open") != std::string::npos);
  CHECK_EQ(detailOf(warning, "cause"), "inverted or open");
}

TEST_CASE("the warning of a defect names its count in the report") {
  const std::vector<Warning> warnings = warningsOf({.duplicateFaceCount = 3, .unreferencedVertexCount = 1}, true);
  REQUIRE(warnings.size() == 2);
  CHECK_EQ(warnings[0].message, "3 triangles duplicate earlier ones: the rays of a face ignore its copies");
  CHECK_EQ(detailOf(warnings[0], "defect"), "duplicateFaceCount");
  CHECK_EQ(detailOf(warnings[0], "count"), "3");
  CHECK_EQ(detailOf(warnings[1], "defect"), "unreferencedVertexCount");
}

TEST_CASE("a failure of the device is in the warning with its code") {
  const Error failure(ErrorCode::DeviceLost, "the device was lost");
  CHECK_EQ(detailOf(solvedOnCpu(failure), "code"), "deviceLost");
  CHECK_EQ(predictedOnCpu(failure).message,
           "the CPU predicted values because the device could not: the device was lost");
  CHECK_EQ(backendReplaced("vulkan", "cpu", failure).message,
           "the backend cpu replaces vulkan, which failed: the device was lost");
}

TEST_CASE("a requested number of parts that is not possible") {
  CHECK_EQ(partCountDiffers(1, 2).message,
           "1 part requested; the mesh has 2 because a part does not extend over several components");
  CHECK_EQ(partCountDiffers(50, 12).message, "50 parts requested; the mesh can be divided into 12 only");
  CHECK_EQ(detailOf(partCountDiffers(50, 12), "found"), "12");
}

}  // namespace
}  // namespace asdfvk
