#pragma once

#include <zlib.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk::test {

/// A file of a ZIP archive, with what may be wrong about it.
struct ArchivedFile {
  std::string name, contents;
  bool isDeflated = false;
  uint16_t flags = 0;
  std::optional<uint16_t> method = {};
  std::optional<uint32_t> checksum = {}, size = {}, storedSize = {}, offset = {};
};

inline std::string deflated(std::string_view text) {
  std::string bytes(compressBound(static_cast<uLong>(text.size())) + 16, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

/// A ZIP archive. isWide: all sizes and offsets are in ZIP64 records.
inline std::string madeArchive(const std::vector<ArchivedFile>& files, std::string_view comment = "",
                               bool isWide = false) {
  std::string archive, directory;
  const auto put = [](std::string& to, uint64_t number, int size) {
    for (int i = 0; i < size; ++i) to += static_cast<char>(number >> (8 * i) & 0xff);
  };
  constexpr uint64_t kSeeWide = 0xffffffff;
  for (const ArchivedFile& file : files) {
    const std::string bytes = file.isDeflated ? deflated(file.contents) : file.contents;
    const uint64_t offset = file.offset.value_or(static_cast<uint32_t>(archive.size()));
    const uint64_t size = file.size.value_or(static_cast<uint32_t>(file.contents.size()));
    const uint64_t storedSize = file.storedSize.value_or(static_cast<uint32_t>(bytes.size()));
    const auto* const data = reinterpret_cast<const Bytef*>(file.contents.data());
    std::string common;
    put(common, 45, 2);
    put(common, file.flags, 2);
    put(common, file.method.value_or(file.isDeflated ? 8 : 0), 2);
    put(common, 0, 4);
    put(common, file.checksum.value_or(static_cast<uint32_t>(crc32(0, data, static_cast<uInt>(file.contents.size())))),
        4);
    put(common, isWide ? kSeeWide : storedSize, 4);
    put(common, isWide ? kSeeWide : size, 4);
    put(common, file.name.size(), 2);
    std::string extra;
    if (isWide) {
      put(extra, 1, 2);
      put(extra, 24, 2);
      put(extra, size, 8);
      put(extra, storedSize, 8);
      put(extra, offset, 8);
    }
    put(common, extra.size(), 2);
    put(archive, 0x04034b50, 4);
    archive += common + file.name + extra + bytes;
    put(directory, 0x02014b50, 4);
    put(directory, 45, 2);
    directory += common;
    put(directory, 0, 10);
    put(directory, isWide ? kSeeWide : offset, 4);
    directory += file.name + extra;
  }
  const uint64_t offset = archive.size();
  archive += directory;
  if (isWide) {
    const uint64_t end = archive.size();
    put(archive, 0x06064b50, 4);
    put(archive, 44, 8);
    put(archive, 45, 2);
    put(archive, 45, 2);
    put(archive, 0, 8);
    put(archive, files.size(), 8);
    put(archive, files.size(), 8);
    put(archive, directory.size(), 8);
    put(archive, offset, 8);
    put(archive, 0x07064b50, 4);
    put(archive, 0, 4);
    put(archive, end, 8);
    put(archive, 1, 4);
  }
  put(archive, 0x06054b50, 4);
  put(archive, 0, 4);
  put(archive, isWide ? 0xffff : files.size(), 2);
  put(archive, isWide ? 0xffff : files.size(), 2);
  put(archive, isWide ? kSeeWide : directory.size(), 4);
  put(archive, isWide ? kSeeWide : offset, 4);
  put(archive, comment.size(), 2);
  return archive.append(comment);
}

}  // namespace asdfvk::test
