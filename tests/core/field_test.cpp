#include "asdf_vk/field.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"

using namespace asdfvk;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Field realField(std::vector<double> values) { return {.name = "sdf", .values = std::move(values)}; }

}  // namespace

TEST_CASE("a field has entries of its type, by number of components") {
  const Field points{.name = "points",
                     .location = FieldLocation::PerVertex,
                     .componentCount = 3,
                     .values = std::vector<double>{1, 2, 3, 4, 5, 6}};
  CHECK(points.size() == 6);
  CHECK(points.itemCount() == 2);
  CHECK(points.at(4) == 5);
  REQUIRE(points.reals() != nullptr);
  CHECK(points.reals()->size() == 6);

  const Field flags{.name = "seed", .values = std::vector<uint8_t>{0, 255}};
  CHECK(flags.itemCount() == 2);
  CHECK(flags.at(1) == 255);
  CHECK(flags.reals() == nullptr);
  const Field indices{.name = "component", .values = std::vector<uint32_t>{4'294'967'295u}};
  CHECK(indices.at(0) == 4'294'967'295.0);
  CHECK(indices.reals() == nullptr);

  CHECK(Field{}.itemCount() == 0);
  CHECK(Field{.componentCount = 0, .values = std::vector<double>{1}}.itemCount() == 0);
}

TEST_CASE("a field is found by its whole name, the first of two") {
  const std::vector<Field> fields{{.name = "sdf"}, {.name = "seed", .label = "first"}, {.name = "seed"}};
  CHECK(findField(fields, "sdf") == &fields[0]);
  CHECK(findField(fields, "seed") == &fields[1]);
  CHECK(findField(fields, "see") == nullptr);
  CHECK(findField(fields, "Sdf") == nullptr);
  CHECK(findField(fields, "") == nullptr);
  CHECK(findField({}, "sdf") == nullptr);
}

TEST_CASE("a summary has the extremes, the upper median and the number of missing entries") {
  const FieldSummary odd = summarize(realField({5, 1, 3}));
  CHECK(odd.min == 1);
  CHECK(odd.median == 3);
  CHECK(odd.max == 5);
  CHECK(odd.missingCount == 0);
  CHECK(summarize(realField({4, 1, 3, 2})).median == 3);
  CHECK(summarize(realField({7})).median == 7);

  const FieldSummary some = summarize(realField({kNaN, -2, kInfinity, 8, -kInfinity, kNaN}));
  CHECK(some.min == -2);
  CHECK(some.median == 8);
  CHECK(some.max == 8);
  CHECK(some.missingCount == 4);

  const FieldSummary flags = summarize({.name = "seed", .values = std::vector<uint8_t>{0, 1, 0, 0}});
  CHECK(flags.min == 0);
  CHECK(flags.median == 0);
  CHECK(flags.max == 1);
  CHECK(flags.missingCount == 0);
}

TEST_CASE("a summary without any value has NaN for the three numbers") {
  for (const auto& values : {std::vector<double>{}, {kNaN, kNaN}, {kInfinity}}) {
    const FieldSummary summary = summarize(realField(values));
    CHECK(std::isnan(summary.min));
    CHECK(std::isnan(summary.median));
    CHECK(std::isnan(summary.max));
    CHECK(summary.missingCount == values.size());
  }
}

TEST_CASE("a summary does not change its field") {
  const Field field = realField({3, 1, 2});
  (void)summarize(field);
  CHECK(*field.reals() == std::vector<double>{3, 1, 2});
}

TEST_CASE("numbers fit into float32 unless one is beyond its range, or all would be 0") {
  const double greatest = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  for (const auto& numbers :
       {std::vector<double>{}, {0, -0.0}, {kNaN, kInfinity, -kInfinity}, {greatest, -greatest}, {least, 0}, {1, 1e-60}})
    CHECK_NOTHROW(requireSingles(numbers, "'a'"));
  for (const auto& [numbers, text] : {std::pair{std::vector<double>{1, kNaN, -1e39}, "1e+39"}, {{0, 1e-50}, "1e-50"}})
    try {
      requireSingles(numbers, "'a'");
      FAIL("accepted");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::ValueOutOfRange);
      CHECK(std::string(error.what()) == "a value of 'a' in the unit of the mesh does not fit into float32: " +
                                             std::string(text) + "; scale the mesh");
    }
}
