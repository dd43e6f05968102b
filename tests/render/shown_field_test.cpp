#include <doctest/doctest.h>

#include <string>

#include "asdf_vk/session.h"
#include "render/result_picture.h"

namespace asdfvk {
namespace {

std::string shownName(const Result& result) {
  const Field* const field = shownField(result);
  return field == nullptr ? "thin places" : field->name;
}

Field fieldOf(const char* name) {
  Field field;
  field.name = name;
  return field;
}

TEST_CASE("with segments a picture shows them") {
  Result result;
  result.fields = {fieldOf("sdf"), fieldOf("seed")};
  CHECK(shownName(result) == "sdf");
  result.fields.push_back(fieldOf("segment"));
  CHECK(shownName(result) == "segment");
}

TEST_CASE("a picture shows the thickness rather than segments, and with a limit the thin places") {
  Result result;
  result.fields = {fieldOf("sdf"), fieldOf("segment"), fieldOf("thickness"), fieldOf("least_thickness")};
  result.report.thickness.emplace();
  CHECK(shownName(result) == "thickness");
  result.report.thickness->thinnerThan = 0.5;
  CHECK(shownName(result) == "thin places");
}

}  // namespace
}  // namespace asdfvk
