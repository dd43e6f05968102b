#include "cli/member_files.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "io/formats.h"

namespace asdfvk {

namespace fs = std::filesystem;

MeshSettings memberSettings(MeshSettings settings, const std::string& folder) {
  Outputs& outputs = settings.outputs;
  outputs.path.clear();
  if (outputs.format.empty()) outputs.format = "ply";
  settings.makesFolders = true;
  settings.memberFolder = folder;
  return settings;
}

namespace {

fs::path& leftFolder() {
  static fs::path folder;
  return folder;
}

}  // namespace

void enterMemberFolder(const std::string& folder) {
  leftFolder() = fs::current_path();
  const fs::path own = fs::path(folder) / std::to_string(::getpid());
  fs::create_directory(own);
  fs::current_path(own);
}

fs::path absolutePathOf(const std::string& mesh) { return fs::absolute(leftFolder() / mesh).lexically_normal(); }

void removeMemberFolder(const std::string& folder, int process) {
  std::error_code ignored;
  fs::remove_all(fs::path(folder) / std::to_string(process), ignored);
}

std::vector<std::pair<std::string, std::string>> takenResult(const std::string& output) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const std::string& path : {besidePathOf(output).string(), output}) {
    std::ifstream file(path, std::ios::binary);
    if (file) files.emplace_back(path, std::string(std::istreambuf_iterator<char>(file), {}));
  }
  std::error_code ignored;
  for (const auto& [path, bytes] : files) fs::remove_all(*fs::path(path).begin(), ignored);
  return files;
}

}  // namespace asdfvk
