#include "core/text.h"

#include <doctest/doctest.h>

using namespace asdfvk;

TEST_CASE("the letters A to Z become lower case and nothing else changes") {
  CHECK(lowerCase("").empty());
  CHECK(lowerCase("AZ az @[ 09 .PlY") == "az az @[ 09 .ply");
  CHECK(lowerCase("\xC3\x84\xFF") == "\xC3\x84\xFF");
}
