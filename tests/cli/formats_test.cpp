// Units of limits and the colours of results, from the command line.
#include <doctest/doctest.h>

#include "asdf_vk/error.h"
#include "cli/command_line.h"
#include "describe/computation_options.h"
#include "describe/option_values.h"

using namespace asdfvk;

TEST_CASE("a limit has the unit of the mesh or its own") {
  const auto lineOf = [](const std::string& limit) {
    return parseCommandLine({"a.3mf", "--fail-if-thinner", limit}).computation;
  };
  CHECK(lineOf("0.8").options.thickness.thinnerThan->unit == LengthUnit::OfMesh);
  for (const char* const text : {"0.8mm", "0.8 mm"}) {
    CAPTURE(text);
    const ComputationSettings computation = lineOf(text);
    CHECK(computation.options.thickness.thinnerThan->value == 0.8);
    CHECK(computation.options.thickness.thinnerThan->unit == LengthUnit::Millimetre);
    CHECK(LengthCodec::write(computation.failIfThinner) == OptionValue("0.8mm"));
  }
  CHECK(lineOf("3m").options.thickness.thinnerThan->unit == LengthUnit::Metre);
  for (const char* const text : {"0.8km", "mm", "-1mm", "0mm", "0.8 m m", "nan", "infmm"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS((void)lineOf(text), doctest::Contains("a number above 0, or one with a unit, such as 0.8mm"),
                         Error);
  }
  CHECK_THROWS_WITH_AS((void)parseCommandLine({"a.3mf", "--thinner-than", "1mm", "--fail-if-thinner", "1cm"}),
                       doctest::Contains("have different limits"), Error);
}
