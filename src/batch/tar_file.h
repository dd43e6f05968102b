#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/atomic_file.h"

struct archive;

namespace asdfvk {

struct TarMember {
  enum class Kind { File, Folder, SymbolicLink, HardLink, Other };

  std::string name;
  Kind kind = Kind::File;
  uint64_t byteCount = 0;
  std::string target = {};  ///< Target of a link.
  int64_t time = 0;         ///< Modification time in seconds since 1970.
  uint32_t permissions = 0644;
};

/// Reads a tar, also compressed by gzip, bzip2, xz, zstd or lz4, from its beginning to its end. A sparse member is read
/// with its zeros. Several tars in one file are read as one.
class TarReader {
 public:
  /// path: "-" is standard input. A stop request ends a wait for further bytes. Throws Error{UnreadableInput}.
  TarReader(const std::string& path, std::stop_token stop);
  ~TarReader();
  TarReader(const TarReader&) = delete;
  TarReader& operator=(const TarReader&) = delete;

  /// Returns the next member; unset at the end of the file. The rest of the bytes of the current member is skipped.
  /// Throws Error{UnreadableInput} for a file that is no tar, is damaged or ends without the mark of the end of a tar,
  /// and Error{Cancelled} after a stop request.
  [[nodiscard]] std::optional<TarMember> next();
  /// Reads bytes of the current member. Returns fewer than `size` only at their end. Throws like next().
  [[nodiscard]] size_t read(char* to, size_t size);

  /// contentHash() of the file. Precondition: next() returned no member.
  [[nodiscard]] std::string hash() const;

 private:
  struct Source;

  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void failArchive() const;

  std::unique_ptr<Source> source_;
  archive* archive_;
  std::string current_;  ///< Name of the current member, for messages.
  bool hasMembers_ = false;
  int64_t endOfMember_ = 0;  ///< Number of bytes of the tar to the end of the current member.
};

/// Writes a tar in the format of GNU, which keeps the bytes of names. The extensions .gz, .tgz and .zst compress it.
class TarWriter {
 public:
  /// path: "-" is standard output. Throws Error{OutputNotWritable}.
  explicit TarWriter(const std::string& path);
  ~TarWriter();
  TarWriter(const TarWriter&) = delete;
  TarWriter& operator=(const TarWriter&) = delete;

  /// Begins a member. TarMember::byteCount bytes follow by write(), in any pieces.
  void begin(const TarMember& member);
  void write(std::string_view bytes);

  /// Completes the tar. Its file appears now.
  void commit();
  /// Flushes the complete members to standard output, without the mark of the end of a tar. A file does not appear.
  void abandon();

 private:
  struct Sink;

  void require(bool isDone) const;

  std::string path_;
  std::unique_ptr<Sink> sink_;
  archive* archive_;
  uint64_t missingBytes_ = 0;  ///< Bytes of the current member that were not written.
};

}  // namespace asdfvk
