#include "batch/tar_feed.h"

#include <doctest/doctest.h>
#include <poll.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <utility>

#include "asdf_vk/error.h"
#include "batch/content_hash.h"
#include "batch/tar_names.h"
#include "cli/scratch_folder.h"

namespace asdfvk {
namespace {

using test::ScratchFolder;
using Kind = TarItem::Kind;
using NamedBytes = std::vector<std::pair<std::string, std::string>>;

std::string writeTar(const ScratchFolder& folder, const std::string& name, const NamedBytes& members) {
  TarWriter writer(folder / name);
  for (const auto& [member, bytes] : members) {
    writer.begin({.name = member, .byteCount = bytes.size()});
    writer.write(bytes);
  }
  writer.commit();
  return folder / name;
}

/// Takes items as they arrive, and releases each when `keptCount` later items were taken.
std::vector<TarItem> itemsOf(TarFeed& feed, size_t keptCount = 0) {
  std::vector<TarItem> items;
  size_t releasedCount = 0;
  while (!feed.isEnded()) {
    pollfd polled{feed.descriptor(), POLLIN, 0};
    REQUIRE_EQ(::poll(&polled, 1, 60'000), 1);
    while (std::optional<TarItem> item = feed.take()) items.push_back(std::move(*item));
    for (; releasedCount + keptCount < items.size(); ++releasedCount) feed.release(items[releasedCount].bytes.size());
  }
  return items;
}

std::string reasonOf(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a key is the name up to the first dot of its last part") {
  const std::map<std::string, std::string> keys{{"0001.ply", "0001"},
                                                {"a/b.c/0001.mesh.ply", "a/b.c/0001"},
                                                {"./1.stl.gz", "./1"},
                                                {"none", "none"},
                                                {"a.b/.hidden.ply", "a.b/"}};
  for (const auto& [name, key] : keys) CHECK_EQ(sampleKeyOf(name), key);
  for (const char* name : {"a.ply", "b/A.STL", "a.mesh.obj", "a.stl.gz"}) CHECK_MESSAGE(isMeshMember(name), name);
  for (const char* name : {"a.png", "a.npy", "a", ".ply", "b/.a.ply", "a.asdf.ply", "a.asdf.ply.gz", "ply", "a."})
    CHECK_FALSE_MESSAGE(isMeshMember(name), name);
  for (const char* name : {"a.ply", "./a", "a..b/c", "..a", "a/"}) CHECK_MESSAGE(isSafeMember(name), name);
  for (const char* name : {"", "/a", "..", "../a", "a/../b", "a/.."}) CHECK_FALSE_MESSAGE(isSafeMember(name), name);
}

TEST_CASE("members of several tars become items in their order") {
  const ScratchFolder folder;
  const std::string first = writeTar(folder, "a.tar", {{"x.ply", "mesh"}, {"x.txt", "text"}, {"x.stl", "other"}}),
                    second = writeTar(folder, "b.tar.gz", {{"x.ply", ""}});
  for (const bool copies : {false, true}) {
    TarFeed feed({.paths = {first, folder / "none.tar", second}, .copiesMembers = copies}, {});
    std::vector<std::pair<Kind, size_t>> found;
    std::vector<std::string> stems, bytes;
    const std::vector<TarItem> items = itemsOf(feed);
    for (const TarItem& item : items) {
      found.emplace_back(item.kind, item.tar);
      if (item.kind == Kind::Mesh) stems.push_back(item.stem);
      bytes.push_back(item.bytes);
    }
    using Found = std::vector<std::pair<Kind, size_t>>;
    const Found without{{Kind::Begin, 0}, {Kind::Mesh, 0},  {Kind::Mesh, 0}, {Kind::End, 0}, {Kind::Begin, 1},
                        {Kind::End, 1},   {Kind::Begin, 2}, {Kind::Mesh, 2}, {Kind::End, 2}};
    const Found with{{Kind::Begin, 0}, {Kind::Copy, 0}, {Kind::Mesh, 0}, {Kind::Copy, 0},  {Kind::Piece, 0},
                     {Kind::Copy, 0},  {Kind::Mesh, 0}, {Kind::End, 0},  {Kind::Begin, 1}, {Kind::End, 1},
                     {Kind::Begin, 2}, {Kind::Copy, 2}, {Kind::Mesh, 2}, {Kind::End, 2}};
    CHECK(found == (copies ? with : without));
    using Texts = std::vector<std::string>;
    CHECK_EQ(stems, copies ? Texts{"x.asdf", "x.stl.asdf", "x.asdf"} : Texts{"x", "x.stl", "x"});
    if (copies) CHECK_EQ(bytes, Texts{"", "mesh", "mesh", "", "text", "other", "other", "", "", "", "", "", "", ""});
    const size_t end = copies ? 7 : 3;
    CHECK_EQ(items[end].hash, contentHashOf(first));
    CHECK_NE(reasonOf(items[end + 2].failure).find("none.tar: cannot be opened"), std::string::npos);
    CHECK_EQ(items.back().hash, contentHashOf(second));
  }
}

TEST_CASE("the window limits the members and bytes in memory") {
  constexpr size_t kMeshBytes = 1000;
  const ScratchFolder folder;
  NamedBytes members;
  for (size_t i = 0; i < 500; ++i) members.emplace_back(std::to_string(i) + ".stl", std::string(kMeshBytes, 'x'));
  members.emplace_back("big.stl", std::string(20 * kMeshBytes, 'x'));
  members.emplace_back("big.bin", std::string(size_t{5} << 20, 'x'));
  const std::string tar = writeTar(folder, "a.tar", members);
  for (const bool copies : {false, true}) {
    TarFeed byCount({.paths = {tar}, .copiesMembers = copies, .maxItems = 16}, {});
    CHECK_EQ(itemsOf(byCount, 15).size(), copies ? 1010 : 503);
    CHECK_EQ(byCount.greatestItemCount(), 16);
    TarFeed byBytes({.paths = {tar}, .copiesMembers = copies, .maxBytes = 10 * kMeshBytes}, {});
    CHECK_EQ(itemsOf(byBytes).size(), copies ? 1010 : 503);
    CHECK_GE(byBytes.greatestByteCount(), 20 * kMeshBytes);  // A greater one is alone.
    CHECK_LE(byBytes.greatestByteCount(), std::max(20 * kMeshBytes, copies ? size_t{1} << 20 : 0));
  }
  SUBCASE("without releases, the thread waits, and the owner can go") {
    TarFeed feed({.paths = {tar}, .maxItems = 8}, {});
    std::vector<TarItem> items;
    const auto begin = std::chrono::steady_clock::now();
    while (items.size() < 8 && std::chrono::steady_clock::now() - begin < std::chrono::minutes(1)) {
      if (std::optional<TarItem> item = feed.take()) items.push_back(std::move(*item));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK_FALSE(feed.take());
    CHECK_FALSE(feed.isEnded());
    feed.replaceBytes(items[1].bytes.size(), 0);
    feed.release(0);
    pollfd polled{feed.descriptor(), POLLIN, 0};
    CHECK_EQ(::poll(&polled, 1, 60'000), 1);
    CHECK(feed.take());
  }
}

TEST_CASE("members that are not computed have a reason") {
  const ScratchFolder folder;
  const std::string path = folder / "a.tar";
  {
    TarWriter writer(path);
    writer.begin({.name = "link.ply", .kind = TarMember::Kind::SymbolicLink, .target = "b.ply"});
    writer.begin({.name = "hard.ply", .kind = TarMember::Kind::HardLink, .target = "b.ply"});
    for (const char* name : {"../up.ply", "a.ply", "a.ply", "big.ply"}) {
      const std::string bytes(std::string(name) == "big.ply" ? 200 : 10, 'x');
      writer.begin({.name = name, .byteCount = bytes.size()});
      writer.write(bytes);
    }
    writer.begin({.name = "folder.ply", .kind = TarMember::Kind::Folder});
    writer.commit();
  }
  TarFeed feed({.paths = {path}, .maxMeshBytes = 100}, {});
  std::map<std::string, std::string> reasons;
  size_t meshCount = 0;
  for (const TarItem& item : itemsOf(feed)) {
    if (item.kind == Kind::Failed) reasons[item.member.name] = item.stem + ": " + reasonOf(item.failure);
    meshCount += item.kind == Kind::Mesh ? 1 : 0;
  }
  CHECK_EQ(meshCount, 1);
  const std::map<std::string, std::string> expected{
      {"link.ply", "link: is a link to b.ply; tar --dereference --hard-dereference packs the file"},
      {"hard.ply", "hard: is a link to b.ply; tar --dereference --hard-dereference packs the file"},
      {"../up.ply", ": its name leads out of the folder of the tar; give it a relative name without .."},
      {"a.ply", ": its name occurs twice in the tar; rename one"},
      {"big.ply", "big: has 200 bytes; a mesh in a tar may have 100; compute it as a file of its own"}};
  CHECK_EQ(reasons, expected);
}

TEST_CASE("a damaged tar ends with a failure after its complete members") {
  const ScratchFolder folder;
  const std::string whole = folder.read(
      std::filesystem::path(writeTar(folder, "a.tar", {{"a.ply", std::string(600, 'a')}, {"b.ply", "b"}})).filename());
  REQUIRE_EQ(whole.size(), 512 + 1024 + 512 + 512 + 1024);
  const auto endOf = [&](const std::string& bytes) {
    TarFeed feed({.paths = {folder.write("bad.tar", bytes)}}, {});
    const std::vector<TarItem> items = itemsOf(feed);
    REQUIRE(items.back().kind == Kind::End);
    const std::string reason = items.back().failure ? reasonOf(items.back().failure) : "";
    const std::string prefix = folder / "bad.tar" + ": ";
    CHECK(reason.empty() == !items.back().failure);
    return std::pair(items.size() - 2, reason.empty() ? reason : reason.substr(prefix.size()));
  };
  for (size_t size = 0; size < whole.size(); size += 128) {
    const auto end = endOf(whole.substr(0, size));
    CAPTURE(size);
    CHECK_EQ(end.first, size < 512 + 600 ? 0 : size < 2048 + 1 ? 1 : 2);
    CHECK_EQ(end.second.empty(), size == 2560 + 512);  // One of the two blocks of the end is enough.
  }
  CHECK_EQ(endOf(whole).second, "");
  CHECK_EQ(endOf(whole + whole).first, 4);
  CHECK_EQ(endOf(whole + whole).second, "");
  CHECK(endOf(std::string(5000, 'x')).second.starts_with("is not a tar, or is damaged at its beginning"));
  CHECK(
      endOf(whole + std::string(2000, 'x')).second.starts_with("is damaged or truncated at or after its member b.ply"));
  std::string bad = whole;
  bad[512 + 1024 + 10] = 'x';  // The checksum of the second header is now wrong.
  CHECK(endOf(bad).second.starts_with("is damaged or truncated at or after its member a.ply"));
}

TEST_CASE("a tar keeps the bytes of names, times and permissions, and appears when it is complete") {
  const ScratchFolder folder;
  const std::string name = std::string(200, 'd') + "/" + std::string(200, 'n') + "\xff\n\xc3\xa4.txt";
  for (const char* file : {"a.tar", "a.tar.gz", "a.tar.zst"}) {
    TarWriter writer(folder / file);
    writer.begin({.name = name, .byteCount = 3, .time = 1'700'000'000, .permissions = 0600});
    writer.write("a");
    writer.write("bc");
    CHECK_FALSE(std::filesystem::exists(folder / file));
    writer.commit();
    TarReader reader(folder / file, {});
    const std::optional<TarMember> member = reader.next();
    REQUIRE(member);
    CHECK_EQ(member->name, name);
    CHECK_EQ(member->time, 1'700'000'000);
    CHECK_EQ(member->permissions, 0600);
    std::string bytes(10, ' ');
    CHECK_EQ(reader.read(bytes.data(), bytes.size()), 3);
    CHECK_EQ(bytes.substr(0, 3), "abc");
    CHECK_FALSE(reader.next());
    CHECK_EQ(reader.hash(), contentHashOf(folder / file));
  }
  {
    TarWriter writer(folder / "b.tar");
    writer.begin({.name = "x", .byteCount = 3});
    writer.write("a");
    writer.abandon();
  }
  CHECK_EQ(folder.names(), std::vector<std::string>{"a.tar", "a.tar.gz", "a.tar.zst"});
  CHECK_THROWS_AS(TarWriter(folder / "none/a.tar"), Error);
}

}  // namespace asdfvk
