#include "core/check.h"

#include <fmt/core.h>

namespace asdfvk {

void failCheck(const char* file, int line, const char* text) {
  throw CheckFailure(fmt::format("{}:{}: {}", file, line, text));
}

void failCheck(const char* file, int line, const char* text, const std::string& left, const std::string& right) {
  throw CheckFailure(fmt::format("{}:{}: {} ({} against {})", file, line, text, left, right));
}

std::string checkedNumber(double number) { return fmt::format("{}", number); }

}  // namespace asdfvk
