#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <thread>

#include "asdf_vk/error.h"
#include "core/abandoned_files.h"
#include "core/atomic_file.h"
#include "core/unfinished_files.h"
#include "written_file.h"

using namespace asdfvk;

namespace {

ErrorKind kindOf(const std::function<void()>& action, std::string& message) {
  try {
    action();
  } catch (const Error& error) {
    message = error.what();
    return error.kind();
  }
  FAIL("no error");
  return ErrorKind::Cancelled;
}

void writeTo(const std::filesystem::path& path, const std::string& content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

void checkRefused(const std::filesystem::path& path, const std::string& reason) {
  std::string message;
  CHECK(kindOf([&] { writeTo(path, "text"); }, message) == ErrorKind::Output);
  CAPTURE(message);
  CHECK(message.find(path.string()) != std::string::npos);
  CHECK(message.find(reason) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

/// Starts a process that ends while it writes a file of the folder. Returns its id; the caller waits for it.
pid_t leaveTemporaryIn(const Folder& folder) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    AtomicFile file(folder / "out.ply");
    file.write(std::string(3'000'000, 'x'));
    ::_exit(0);
  }
  return child;
}

}  // namespace

TEST_CASE("a committed file contains the written bytes, also beyond the buffer size, and no other file is left") {
  const Folder folder;
  std::string large;
  for (int i = 0; i < 1'000'000; ++i) large += std::to_string(i);
  writeTo(folder / "out.bin", large);
  CHECK(contentOf(folder / "out.bin") == large);
  CHECK(folder.names() == std::vector<std::string>{"out.bin"});
}

TEST_CASE("without a commit the old file stays and the temporary goes") {
  const Folder folder;
  putContent(folder / "out.ply", "old");
  {
    AtomicFile file(folder / "out.ply");
    file.write(std::string(3'000'000, 'x'));
    CHECK(folder.names().size() == 2);
  }
  CHECK(contentOf(folder / "out.ply") == "old");
  CHECK(folder.names() == std::vector<std::string>{"out.ply"});
}

TEST_CASE("of two files both are replaced, or none is left half") {
  const Folder folder;
  const auto writeBoth = [&] {
    AtomicFiles files;
    files.write(folder / "out.mtl", [](AtomicFile& file) { file.write("colours"); });
    files.write(folder / "out.obj", [](AtomicFile& file) { file.write("faces"); });
    CHECK(!std::filesystem::exists(folder / "out.mtl"));
    files.commit();
  };
  writeBoth();
  CHECK(contentOf(folder / "out.mtl") == "colours");
  CHECK(contentOf(folder / "out.obj") == "faces");
  for (const std::string& name : folder.names()) std::filesystem::remove(folder / name);
  const auto writeInto = [&] {
    AtomicFiles files;
    files.write(folder / "out.mtl", [](AtomicFile&) {});
    files.write(folder / "out.obj", [](AtomicFile&) {});
    std::filesystem::create_directory(folder / "out.obj");  // No file can be renamed to it.
    files.commit();
  };
  std::string message;
  CHECK(kindOf(writeInto, message) == ErrorKind::Output);
  CHECK(folder.names() == std::vector<std::string>{"out.obj"});
  std::filesystem::remove(folder / "out.obj");
  putContent(folder / "out.mtl", "old");
  CHECK(kindOf(writeInto, message) == ErrorKind::Output);
  CHECK(std::filesystem::exists(folder / "out.mtl"));
}

TEST_CASE("a write that the system refuses leaves the old file and no temporary") {
  const Folder folder;
  putContent(folder / "out.ply", "old");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100'000, before.rlim_max};
  const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  const ErrorKind kind = kindOf([&] { writeTo(folder / "out.ply", std::string(5'000'000, 'x')); }, message);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, oldHandler);
  CHECK(kind == ErrorKind::Output);
  CHECK(message.find("File too large") != std::string::npos);
  CHECK(contentOf(folder / "out.ply") == "old");
  CHECK(folder.names() == std::vector<std::string>{"out.ply"});
}

TEST_CASE("a missing folder, a folder as target, an empty name and a file as folder are reported with their reason") {
  const Folder folder;
  putContent(folder / "file", "");
  checkRefused(folder / "missing/out.ply", "create it first");
  checkRefused(folder.path(), "Is a directory");
  checkRefused((folder / "missing").string() + "/", "Is a directory");
  checkRefused(folder / "file/out.ply", "Not a directory");
  checkRefused("", "name of the result file is empty");
}

