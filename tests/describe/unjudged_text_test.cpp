#include "describe/unjudged_text.h"

#include <doctest/doctest.h>

#include <string>

#include "describe/report_text.h"

namespace asdfvk {
namespace {

TEST_CASE("names of bodies stay as they are, also with braces, and remedies are spelled for the front end") {
  UnjudgedFaces unjudged;
  for (const UnjudgedCause cause : {UnjudgedCause::Inverted, UnjudgedCause::WoundAgainst, UnjudgedCause::Border}) {
    UnjudgedReason reason;
    reason.cause = cause;
    reason.isRepairable = true;
    reason.bodies = {"a{b", "{orient=auto}"};
    unjudged.reasons = {reason};
    const std::string text = unjudgedRows(unjudged, OptionSpelling::Flag).front().second;
    CAPTURE(text);
    CHECK(text.find("a{b") != std::string::npos);
    CHECK(text.find("{orient=auto}") != std::string::npos);
    CHECK((text.find("--orient auto") != std::string::npos) == (cause != UnjudgedCause::Border));
    CHECK(shortUnjudgedRows(unjudged, OptionSpelling::Flag).front().second.find("a{b") != std::string::npos);
  }
}

TEST_CASE("a page names a Vulkan device also where no ray was traced, and no CPU, whose name has a number of threads") {
  for (const char* backend : {"vulkan", "cpu", "reference"}) {
    CAPTURE(backend);
    Report report;
    report.backend = backend;
    report.device = "the device";
    bool hasDevice = false;
    for (const auto& row : reportTexts(report, false, OptionSpelling::Flag).summary)
      hasDevice = hasDevice || row.second.find("the device") != std::string::npos;
    CHECK(hasDevice == (std::string(backend) == "vulkan"));
  }
}

}  // namespace
}  // namespace asdfvk
