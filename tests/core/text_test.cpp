#include "core/text.h"

#include <doctest/doctest.h>

#include <limits>

using namespace asdfvk;

TEST_CASE("the letters A to Z become lower case and nothing else changes") {
  CHECK(lowerCase("").empty());
  CHECK(lowerCase("AZ az @[ 09 .PlY") == "az az @[ 09 .ply");
  CHECK(lowerCase("\xC3\x84\xFF") == "\xC3\x84\xFF");
}

TEST_CASE("a count of one takes the singular, all other counts the plural") {
  CHECK(counted(0, "face") == "0 faces");
  CHECK(counted(1, "face") == "1 face");
  CHECK(counted(2, "face") == "2 faces");
  CHECK(counted(1, "vertex", "vertices") == "1 vertex");
  CHECK(counted(21, "vertex", "vertices") == "21 vertices");
  CHECK(counted(1234, "face") == "1,234 faces");
}

TEST_CASE("groupDigits puts a comma before every third digit from the end") {
  CHECK(groupDigits(0) == "0");
  CHECK(groupDigits(999) == "999");
  CHECK(groupDigits(1000) == "1,000");
  CHECK(groupDigits(1234567) == "1,234,567");
  CHECK(groupDigits(std::numeric_limits<uint64_t>::max()) == "18,446,744,073,709,551,615");
}

TEST_CASE("a limit has the digits that were given, without the rounding of a conversion") {
  CHECK(limitText(0.8) == "0.8");
  CHECK(limitText(0.8 * 1e-3) == "0.0008");
  CHECK(limitText(0.1234568) == "0.1234568");
}

TEST_CASE("a length has four digits, and as many more as it takes to differ from a limit") {
  CHECK(lengthText(1.23456) == "1.235");
  CHECK(lengthText(12345.6) == "1.235e+04");
  CHECK(lengthText(0.99984, 1.0) == "0.9998");
  CHECK(lengthText(0.99996, 1.0) == "0.99996");
  CHECK(lengthText(1.0000001, 1.0) == "1.0000001");
  CHECK(lengthText(1, 1.0) == "1");
  CHECK(lengthText(0.7999999999999546, 0.8) == "0.8");
  CHECK(lengthText(0.6, 0.8) == "0.6");
}

TEST_CASE("text is wrapped between words") {
  CHECK_EQ(wrapped("one two three", 8, "  "), "  one\n  two\n  three");
  CHECK_EQ(wrapped("one two\nthree", 7, ""), "one two\nthree");
  CHECK_EQ(wrapped("", 7, "  "), "");
}
