#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

const fs::path kInclude = fs::path(ASDFVK_SOURCE_DIR) / "include";

/// Adds the direct and indirect includes of the file to `own` ("asdf_vk/...") and `foreign`.
void addIncludes(const std::string& file, std::set<std::string>& own, std::set<std::string>& foreign) {
  if (!own.insert(file).second) return;
  // version.h is generated from a template without includes.
  std::ifstream in(kInclude / (file == "asdf_vk/version.h" ? file + ".in" : file));
  REQUIRE_MESSAGE(in, file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#include")) continue;
    const size_t begin = line.find_first_of("<\"");
    const std::string target = line.substr(begin + 1, line.find_first_of(">\"", begin + 1) - begin - 1);
    if (line[begin] == '"') {
      addIncludes(target, own, foreign);
    } else {
      foreign.insert(target);
    }
  }
}

}  // namespace

TEST_CASE("asdf_vk.h includes public and standard headers only") {
  std::set<std::string> own, foreign;
  addIncludes("asdf_vk/asdf_vk.h", own, foreign);
  CHECK(own.count("asdf_vk/session.h") == 1);
  CHECK(foreign.count("vector") == 1);
  for (const std::string& file : own) CHECK_MESSAGE(file.starts_with("asdf_vk/"), file);
  // Standard headers of C++ have neither a folder nor an extension.
  for (const std::string& file : foreign) CHECK_MESSAGE(file.find_first_of("./") == std::string::npos, file);
}

TEST_CASE("every public header but openmesh.h and that of C belongs to asdf_vk.h") {
  std::set<std::string> own, foreign;
  addIncludes("asdf_vk/asdf_vk.h", own, foreign);
  for (const auto& entry : fs::directory_iterator(kInclude / "asdf_vk"))
    if (entry.path().extension() == ".h" && entry.path().filename() != "openmesh.h" &&
        entry.path().filename() != "asdf_vk_c.h")
      CHECK_MESSAGE(own.count("asdf_vk/" + entry.path().filename().string()) == 1, entry.path().string());
}
