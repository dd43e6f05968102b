#include "describe/fields.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "asdf_vk/session.h"
#include "core/check.h"

namespace asdfvk {
namespace {

TEST_CASE("a field has the label, unit and components of its row") {
  const Field centre = makeField("centre", std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK_EQ(centre.label, "skeleton point");
  CHECK_EQ(centre.unit, "length");
  CHECK_EQ(centre.itemCount(), 2);
  CHECK(makeField("seed", std::vector<uint8_t>{1}).unit.empty());
}

TEST_CASE("a field without a row, or with entries of another type, is an error of the program") {
  CHECK_THROWS_AS((void)makeField("height", std::vector<double>{1}), CheckFailure);
  CHECK_THROWS_AS((void)makeField("seed", std::vector<double>{1}), CheckFailure);
  CHECK_THROWS_AS((void)makeField("segment", std::vector<uint8_t>{1}), CheckFailure);
}

TEST_CASE("the names of fields are unique") {
  const std::vector<std::string> names = resultFieldNames();
  CHECK_EQ(std::set<std::string>(names.begin(), names.end()).size(), fieldRows().size());
}

}  // namespace
}  // namespace asdfvk
