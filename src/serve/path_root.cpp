#include "serve/path_root.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

#include "core/atomic_file.h"

namespace asdfvk {

namespace fs = std::filesystem;

PathRoot::PathRoot(const fs::path& folder) {
  std::error_code error;
  folder_ = fs::canonical(folder, error);
  if (!error && !fs::is_directory(folder_, error) && !error) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw Error(ErrorCode::UnreadableInput, fmt::format("--root {}: {}", folder.string(), error.message()));
}

std::string PathRoot::resolved(const std::string& path, ErrorCode refusal) const {
  if (path == "-") throw Error(refusal, "the standard streams have requests and answers; name a file");
  if (path.find('\0') != std::string::npos) throw Error(refusal, "the path has a zero byte");
  if (folder_.empty()) return path;
  std::error_code error;
  // weakly_canonical() does not follow a link to a missing file, but a file is written to the target of such a link.
  const fs::path file = fs::weakly_canonical(followLinks(folder_ / path), error);
  if (error) throw Error(refusal, fmt::format("{}: {}", path, error.message()));
  if (std::mismatch(folder_.begin(), folder_.end(), file.begin(), file.end()).first != folder_.end())
    throw Error(refusal, fmt::format("{} is outside of {}, the folder of --root", path, folder_.string()));
  return file.string();
}

}  // namespace asdfvk
