#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/mesh_tree.h"
#include "core/atomic_file.h"
#include "process/interrupt.h"

namespace asdfvk::test {
namespace {

constexpr double kPatienceSeconds = 120;

/// Minutes of work on one thread.
std::vector<std::string> longWork(const std::string& mesh) {
  return {mesh, "--seeds", "all", "--rays", "1024", "--threads", "1", "--backend", "reference", "--verbose"};
}

TEST_CASE("a signal between chunks cancels with 130 and leaves no file") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(150));
  for (const int signal : {SIGINT, SIGTERM}) {
    // The bar on the terminal shows that the computation runs.
    ChildOptions options;
    options.errorIsTerminal = true;
    std::vector<std::string> arguments = longWork(mesh);
    arguments.push_back("--json");
    ChildProcess child(ASDFVK_PROGRAM, arguments, options);
    REQUIRE(child.waitForError(" %", kPatienceSeconds));
    child.send(signal);
    const ChildOutcome outcome = child.finish(kPatienceSeconds);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 130);
    CHECK(outcome.error.find("asdf-vk: error: " + mesh + ": cancelled") != std::string::npos);
    CHECK(outcome.error.find("[") != std::string::npos);
    CHECK_EQ(nlohmann::json::parse(outcome.output).at("code").get<std::string>(), "cancelled");
    CHECK_EQ(folder.names(), std::vector<std::string>{"sphere.off"});
  }
}

TEST_CASE("a signal while the mesh is awaited on standard input ends at once with 130") {
  const ScratchFolder folder;
  ChildOptions options;
  options.keepInputOpen = true;
  ChildProcess child(ASDFVK_PROGRAM, {"-", "-o", folder / "out.ply", "--backend", "reference", "--verbose"}, options);
  REQUIRE(child.waitForError("asdf-vk: ", kPatienceSeconds));
  child.send(SIGINT);
  const ChildOutcome outcome = child.finish(kPatienceSeconds);
  CHECK_EQ(outcome.exitCode, 130);
  CHECK(outcome.error.find("asdf-vk: error: cancelled") != std::string::npos);
  CHECK(folder.names().empty());
}

TEST_CASE("one signal while a FIFO or standard input is awaited ends with 130") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff()), fifo = folder / "fifo.ply";
  REQUIRE_EQ(mkfifo(fifo.c_str(), 0600), 0);
  ChildOptions options;
  options.keepInputOpen = true;
  for (const Names& arguments :
       {Names{fifo, "-o", folder / "out.ply", "--log", folder / "log"},
        Names{fifo, "-o", folder / "out.ply", "--log", folder / "log", "--isolate"},
        Names{"-", "-o", folder / "out.ply", "--log", folder / "log"}, Names{mesh, "-o", fifo},
        Names{mesh, "-o", fifo, "--log", folder / "log"}, Names{mesh, "-o", folder / "out.ply", "--points", fifo},
        Names{mesh, "-o", folder / "out.ply", "--with", fifo},
        Names{mesh, "-o", folder / "out.ply", "--compare", fifo}}) {
    Names all = arguments;
    all.insert(all.end(), {"--backend", "reference", "--verbose"});
    ChildProcess child(ASDFVK_PROGRAM, all, options);
    REQUIRE(child.waitForError("asdf-vk: ", kPatienceSeconds));  // The device lines.
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    child.send(SIGTERM);
    const ChildOutcome outcome = child.finish(10);
    INFO(arguments[0] << " " << arguments[2] << ": " << outcome.error);
    CHECK_EQ(outcome.exitCode, 130);
  }
}

TEST_CASE("a second signal during the writing ends at once with 130 and leaves no half-written file") {
  const ScratchFolder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const Interrupt interrupt;
    const Interrupt::Listening listening;
    AtomicFile file(folder / "out.ply");
    file.write(std::string(5'000'000, 'x'));
    std::raise(SIGTERM);
    std::raise(SIGINT);  // Within 0.2 s: the same request.
    file.write("The first signal alone lets the writing go on.");
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    std::raise(SIGINT);
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK_EQ(WEXITSTATUS(status), 130);
  CHECK(folder.names().empty());
}

TEST_CASE("there is no progress bar in a pipe") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(100));
  ChildProcess child(ASDFVK_PROGRAM, longWork(mesh));
  REQUIRE(child.waitForError("asdf-vk: ", kPatienceSeconds));
  CHECK_FALSE(child.waitForError("#", 2));
  child.send(SIGINT);
  const ChildOutcome outcome = child.finish(kPatienceSeconds);
  CHECK_EQ(outcome.exitCode, 130);
  CHECK(outcome.error.find('\r') == std::string::npos);
}

}  // namespace
}  // namespace asdfvk::test
