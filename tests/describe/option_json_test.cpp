#include "describe/option_json.h"

#include <doctest/doctest.h>

#include "asdf_vk/error.h"
#include "core/json.h"
#include "describe/computation_options.h"
#include "support/require_failure.h"

namespace asdfvk::test {

TEST_CASE("options are set by the names and types of the JSON report") {
  ComputationSettings settings;
  const std::vector<OptionRows> tables{computationRows(settings)};
  const GivenOptions given = setOptions(tables, {{"thinnerThan", "0.8mm"},
                                                 {"angleDegrees", 90},
                                                 {"seeds", "10%"},
                                                 {"countEdges", true},
                                                 {"parts", nullptr},
                                                 {"recipe", "paper"}});
  CHECK(settings.options.thickness.thinnerThan.has_value());
  CHECK_EQ(settings.options.thickness.thinnerThan->value, 0.8);
  CHECK(settings.recipe == Recipe::Paper);
  CHECK(given.names == std::set<std::string, std::less<>>{"angle", "count-edges", "recipe", "seeds", "thinner-than"});
  CHECK(given.spelling == OptionSpelling::CamelCase);
}

TEST_CASE("wrong names and values are refused with a remedy") {
  ComputationSettings settings;
  const std::vector<OptionRows> tables{computationRows(settings)};
  const auto refused = [&](const Json& values, ErrorCode code, const std::string& part) {
    requireFailure([&] { (void)setOptions(tables, values); }, code, part);
  };
  refused({{"thinner_than", 1}}, ErrorCode::UnknownName, "did you mean thinnerThan?");
  refused({{"--thinner-than", 1}}, ErrorCode::UnknownName, "did you mean thinnerThan?");
  refused({{"thinerThan", 1}}, ErrorCode::UnknownName, "did you mean thinnerThan or");
  refused({{"rays", std::string(1000, '9')}}, ErrorCode::OptionOutOfRange, "999... is not");
  refused({{"xyzzy", 1}}, ErrorCode::UnknownName, "there is no option 'xyzzy'");
  refused({{"allowSharpEdges", true}}, ErrorCode::UnknownName, "was removed");
  refused({{"thinnerThan", -1}}, ErrorCode::OptionOutOfRange, "thinnerThan: -1 is not");
  refused({{"thinnerThan", Json::array({1})}}, ErrorCode::OptionOutOfRange, "thinnerThan: [1] is not");
  refused({{"measure", "thick"}}, ErrorCode::UnknownName, "measure: \"thick\" is not one of");
  refused({{"countEdges", 1}}, ErrorCode::OptionOutOfRange, "countEdges: 1 is not");
  refused({{"rays", 2.5}}, ErrorCode::OptionOutOfRange, "rays: 2.5 is not a whole number");
}

TEST_CASE("the schema of an option has its type, range and names") {
  ComputationSettings settings;
  const OptionRows rows = computationRows(settings);
  const auto schema = [&](const char* name) { return optionSchema(*findOption(rows, name), rows); };
  CHECK_EQ(schema("rays").at("type"), "integer");
  CHECK_EQ(schema("rays").at("minimum"), 1);
  CHECK_EQ(schema("rays").at("maximum"), 1024);
  CHECK_EQ(schema("count-edges").at("type"), "boolean");
  CHECK_EQ(schema("thinner-than").at("type").dump(), R"(["number","string"])");
  CHECK_EQ(schema("detail").at("type"), "number");
  CHECK_EQ(schema("recipe").at("enum").dump(), R"(["paper","balanced","quality"])");
  for (const OptionRow& row : rows) {
    CAPTURE(row.name);
    CHECK(schema(row.name).at("description").get<std::string>().find('{') == std::string::npos);
  }
}

}  // namespace asdfvk::test
