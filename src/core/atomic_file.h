#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace asdfvk {

/// A file that appears whole or not at all: bytes go to a temporary file beside the target, which commit() renames over
/// it. Without a commit(), or when something fails, the temporary is removed and what was there before stays as it was.
/// An existing file keeps its mode; a symbolic link is followed. What is not a regular file (/dev/null, a FIFO) and
/// "-", standard output, are written to directly. Every failure is an Error{Output} with the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Room for up to `size` bytes, at most kMaxReserve, of which advance() then takes as many as were filled.
  [[nodiscard]] char* reserve(size_t size) {
    if (size > kBufferSize - used_) flush();
    return buffer_.get() + used_;
  }
  void advance(size_t size) { used_ += size; }

  void write(const void* bytes, size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// The bytes of a number as they lie in memory; little-endian on every machine that this builds for.
  template <typename T>
  void put(const T& value) {
    std::memcpy(reserve(sizeof(T)), &value, sizeof(T));
    advance(sizeof(T));
  }

  /// Writes out what is left and puts the file in place.
  void commit();

  static constexpr size_t kMaxReserve = size_t{1} << 16;

 private:
  static constexpr size_t kBufferSize = size_t{1} << 20;

  void openTemporary();
  void announceTemporary();
  void withdrawTemporary() noexcept;
  void flush();
  void closeAndRemove() noexcept;
  [[noreturn]] void failAndRemove(int errorNumber);
  [[noreturn]] void fail(int errorNumber, const std::string& during) const;

  std::filesystem::path target_, temporary_;  ///< temporary_ is empty where the target is written to directly.
  std::unique_ptr<char[]> announced_;         ///< The name as removeUnfinishedFile() finds it.
  bool isStandardOutput_ = false;
  int descriptor_ = -1;
  std::unique_ptr<char[]> buffer_;
  size_t used_ = 0;
};

/// Removes the temporary of the one AtomicFile that is being written, if there is one: the last act of a process that
/// ends at once. Async-signal-safe. Of several files at the same time only the first one is known.
void removeUnfinishedFile() noexcept;

}  // namespace asdfvk