TEST_CASE("a read-only folder and a read-only file are refused") {
  if (::geteuid() == 0) {
    MESSAGE("skipped: root may write everywhere");
    return;
  }
  const Folder folder;
  putContent(folder / "out.ply", "old");
  ::chmod((folder / "out.ply").c_str(), 0444);
  checkRefused(folder / "out.ply", "Permission denied");
  ::chmod(folder.path().c_str(), 0555);
  checkRefused(folder / "new.ply", "Permission denied");
  ::chmod(folder.path().c_str(), 0755);
}

TEST_CASE("a full disk is reported") { checkRefused("/dev/full", "No space left on device"); }

TEST_CASE("a file that is replaced keeps its mode, and a symbolic link stays one") {
  const Folder folder;
  putContent(folder / "real.csv", "old");
  ::chmod((folder / "real.csv").c_str(), 0640);
  std::filesystem::create_symlink("real.csv", folder / "link.csv");
  writeTo(folder / "link.csv", "new");
  CHECK(std::filesystem::is_symlink(folder / "link.csv"));
  CHECK(contentOf(folder / "real.csv") == "new");
  struct stat status {};
  ::stat((folder / "real.csv").c_str(), &status);
  CHECK((status.st_mode & 07777) == 0640);
}

TEST_CASE("a FIFO is written into, not replaced") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = contentOf(folder / "pipe"); });
  writeTo(folder / "pipe", "through");
  reader.join();
  CHECK(read == "through");
  CHECK(std::filesystem::is_fifo(folder / "pipe"));
  writeTo("/dev/null", "gone");
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("temporary files of a killed process are removed, those of running processes and other files are not") {
  const Folder folder;
  const pid_t first = leaveTemporaryIn(folder);
  REQUIRE(::waitpid(first, nullptr, 0) == first);
  REQUIRE(folder.names().size() == 1);
  const std::string left = folder.names().front(), host = left.substr(0, left.rfind('-', left.rfind('-') - 1) + 1);
  putContent(folder / (host + "1-0.part"), "of process 1, which runs");
  putContent(folder / ".asdf-vk-another.host-999999999-0.part", "of another host");
  putContent(folder / ".asdf-vk-x.part", "of no process");
  {
    AtomicFile file(folder / "other.ply");
    file.write(std::string(3'000'000, 'x'));
    removeAbandonedFiles(folder.path());
    CHECK(folder.names().size() == 4);
    file.commit();
  }
  const pid_t killed = leaveTemporaryIn(folder);
  REQUIRE(::waitpid(killed, nullptr, 0) == killed);
  removeFilesOfProcess(folder.path(), killed + 1);
  CHECK(folder.names().size() == 5);
  removeFilesOfProcess(folder.path(), killed);
  CHECK(folder.names().size() == 4);
  removeAbandonedFiles(folder / "missing");
}

TEST_CASE("the temporary file of a killed process is removed, also before its parent has waited for it") {
  const Folder folder;
  const pid_t child = leaveTemporaryIn(folder);
  siginfo_t info{};
  REQUIRE(::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) == 0);
  CHECK(folder.names().size() == 1);
  removeAbandonedFiles(folder.path());
  CHECK(folder.names().empty());
  REQUIRE(::waitpid(child, nullptr, 0) == child);
}

TEST_CASE("a process that ends at once removes its unfinished files and no other") {
  const Folder folder;
  const auto endAtOnce = [](const std::function<void()>& work) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      work();
      ::_exit(1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WEXITSTATUS(status) == 0);
  };
  endAtOnce([&] {
    AtomicFile file(folder / "out.ply"), further(folder / "further.ply");
    file.write(std::string(3'000'000, 'x'));
    removeUnfinishedFiles();
    ::_exit(0);
  });
  CHECK(folder.names().empty());
  endAtOnce([&] {
    AtomicFile first(folder / "first.ply"), second(folder / "second.ply");
    second.commit();
    removeUnfinishedFiles();
    ::_exit(0);
  });
  CHECK(folder.names() == std::vector<std::string>{"second.ply"});
  writeTo(folder / "second.ply", "whole");
  AtomicFile("/dev/null").write("directly");
  removeUnfinishedFiles();
  CHECK(contentOf(folder / "second.ply") == "whole");
}
