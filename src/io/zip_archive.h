#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asdfvk {

class Inflater;

struct ZipEntry {
  std::string_view name;
  uint64_t headerOffset = 0;
  uint64_t storedSize = 0;  ///< Bytes in the archive.
  uint64_t size = 0;
  uint32_t checksum = 0;
  uint16_t method = 0;
};

/// The form in which names of parts (Open Packaging Conventions) are compared: without the first slash, with %HH
/// decoded, backslashes as slashes, ASCII letters in lower case.
[[nodiscard]] std::string partName(std::string_view name);

/// Reads the directory of a ZIP archive (PKWARE APPNOTE 6.3, with ZIP64). Throws Error{UnreadableInput}, also if files
/// overlap.
class ZipArchive {
 public:
  /// `bytes` must outlive this object.
  explicit ZipArchive(std::span<const char> bytes);

  /// Compares names by partName(). Returns null if there is no such file. Throws Error{UnreadableInput} if there are
  /// several.
  [[nodiscard]] const ZipEntry* find(std::string_view name) const;
  [[nodiscard]] std::span<const char> bytes() const { return bytes_; }
  /// Number of bytes after the end of the archive, at most 65,535.
  [[nodiscard]] uint64_t trailingByteCount() const { return trailingByteCount_; }

 private:
  std::span<const char> bytes_;
  uint64_t trailingByteCount_ = 0;
  std::vector<ZipEntry> entries_;
  std::map<std::string, std::pair<const ZipEntry*, uint32_t>> entriesOf_;  ///< First entry and their number, by name.
};

/// Reads a file of an archive piece by piece. Verifies size and checksum at the end.
class ZipStream {
 public:
  /// `entry` must outlive this object. Throws Error{UnreadableInput} for an encrypted entry or an unknown method.
  ZipStream(const ZipArchive& archive, const ZipEntry& entry);
  ~ZipStream();
  ZipStream(const ZipStream&) = delete;
  ZipStream& operator=(const ZipStream&) = delete;

  /// Reads up to `size` bytes; fewer only at the end of the file. Throws Error{UnreadableInput} for damaged data.
  [[nodiscard]] size_t read(char* to, size_t size);

 private:
  void finish();

  const ZipEntry& entry_;
  std::span<const char> stored_;
  std::unique_ptr<Inflater> inflater_;  ///< Null for a stored file.
  uint64_t doneSize_ = 0;
  uint32_t checksum_ = 0;
  bool isFinished_ = false;
};

}  // namespace asdfvk
