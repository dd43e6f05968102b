#include "io/zip_archive.h"

#include <doctest/doctest.h>

#include <span>

#include "asdf_vk/error.h"
#include "made_archive.h"

using namespace asdfvk;
using test::ArchivedFile;
using test::madeArchive;

namespace {

/// The contents of a file of the archive, or the error.
std::string contentsIn(std::string_view bytes, std::string_view name) {
  try {
    const ZipArchive archive(std::span(bytes.data(), bytes.size()));
    const ZipEntry* const entry = archive.find(name);
    if (entry == nullptr) return "no such file";
    ZipStream stream(archive, *entry);
    std::string contents, piece(7, '\0');
    for (size_t count = piece.size(); count == piece.size();) {
      count = stream.read(piece.data(), piece.size());
      contents.append(piece, 0, count);
    }
    return contents;
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::UnreadableInput);
    return std::string("error: ") + error.what();
  }
}

const std::string kLongText(1000, 'x');
const std::vector<ArchivedFile> kTwoFiles{{.name = "a/First", .contents = "of the stored"},
                                          {.name = "b.txt", .contents = kLongText, .isDeflated = true}};

}  // namespace

TEST_CASE("a ZIP archive gives its stored and deflated files, also with ZIP64 and with a comment") {
  for (const bool isWide : {false, true})
    for (const std::string_view comment : {"", "a comment with PK\5\6 in it"}) {
      CAPTURE(isWide);
      CAPTURE(comment);
      const std::string bytes = madeArchive(kTwoFiles, comment, isWide);
      CHECK(contentsIn(bytes, "a/First") == "of the stored");
      CHECK(contentsIn(bytes, "b.txt") == kLongText);
      CHECK(contentsIn(bytes, "c") == "no such file");
    }
  CHECK(contentsIn(madeArchive({}), "a") == "no such file");
  CHECK(contentsIn(madeArchive({{.name = "empty", .contents = ""}}), "empty") == "");
}

TEST_CASE("names of a ZIP archive are compared as part names") {
  const std::string bytes =
      madeArchive({{.name = "3D\\My Part.Model", .contents = "1"}, {.name = "a%20b", .contents = "2"}});
  for (const char* const name : {"3D/My Part.Model", "/3d/my%20part.model", "3D\\My Part.Model"})
    CHECK(contentsIn(bytes, name) == "1");
  CHECK(contentsIn(bytes, "a b") == "2");
  CHECK(contentsIn(bytes, "3D/My%2Part.Model") == "no such file");
  CHECK(partName("/A%2fb%zz%4") == "a/b%zz%4");
}

TEST_CASE("a name that two files of a ZIP archive have is refused, but not other names") {
  for (const char* const second : {"a.txt", "A.TXT", "/a.txt", "%61.txt"}) {
    CAPTURE(second);
    const std::string bytes = madeArchive(
        {{.name = "a.txt", .contents = "1"}, {.name = second, .contents = "2"}, {.name = "b", .contents = "3"}});
    CHECK(contentsIn(bytes, "a.txt") == "error: ZIP archive: 2 files have the name 'a.txt'");
    CHECK(contentsIn(bytes, "b") == "3");
  }
}

TEST_CASE("a damaged or hostile file of a ZIP archive is refused with the reason") {
  const auto errorOf = [](const ArchivedFile& file) { return contentsIn(madeArchive({file}), file.name); };
  const std::string damaged = "error: ZIP archive: 'a' is damaged: its size or checksum differs";
  CHECK(errorOf({.name = "a", .contents = "1", .flags = 1}) ==
        "error: ZIP archive: 'a' is encrypted, or compressed by a method other than deflate");
  CHECK(errorOf({.name = "a", .contents = "1", .method = 12}) ==
        "error: ZIP archive: 'a' is encrypted, or compressed by a method other than deflate");
  for (const bool isDeflated : {false, true}) {
    CAPTURE(isDeflated);
    const std::string text = "several bytes";
    CHECK(errorOf({.name = "a", .contents = text, .isDeflated = isDeflated, .checksum = 1}) == damaged);
    CHECK(errorOf({.name = "a", .contents = text, .isDeflated = isDeflated, .size = 14}) == damaged);
    CHECK(errorOf({.name = "a", .contents = text, .isDeflated = isDeflated, .size = 12}) ==
          "error: ZIP archive: 'a' is larger than its directory entry says");
  }
  CHECK(errorOf({.name = "a", .contents = "several bytes", .storedSize = 5}) == damaged);
  CHECK(errorOf({.name = "a", .contents = "several bytes", .storedSize = 500}) ==
        "error: ZIP archive: 'a' overlaps other content");
  CHECK(errorOf({.name = "a", .contents = "\7is no deflated text", .method = 8}) ==
        "error: ZIP archive: 'a' is damaged");
  CHECK(errorOf({.name = "a", .contents = "", .method = 8}) == "error: ZIP archive: 'a' is damaged");
  CHECK(errorOf({.name = "a", .contents = "1", .offset = 3}) == "error: ZIP archive: 'a' overlaps other content");
}

TEST_CASE("files of a ZIP archive must not share bytes") {
  std::vector<ArchivedFile> files = kTwoFiles;
  files.push_back({.name = "again", .contents = "", .size = 13, .storedSize = 13, .offset = 0});
  CHECK(contentsIn(madeArchive(files), "b.txt") == "error: ZIP archive: 'a/First' overlaps other content");
}

TEST_CASE("bytes before a ZIP archive are refused") {
  CHECK(contentsIn("#!/bin/sh\n" + madeArchive(kTwoFiles), "b.txt").starts_with("error: ZIP archive"));
}

TEST_CASE("a ZIP archive that is cut at any byte is refused") {
  for (const bool isWide : {false, true}) {
    const std::string bytes = madeArchive(kTwoFiles, "", isWide);
    for (size_t size = 0; size < bytes.size(); ++size) {
      CAPTURE(size);
      CHECK(contentsIn(std::string_view(bytes).substr(0, size), "b.txt").starts_with("error: "));
    }
  }
}

TEST_CASE("bytes after the end of a ZIP archive are counted") {
  for (const std::string_view comment : {"", "comment"})
    for (const size_t count : {size_t{1}, size_t{30}, size_t{65535 - 7}}) {
      CAPTURE(count);
      const std::string bytes = madeArchive(kTwoFiles, comment) + std::string(count, '\n');
      CHECK(contentsIn(bytes, "b.txt") == kLongText);
      CHECK(ZipArchive(bytes).trailingByteCount() == count);
    }
  CHECK(contentsIn(madeArchive(kTwoFiles) + std::string(65536, '\n'), "b.txt")
            .starts_with("error: ZIP archive is trunc"));
}

TEST_CASE("a changed byte of a ZIP archive never gives other contents") {
  const std::string good = madeArchive(kTwoFiles, "comment");
  for (size_t at = 0; at < good.size(); ++at)
    for (const char change : {'\1', '\x80', '\xff'}) {
      CAPTURE(at);
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      const std::string found = contentsIn(bytes, "b.txt");
      const bool isRight = found == kLongText || found == "no such file" || found.starts_with("error: ");
      CHECK(isRight);
    }
}
