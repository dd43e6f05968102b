#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/unfinished_files.h"

namespace asdfvk {

/// Atomic replacement of a file: bytes go to a temporary file beside the target, which commit() renames to the target.
/// Without a commit(), or after a failure, the temporary file is removed and the previous file is unchanged. An
/// existing file keeps its mode. Symbolic links are followed, also to a target that does not exist. Targets that are
/// not regular files (/dev/null, a FIFO) and "-" (standard output) are written directly. Every failure throws
/// Error{OutputNotWritable} with the error text of the operating system.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Returns memory for `size` bytes, at most kMaxReserve, into which the caller writes. advance() appends the written
  /// bytes.
  [[nodiscard]] char* reserve(size_t size) {
    if (size > kBufferSize - used_) flush();
    return buffer_.get() + used_;
  }
  void advance(size_t size) { used_ += size; }

  void write(const void* bytes, size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Appends the bytes of a number in little-endian order, the order of every supported machine.
  template <typename T>
  void put(const T& value) {
    std::memcpy(reserve(sizeof(T)), &value, sizeof(T));
    advance(sizeof(T));
  }
  /// Appends the shortest text that reads back as the same number, or "nan" for NaN of either sign.
  template <typename T>
  void putNumber(T number) {
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(number)) return write("nan");
    constexpr size_t kMaxTextSize = 32;
    char* const begin = reserve(kMaxTextSize);
    advance(static_cast<size_t>(std::to_chars(begin, begin + kMaxTextSize, number).ptr - begin));
  }

  void commit();

  static constexpr size_t kMaxReserve = size_t{1} << 16;

 private:
  friend class AtomicFiles;
  static constexpr size_t kBufferSize = size_t{1} << 20;

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
  std::unique_ptr<char[]> buffer_;
  size_t used_ = 0;
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
