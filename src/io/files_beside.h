#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/unset_vector.h"

namespace asdfvk {

/// The files with further data of a mesh file, in the folder of the mesh file. Each file is read once.
class FilesBeside {
 public:
  using Inspect = std::function<void(std::span<const char>)>;

  /// file: the path of the mesh file. inspect: called with the bytes of each file that is read.
  FilesBeside(std::filesystem::path file, Inspect inspect) : file_(std::move(file)), inspect_(std::move(inspect)) {}

  /// The bytes of the file with the relative name `name`, with '/' after each folder. Valid as long as this object.
  /// Throws Error{UnreadableInput} if there is no such regular file, or if it is not in the folder after all symbolic
  /// links are followed. The message begins with `where`.
  [[nodiscard]] std::span<const char> read(std::string_view name, std::string_view where);
  /// The number of bytes of all files that were read.
  [[nodiscard]] uint64_t byteCount() const { return byteCount_; }

 private:
  std::filesystem::path file_;
  Inspect inspect_;
  std::map<std::string, UnsetVector<char>> files_;  ///< By their canonical paths.
  uint64_t byteCount_ = 0;
};

}  // namespace asdfvk
