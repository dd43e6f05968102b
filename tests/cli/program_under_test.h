#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/child_process.h"

namespace asdfvk::test {

/// Runs the built asdf-vk.
inline ChildOutcome runAsdf(const std::vector<std::string>& arguments, const ChildOptions& options = {}) {
  return runChild(ASDFVK_PROGRAM, arguments, options);
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// The program ended with `exitCode` and printed one error line, which contains `part`. For runs with --quiet.
inline void checkFailure(const ChildOutcome& outcome, int exitCode, const std::string& part) {
  INFO(outcome.error);
  CHECK_EQ(outcome.signal, 0);
  CHECK_EQ(outcome.exitCode, exitCode);
  const std::vector<std::string> lines = linesOf(outcome.error);
  REQUIRE_EQ(lines.size(), 1);
  CHECK(outcome.error.ends_with('\n'));
  const bool isVerdict = exitCode == 5 || exitCode == 6;
  CHECK(lines[0].starts_with(isVerdict ? "asdf-vk: " : "asdf-vk: error: "));
  CHECK(lines[0].find(part) != std::string::npos);
}

}  // namespace asdfvk::test
