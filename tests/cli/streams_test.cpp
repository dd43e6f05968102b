#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

ChildOptions withInput(const std::string& bytes) {
  ChildOptions options;
  options.input = bytes;
  return options;
}

ChildOptions withOutputFile(const std::string& file) {
  ChildOptions options;
  options.outputFile = file;
  return options;
}

TEST_CASE("a mesh comes from standard input in every format and goes to standard output") {
  for (const std::string& bytes : {cubeAsciiPly(), cubeBinaryPly(), cubeOff(), cubeObj(), cubeBinaryStl()}) {
    const ChildOutcome outcome =
        runAsdf({"-", "-o", "-", "--format", "csv", "--backend", "reference", "--quiet"}, withInput(bytes));
    INFO(bytes.substr(0, 10) << ": " << outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    const std::vector<std::string> lines = linesOf(outcome.output);
    REQUIRE_EQ(lines.size(), 13);
    CHECK_EQ(lines[0], "face,sdf,seed");
  }
}

TEST_CASE("standard output takes the bytes that a file would get") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.ply", cubeAsciiPly());
  for (const std::string format : {"ply", "vtu", "npy", "csv"}) {
    const std::vector<std::string> common{mesh, "--backend", "reference", "--quiet", "--format", format, "-o"};
    std::vector<std::string> toFile = common, toStream = common;
    toFile.push_back(folder / ("out." + format));
    toStream.push_back("-");
    CHECK_EQ(runAsdf(toFile).exitCode, 0);
    const ChildOutcome outcome = runAsdf(toStream);
    CHECK_EQ(outcome.exitCode, 0);
    CHECK_FALSE(outcome.output.empty());
    CHECK(outcome.output == folder.read("out." + format));
  }
}

TEST_CASE("an empty standard input is an unreadable mesh") {
  const ScratchFolder folder;
  checkFailure(runAsdf({"-", "-o", folder / "out.ply", "--quiet", "--backend", "reference"}), 2, "");
  CHECK(folder.names().empty());
}

TEST_CASE("a full disk behind standard output ends with 4") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOptions full = withOutputFile("/dev/full");
  checkFailure(runAsdf({mesh, "--json", "--quiet", "--backend", "reference"}, full), 4, "standard output");
  checkFailure(runAsdf({mesh, "-o", "-", "--quiet", "--backend", "reference"}, full), 4, "standard output");
  checkFailure(runAsdf({"--help"}, full), 4, "standard output");
  checkFailure(runAsdf({"--version"}, full), 4, "standard output");
}

TEST_CASE("a reader that went away ends with 4 and not with a signal") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  // The sleep lets `true` end before the report is written.
  const ChildOutcome json = runChild(
      "/bin/sh", {"-c", "{ sleep 0.3; \"$0\" \"$1\" --quiet --backend reference --json; echo code $? >&2; } | true",
                  ASDFVK_PROGRAM, mesh});
  CHECK(json.error.find("Broken pipe") != std::string::npos);
  CHECK(json.error.find("code 4") != std::string::npos);
}

TEST_CASE("a standard output that the caller closed ends with 4") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome =
      runChild("/bin/sh",
               {"-c", "\"$0\" \"$1\" --quiet --backend reference --json >&-; echo code $? >&2", ASDFVK_PROGRAM, mesh});
  CHECK(outcome.error.find("code 4") != std::string::npos);
  CHECK_EQ(folder.read("cube.off"), cubeOff());
}

}  // namespace
}  // namespace asdfvk::test
