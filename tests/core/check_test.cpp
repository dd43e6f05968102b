#include "core/check.h"

#include <doctest/doctest.h>

#include <string>

using namespace asdfvk;

namespace {

template <typename Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const CheckFailure& failure) {
    return failure.what();
  }
  return "nothing was thrown";
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

TEST_CASE("a check that holds does nothing") {
  CHECK(messageOf([] { ASDFVK_CHECK(1 + 1 == 2); }) == "nothing was thrown");
  CHECK(messageOf([] { ASDFVK_CHECK_OP(1, <=, 1); }) == "nothing was thrown");
}

TEST_CASE("a check that fails prints its place, its text and both values") {
  const int count = 7;
  const std::string message = messageOf([&] { ASDFVK_CHECK_OP(count + 1, <, 5); });
  CHECK(message.find("check_test.cpp:") != std::string::npos);
  CHECK_MESSAGE(endsWith(message, ": count + 1 < 5 (8 against 5)"), message);
  CHECK(endsWith(messageOf([] { ASDFVK_CHECK(2 > 3); }), ": 2 > 3"));
}

TEST_CASE("operands of a check are evaluated once") {
  int evaluationCount = 0;
  ASDFVK_CHECK_OP(++evaluationCount, ==, 1);
  CHECK(evaluationCount == 1);
}
