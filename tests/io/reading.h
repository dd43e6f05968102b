#pragma once

#include <doctest/doctest.h>
#include <zlib.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "io/formats.h"

namespace asdfvk::test {

/// The text as a gzip file.
inline std::string gzipped(std::string_view text) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

/// ASCII text as UTF-16 with a byte order mark.
inline std::string utf16(std::string_view text, bool isBig) {
  std::string bytes = isBig ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) {
    const char units[] = {isBig ? '\0' : c, isBig ? c : '\0'};
    bytes.append(units, 2);
  }
  return bytes;
}

/// The mesh that the reader of the format makes of the text.
inline Mesh parse(std::string_view format, std::string_view text) {
  return formatOfExtension(format)->parseMesh({.bytes = std::span(text.data(), text.size())});
}

/// The message of the Error{UnreadableInput} that parsing throws; "no error" without one.
inline std::string errorOf(std::string_view format, std::string_view text) {
  try {
    static_cast<void>(parse(format, text));
  } catch (const Error& error) {
    return error.kind() == ErrorKind::Input ? error.what() : "an error of another kind";
  }
  return "no error";
}

/// The corners of a unit square, as lines of text that each begin with `prefix` and end with `suffix`, and as points.
inline std::string squareCorners(std::string_view prefix = "", std::string_view suffix = "") {
  std::string text;
  for (const char* corner : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"})
    text.append(prefix).append(corner).append(suffix).append("\n");
  return text;
}
inline const std::vector<Vec3d> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

inline bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// Reads a file of a corpus. Checks that it is refused in one line with the reason, or read where the reason is empty.
inline std::optional<Mesh> readAsExpected(const std::filesystem::path& path, std::string_view reason) {
  std::string message;
  std::optional<Mesh> read;
  try {
    read = readMesh(path);
  } catch (const Error& thrown) {
    CHECK(thrown.kind() == ErrorKind::Input);
    message = thrown.what();
  }
  CAPTURE(message);
  CHECK(message.empty() == reason.empty());
  CHECK(holds(message, reason));
  if (!message.empty()) CHECK(message.starts_with(path.string() + ": "));
  CHECK(message.find('\n') == std::string::npos);
  return read;
}

}  // namespace asdfvk::test
