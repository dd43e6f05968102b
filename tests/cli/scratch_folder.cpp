#include "cli/scratch_folder.h"

#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "core/check.h"
#include "support/kept_json.h"

namespace asdfvk::test {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "asdf-vk-test-XXXXXX").string();
  ASDFVK_CHECK(mkdtemp(name.data()) != nullptr);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (std::getenv("ASDF_VK_JSON_FOLDER") != nullptr)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_, ignored))
      if (entry.is_regular_file(ignored) && std::ifstream(entry.path()).peek() == '{')
        keepJson(read(entry.path().lexically_relative(path_).string()), {}, entry.path().string());
  std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::write(const std::string& name, const std::string& bytes) const {
  std::ofstream file(path_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  ASDFVK_CHECK(file.good());
  return (path_ / name).string();
}

std::string ScratchFolder::read(const std::string& name) const {
  std::ifstream file(path_ / name, std::ios::binary);
  ASDFVK_CHECK(file.good());
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> ScratchFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace asdfvk::test
