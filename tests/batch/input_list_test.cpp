#include "batch/input_list.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "asdf_vk/error.h"
#include "cli/scratch_folder.h"

namespace asdfvk {
namespace {

using test::ScratchFolder;

InputRequest requestOf(std::vector<std::string> arguments) {
  return {.arguments = std::move(arguments), .recurses = true, .formats = {"ply", "off"}};
}

std::vector<std::pair<std::string, std::string>> pathsOf(const std::vector<InputFile>& inputs) {
  std::vector<std::pair<std::string, std::string>> paths;
  for (const InputFile& input : inputs) paths.emplace_back(input.path, input.folder);
  return paths;
}

using Paths = std::vector<std::pair<std::string, std::string>>;

TEST_CASE("the meshes below a folder are inputs in order, results and hidden files are not") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "in/b/c");
  std::filesystem::create_directories(folder / "in/.git");
  std::filesystem::create_directories(folder / "in/out");
  for (const char* name : {"in/z.off", "in/a.PLY", "in/b/c/d.off", "in/b/e.off", "in/b/e.asdf.ply", "in/.hidden.off",
                           "in/.git/f.off", "in/note.txt", "in/out/g.off", "in/h.ply.gz", "in/i.OFF.GZ",
                           "in/j.asdf.ply.gz", "in/k.asdf.l.ply", "in/notes.gz"})
    folder.write(name, "12345");
  std::filesystem::create_directory_symlink(folder / "in", folder / "in/b/loop");
  InputRequest request = requestOf({folder / "in"});
  request.outputFolder = folder / "in/out";
  const std::vector<InputFile> inputs = listInputs(request);
  CHECK_EQ(pathsOf(inputs), Paths{{folder / "in/a.PLY", ""},
                                  {folder / "in/b/c/d.off", "b/c"},
                                  {folder / "in/b/e.off", "b"},
                                  {folder / "in/h.ply.gz", ""},
                                  {folder / "in/i.OFF.GZ", ""},
                                  {folder / "in/k.asdf.l.ply", ""},
                                  {folder / "in/z.off", ""}});
  CHECK_EQ(inputs[0].byteCount, 5);
}

TEST_CASE("files are inputs as they are given, also missing ones; a folder is one only with -r") {
  const ScratchFolder folder;
  InputRequest request = requestOf({"missing.off", "-", folder / ""});
  request.recurses = false;
  CHECK_EQ(pathsOf(listInputs(request)), Paths{{"missing.off", ""}, {"-", ""}, {folder / "", ""}});
}

TEST_CASE("the outputs of a list lie below its longest common folder") {
  const ScratchFolder folder;
  InputRequest request;
  request.list = folder.write("list", "/data/x/a.off\n\n/data/x/deep/b.off\n/data/x/deep/../c.off\n");
  CHECK_EQ(pathsOf(listInputs(request)),
           Paths{{"/data/x/a.off", ""}, {"/data/x/deep/b.off", "deep"}, {"/data/x/deep/../c.off", ""}});
  request.list = folder.write("zero", std::string("/a/two\nlines.off\0/b/c.off", 25));
  request.isNullSeparated = true;
  CHECK_EQ(pathsOf(listInputs(request)), Paths{{"/a/two\nlines.off", "a"}, {"/b/c.off", "b"}});
}

TEST_CASE("a list may have a byte order mark and the line ends of Windows, but not with zero bytes") {
  const ScratchFolder folder;
  InputRequest request;
  request.list = folder.write("list",
                              "\xef\xbb\xbf/d/a.off\r\n/d/\xef\xbb\xbf"
                              "b.off\r\n");
  CHECK_EQ(pathsOf(listInputs(request)), Paths{{"/d/a.off", ""},
                                               {"/d/\xef\xbb\xbf"
                                                "b.off",
                                                ""}});
  request.isNullSeparated = true;
  request.list = folder.write("zero", "\xef\xbb\xbf/a.off");
  CHECK_EQ(listInputs(request).at(0).path, "\xef\xbb\xbf/a.off");
}

