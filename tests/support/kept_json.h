#pragma once

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace asdfvk::test {

/// Appends a JSON text of the program to a file in the folder ASDF_VK_JSON_FOLDER, if the variable is set;
/// tests/cli/kept_json_test.py validates the files. input: what the program has read. file: where it was written;
/// empty: standard output.
inline void keepJson(const std::string& output, const std::string& input = {}, const std::string& file = {}) {
  const char* const folder = std::getenv("ASDF_VK_JSON_FOLDER");
  if (folder == nullptr || !output.starts_with('{')) return;
  const nlohmann::json run{{"input", input}, {"file", file}, {"output", output}};
  std::ofstream(std::string(folder) + "/" + std::to_string(getpid()) + ".jsonl", std::ios::app)
      << run.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

/// Parses a JSON document of the program, and keeps it.
inline nlohmann::json keptDocument(const std::string& text) {
  keepJson(text);
  return nlohmann::json::parse(text);
}

}  // namespace asdfvk::test
