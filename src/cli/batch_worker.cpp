#include "cli/batch_worker.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/run_control.h"
#include "batch/line_channel.h"
#include "cli/interrupt.h"
#include "cli/job_plan.h"
#include "cli/report.h"
#include "cli/worker_messages.h"

namespace asdfvk {

ExitCode runWorker() {
  // A worker does not outlive the process that gives it meshes.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Texts that a library prints must not be answers.
  const int socket = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const int none = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::dup2(none, STDIN_FILENO);

  LineChannel lines(socket);
  const std::optional<std::string> first = lines.waitForLine();
  if (!first) return ExitCode::Done;
  const Json greeting = Json::parse(*first);
  std::vector<std::string> arguments;
  for (const Json& argument : greeting.at("arguments")) arguments.push_back(bytesOfText(argument.get<std::string>()));
  const CommandLine line = parseCommandLine(std::move(arguments));
  const JobPhase phase{.jobCount = greeting.at("jobs").get<uint32_t>(),
                       .threadCount = greeting.at("threads").get<uint32_t>()};
  std::optional<ThreadLimit> threadLimit(phase.threadCount);
  std::optional<Interrupt> interrupt;
  std::unique_ptr<Session> session;
  try {
    interrupt.emplace(true);
    session = std::make_unique<Session>(line.session);
  } catch (...) {
    const Failure failure = currentFailure(line.session.requireGpu);
    lines.send(lineOf({{"failure", textOfBytes(failure.message)}, {"code", static_cast<int>(failure.code)}}));
    return failure.code;
  }
  const std::string backend = session->backend();
  threadLimit.reset();
  threadLimit.emplace(threadsOn(phase, session->runsOnCpu(), line.batch.jobCount));
  lines.send(lineOf(
      {{"devices", textOfBytes(deviceLinesOf(*session))}, {"backend", backend}, {"isCpu", session->runsOnCpu()}}));
  MeshRunner runner(line, 1);
  for (bool ends = false; !ends;) {
    const std::optional<std::string> request = lines.waitForLine();
    if (!request) break;
    const Interrupt::Listening listening;  // A signal ends an idle worker at once.
    const MeshRun run = runner.run(*session, taskOf(Json::parse(*request)), std::nullopt, true, interrupt->token());
    // Where the device failed, another worker opens it anew.
    ends = run.code == ExitCode::Device || session->backend() != backend || interrupt->token().stop_requested();
    Json answer = answerOf(run);
    answer["ends"] = ends;
    if (!lines.send(lineOf(answer))) break;
  }
  return ExitCode::Done;
}

}  // namespace asdfvk
