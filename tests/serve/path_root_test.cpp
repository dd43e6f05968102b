#include "serve/path_root.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "cli/scratch_folder.h"
#include "support/require_failure.h"

namespace asdfvk::test {

namespace fs = std::filesystem;

TEST_CASE("without a folder every file is allowed, except the standard streams") {
  const PathRoot all;
  CHECK_EQ(all.resolved("../a/b.stl", ErrorCode::UnreadableInput), "../a/b.stl");
  requireFailure([&] { (void)all.resolved("-", ErrorCode::UnreadableInput); }, ErrorCode::UnreadableInput, "streams");
  requireFailure([&] { (void)all.resolved(std::string("a\0b", 3), ErrorCode::OutputNotWritable); },
                 ErrorCode::OutputNotWritable, "zero byte");
}

TEST_CASE("a folder allows files below it only") {
  const ScratchFolder folder;
  fs::create_directories(folder / "root/deep");
  fs::create_directories(folder / "root-beside");
  folder.write("secret.stl", "solid");
  folder.write("root/part.stl", "solid");
  const std::string root = fs::canonical(folder / "root").string();
  fs::create_symlink("../secret.stl", folder / "root/link.stl");
  fs::create_symlink("../missing.ply", folder / "root/dangling.ply");
  fs::create_symlink(folder / "root-beside", folder / "root/folder");
  fs::create_symlink("part.stl", folder / "root/inner.stl");
  const PathRoot allowed(folder / "root");
  CHECK_EQ(allowed.folder().string(), root);
  const auto resolved = [&](const std::string& path) { return allowed.resolved(path, ErrorCode::UnreadableInput); };
  CHECK_EQ(resolved("part.stl"), root + "/part.stl");
  CHECK_EQ(resolved("deep/../part.stl"), root + "/part.stl");
  CHECK_EQ(resolved("inner.stl"), root + "/part.stl");
  CHECK_EQ(resolved("new/file.ply"), root + "/new/file.ply");
  CHECK_EQ(resolved(root + "/part.stl"), root + "/part.stl");
  for (const std::string path : {"../secret.stl", "deep/../../secret.stl", "link.stl", "dangling.ply", "folder/new.ply",
                                 "missing/../../secret.stl", "/etc/passwd", "..", "../root-beside/a.stl"}) {
    CAPTURE(path);
    requireFailure([&] { (void)resolved(path); }, ErrorCode::UnreadableInput, "is outside of");
  }
  requireFailure([&] { (void)allowed.resolved("../a.ply", ErrorCode::OutputNotWritable); },
                 ErrorCode::OutputNotWritable);
}

TEST_CASE("the folder must exist") {
  const ScratchFolder folder;
  folder.write("file", "");
  requireFailure([&] { const PathRoot root(folder / "missing"); }, ErrorCode::UnreadableInput, "--root");
  requireFailure([&] { const PathRoot root(folder / "file"); }, ErrorCode::UnreadableInput, "--root");
}

}  // namespace asdfvk::test
