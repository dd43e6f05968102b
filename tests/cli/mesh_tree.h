#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

/// Meshes, runs and results of the tests of batches.
namespace asdfvk::test {

using Names = std::vector<std::string>;
/// Meshes by status.
using StatusCounts = std::map<std::string, int>;

/// A tree of small meshes; two of them are broken.
struct MeshTree {
  ScratchFolder folder;
  std::string root = folder / "in";
  size_t meshCount = 0;

  explicit MeshTree(bool hasBroken = true) {
    std::filesystem::create_directories(folder / "in/deep/er");
    for (int i = 0; i < 4; ++i) add("in/s" + std::to_string(i) + ".off", sphereOff(6 + i));
    for (int i = 0; i < 4; ++i) add("in/deep/t" + std::to_string(i) + ".off", sphereOff(8 + i));
    add("in/deep/er/cube.stl", cubeBinaryStl());
    if (!hasBroken) return;
    add("in/deep/bad.off", "OFF\nnonsense");
    add("in/empty.off", "OFF\n0 0 0\n");
  }
  void add(const std::string& name, const std::string& bytes) {
    folder.write(name, bytes);
    ++meshCount;
  }
  [[nodiscard]] std::string operator/(const std::string& name) const { return folder / name; }
};

inline ChildOutcome runBatch(const Names& arguments, const std::string& program = ASDFVK_PROGRAM) {
  Names all = arguments;
  all.insert(all.end(), {"--backend", "reference", "--format", "npy"});
  return runChild(program, all);
}

/// Relative paths of the results below a folder, without the records.
inline std::map<std::string, std::string> resultsIn(const std::string& folder) {
  std::map<std::string, std::string> results;
  for (const std::filesystem::directory_entry& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".json") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    results[entry.path().lexically_relative(folder).string()] = std::string(std::istreambuf_iterator<char>(in), {});
  }
  return results;
}

inline std::vector<nlohmann::json> recordsIn(const std::string& log) {
  std::ifstream in(log);
  std::vector<nlohmann::json> records;
  for (std::string line; std::getline(in, line);) records.push_back(nlohmann::json::parse(line));
  return records;
}

inline StatusCounts statusesIn(const std::string& log) {
  StatusCounts counts;
  for (const nlohmann::json& record : recordsIn(log)) ++counts[record.at("status").get<std::string>()];
  return counts;
}

}  // namespace asdfvk::test
