#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/byte_output.h"
#include "core/unfinished_files.h"

namespace asdfvk {

/// Atomic replacement of a file: bytes go to a temporary file beside the target, which commit() renames to the target.
/// Without a commit(), or after a failure, the temporary file is removed and the previous file is unchanged. An
/// existing file keeps its mode. Symbolic links are followed, also to a target that does not exist. Targets that are
/// not regular files (/dev/null, a FIFO) and "-" (standard output) are written directly. Every failure throws
/// Error{OutputNotWritable} with the error text of the operating system.
class AtomicFile final : public ByteOutput {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();

  void commit();

 private:
  friend class AtomicFiles;

  void makeRoom(size_t size) override;
  void writeLong(std::string_view bytes) override;

  void openTemporary();
  void flush();
  void close();
  void closeAndRemove() noexcept;
  [[noreturn]] void failAndRemove(int errorNumber);
  [[noreturn]] void fail(int errorNumber, const std::string& during) const;

  std::filesystem::path target_, temporary_;  ///< temporary_ is empty if the target is written directly.
  UnfinishedFile unfinished_;                 ///< The temporary file.
  bool isStandardOutput_ = false;
  int descriptor_ = -1;
};

/// Files that appear together or not at all. All temporary files are complete before commit() renames the first. If a
/// file cannot be renamed, the targets of the files before it are removed; a target that replaced a file remains.
class AtomicFiles {
 public:
  /// Calls write(file) for a new file. Targets that have no temporary file are complete on return.
  template <typename Write>
  void write(const std::filesystem::path& target, const Write& write) {
    AtomicFile& file = *files_.emplace_back(std::make_unique<AtomicFile>(target));
    write(file);
    finish(file);
  }
  void commit();

 private:
  static void finish(AtomicFile& file);

  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// Resolves the symbolic links at the end of the path. The file itself need not exist.
[[nodiscard]] std::filesystem::path followLinks(std::filesystem::path path);

}  // namespace asdfvk
