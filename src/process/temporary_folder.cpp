#include "process/temporary_folder.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("there is no folder for temporary files: {}; set TMPDIR", error.message()));
  std::string path = (folder / "asdf-vk-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("{} cannot be made: {}", path, std::generic_category().message(errno)));
  path_ = std::move(path);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace asdfvk
