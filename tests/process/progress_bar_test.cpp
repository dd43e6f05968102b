#include "process/terminal.h"

#include <doctest/doctest.h>

#include <limits>

namespace asdfvk {
namespace {

TEST_CASE("the bar waits for a second, is redrawn ten times a second, and is wiped") {
  std::string screen;
  double time = 100;
  {
    ProgressBar bar([&](std::string_view text) { screen += text; }, [&] { return time; });
    time = 100.9;
    bar.update(0.1);
    bar.clear();
    CHECK(screen.empty());
    time = 101.1;
    bar.update(0.25);
    CHECK(screen.find(" 25 %") != std::string::npos);
    const size_t size = screen.size();
    time = 101.15;
    bar.update(0.26);
    CHECK_EQ(screen.size(), size);
    time = 101.3;
    bar.update(0.5);
    CHECK(screen.find(" 50 %") != std::string::npos);
  }
  CHECK(screen.ends_with("\r\x1b[K"));
}

TEST_CASE("the text of the bar has constant width for any number") {
  const size_t width = progressBarText(0).size();
  for (const double fraction : {-1.0, 0.0, 0.004, 0.5, 0.999, 1.0, 2.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_EQ(progressBarText(fraction).size(), width);
  CHECK(progressBarText(0.999).ends_with(" 99 %"));
  CHECK(progressBarText(1).ends_with("100 %"));
  CHECK(progressBarText(-1).ends_with("  0 %"));
  CHECK_EQ(progressBarText(0.5).find(' '), 21);
}

}  // namespace
}  // namespace asdfvk
