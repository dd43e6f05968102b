#include "batch/worker.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <string>

#include "batch/message_channel.h"

namespace asdfvk {

void serveJobs(const std::function<std::unique_ptr<JobComputer>(const Greeting&)>& open) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int socket = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const int none = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::dup2(none, STDIN_FILENO);

  MessageChannel messages(socket);
  const std::optional<std::string> greeting = messages.wait();
  if (!greeting) return;
  std::unique_ptr<JobComputer> computer;
  try {
    computer = open(decode(*greeting).get<Greeting>());
  } catch (const OpenFailure& failure) {
    messages.send(encode({{"failure", failure.what()}, {"name", failure.name}, {"code", failure.code}}));
    return;
  }
  messages.send(encode(computer->describe()));
  while (const std::optional<std::string> request = messages.wait()) {
    JobResult result = computer->compute(decode(*request).get<Job>(), nullptr);
    result.record.options = nullptr;           // The main process has the options.
    const bool isSpent = computer->isSpent();  // A new worker opens the device again.
    if (!messages.send(encode({{"result", result}, {"isSpent", isSpent}})) || isSpent) return;
  }
}

}  // namespace asdfvk
