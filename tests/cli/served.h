#pragma once

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program_under_test.h"

namespace asdfvk::test {

using ServedJson = nlohmann::ordered_json;

/// Runs `asdf-vk serve` with these lines, and returns the answers in their order.
inline std::vector<ServedJson> served(const std::vector<std::string>& lines,
                                      std::vector<std::string> options = {"--jobs", "1"},
                                      const std::string& command = "serve") {
  ChildOptions child;
  for (const std::string& line : lines) child.input += line + "\n";
  options.insert(options.begin(), command);
  options.insert(options.end(), {"--backend", "reference"});
  const ChildOutcome outcome = runAsdf(options, child);
  CHECK_EQ(outcome.exitCode, 0);
  CHECK_EQ(outcome.error, "");
  std::vector<ServedJson> answers;
  for (const std::string& line : linesOf(outcome.output)) answers.push_back(ServedJson::parse(line));
  return answers;
}

/// The member of the error of an answer.
inline std::string errorOf(const ServedJson& answer, const char* member) {
  REQUIRE(answer.contains("error"));
  return answer.at("error").at(member).get<std::string>();
}

}  // namespace asdfvk::test
