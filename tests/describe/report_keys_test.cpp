#include <doctest/doctest.h>

#include <set>
#include <string>
#include <type_traits>

#include "describe/report_keys.h"

namespace asdfvk {
namespace {

TEST_CASE("the keys are the members, each once, with their values") {
  ThicknessReport thickness;
  thickness.thinnerThan = 0.5;
  thickness.noValueCount = 7;
  std::set<std::string> keys;
  visitKeys(thickness, [&](const std::string& key, const auto& member) {
    CHECK(keys.insert(key).second);
    if constexpr (std::is_same_v<decltype(member), const std::optional<double>&>) {
      CHECK_EQ(key, "thinnerThan");
      CHECK(&member == &thickness.thinnerThan);
    }
    if constexpr (std::is_same_v<decltype(member), const uint64_t&>) {
      CHECK_EQ(key, "noValueCount");
      CHECK_EQ(member, 7);
    }
  });
  CHECK(keys.contains("verdict"));
  CHECK(keys.contains("minOpposite"));  // The second of two members in one line.
  CHECK_EQ(std::string(structureName(thickness)), "ThicknessReport");
}

/// The names of consecutive codes, up to the last one.
template <typename Code>
std::set<std::string> namesUpTo(Code last) {
  std::set<std::string> names;
  for (int code = 0; code <= static_cast<int>(last); ++code) names.insert(nameOf(static_cast<Code>(code)));
  return names;
}

TEST_CASE("stages, verdicts and warnings have a name each") {
  CHECK_EQ(std::string(nameOf(Stage::Read)), "read");
  CHECK_EQ(std::string(nameOf(Stage::Write)), "write");
  CHECK_EQ(std::string(nameOf(ThicknessVerdict::NotJudged)), "notJudged");
  CHECK_EQ(std::string(nameOf(WarningCode::OnlySmallComponents)), "onlySmallComponents");
  CHECK_EQ(namesUpTo(Stage::Write).size(), kStageNames.size());
  CHECK_EQ(namesUpTo(ThicknessVerdict::NotJudged).size(), kThicknessVerdictNames.size());
  CHECK_EQ(namesUpTo(WarningCode::CoarseParts).size(), kWarningCodeNames.size());
}

}  // namespace
}  // namespace asdfvk
