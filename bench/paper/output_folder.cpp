#include "paper/output_folder.h"

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "render/png.h"

namespace asdfvk::bench {

OutputFolder::OutputFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!std::filesystem::is_directory(path_))
    throw Error(ErrorCode::OutputNotWritable, path_.string() + ": " + (error ? error.message() : "not a folder"));
}

void OutputFolder::write(const std::string& name, std::string_view text) const {
  AtomicFile file(path_ / name);
  file.write(text);
  file.commit();
}

void OutputFolder::write(const std::string& name, const Image& image) const { writePng(path_ / name, image); }

}  // namespace asdfvk::bench
