#include "paper/plots/file_stems.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/text.h"

namespace asdfvk::bench {
namespace {

/// What every file system and every address takes as it is.
std::string plainName(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        const bool isPlain = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '-' ||
                             c == '_' || c == '.';
        return !isPlain;
      },
      '_');
  return text.empty() ? "mesh" : text;
}

}  // namespace

std::vector<std::string> uniqueStems(const std::vector<std::string>& paths) {
  std::vector<std::string> stems;
  std::set<std::string> taken;  // In lower case: some file systems do not tell the difference.
  for (const std::string& path : paths) {
    const std::string stem = plainName(std::filesystem::path(path).stem().string());
    std::string name = stem;
    for (size_t number = 2; !taken.insert(lowerCase(name)).second; ++number) name = stem + '-' + std::to_string(number);
    stems.push_back(name);
  }
  return stems;
}

}  // namespace asdfvk::bench