TEST_CASE("a dangling link below a folder is an input, which fails; a FIFO and a link to a folder are none") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "in/deep");
  std::filesystem::create_symlink(folder / "missing.off", folder / "in/dangling.off");
  std::filesystem::create_symlink("circle.off", folder / "in/circle.off");
  std::filesystem::create_directory_symlink(folder / "in/deep", folder / "in/folder.off");
  std::filesystem::create_symlink(folder.write("there.off", ""), folder / "in/link.off");
  REQUIRE_EQ(mkfifo((folder / "in/fifo.off").c_str(), 0600), 0);
  CHECK_EQ(pathsOf(listInputs(requestOf({folder / "in"}))),
           Paths{{folder / "in/circle.off", ""}, {folder / "in/dangling.off", ""}, {folder / "in/link.off", ""}});
}

TEST_CASE("the lines of a list may end as on Windows, names with -0 end as they do") {
  const ScratchFolder folder;
  InputRequest request;
  request.list = folder.write("list", "/x/a.off\r\n\r\n/x/b.off");
  CHECK_EQ(pathsOf(listInputs(request)), Paths{{"/x/a.off", ""}, {"/x/b.off", ""}});
  request.list = folder.write("zero", std::string("/x/a.off\r\0", 10));
  request.isNullSeparated = true;
  CHECK_EQ(pathsOf(listInputs(request)), Paths{{"/x/a.off\r", ""}});
}

TEST_CASE("a line may have a key, whose folders are those of the outputs; with -0 a tab is part of the path") {
  const ScratchFolder folder;
  InputRequest request;
  request.list =
      folder.write("list", "/x/a.off\tpart-7\r\n/y/deep/a.off\tb/c/v1.2\n/z/e.off\n/z/deep/f.off\n/x/a.off\tagain");
  const std::vector<InputFile> inputs = listInputs(request);
  // The common folder is that of the paths without a key.
  CHECK_EQ(
      pathsOf(inputs),
      Paths{{"/x/a.off", ""}, {"/y/deep/a.off", "b/c"}, {"/z/e.off", ""}, {"/z/deep/f.off", "deep"}, {"/x/a.off", ""}});
  CHECK_EQ(inputs[0].key, "part-7");
  CHECK_EQ(inputs[1].key, "b/c/v1.2");
  CHECK_EQ(inputs[2].key, "");
  request.list = folder.write("zero", std::string("/x/a\tb.off\0", 11));
  request.isNullSeparated = true;
  CHECK_EQ(listInputs(request).at(0).path, "/x/a\tb.off");
}

TEST_CASE("an unsafe key, a key without a path and a key of two lines are errors with the line") {
  const ScratchFolder folder;
  const auto messageOf = [&](const std::string& text) {
    InputRequest request;
    request.list = folder.write("list", text);
    try {
      (void)listInputs(request);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::UnreadableInput);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_EQ(messageOf("a.off\tx\n\nb.off\t../x\n"),
           folder / "list" + ": line 3: the key '../x' is not a name such as part-7 or b/part-7: it has the part '..'");
  for (const char* key : {"/x", "x/../y", "./x", "x/.", "x//y", "x/", ".", "..", "", "x\ty", "x\x01", "caf\xe9"})
    CHECK_MESSAGE(messageOf("a.off\t" + std::string(key)).find("line 1: the key '") != std::string::npos, key);
  for (const char* key : {"x", ".x", "..x", "x..y/z.", "caf\xc3\xa9", "a b"})
    CHECK_EQ(messageOf("a.off\t" + std::string(key)), "accepted");
  CHECK_EQ(messageOf("\n\tx"), folder / "list" + ": line 2: there is no path before the key 'x'");
  CHECK_EQ(messageOf("a.off\tx\nb.off\nc.off\tx"),
           folder / "list" + ": lines 1 and 3 have the same key 'x'; give each mesh its own key");
}

TEST_CASE("a list that cannot be read is an error") {
  const ScratchFolder folder;
  for (const std::string& list : {folder / "missing", folder / ""}) {
    InputRequest request;
    request.list = list;
    CHECK_THROWS_AS((void)listInputs(request), Error);
  }
}

}  // namespace
}  // namespace asdfvk
