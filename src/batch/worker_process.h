#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/message_channel.h"

namespace asdfvk {

struct ProcessEnd {
  int signal = 0;    ///< The signal that ended the process; 0 if the process exited.
  int exitCode = 0;  ///< Exit code; 0 if a signal ended the process.
};
[[nodiscard]] std::string textOf(const ProcessEnd& end);

/// A child process that exchanges messages with this process. One socket is the standard input and the standard output
/// of the child. Both processes have the same standard error. The destructor kills the child.
class WorkerProcess {
 public:
  /// arguments: the first one is argv[0]. Throws std::system_error.
  WorkerProcess(const std::string& program, const std::vector<std::string>& arguments);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  [[nodiscard]] pid_t id() const { return process_; }
  /// Descriptor for poll(): readable if bytes have arrived or the process has ended.
  [[nodiscard]] int descriptor() const { return socket_; }
  [[nodiscard]] MessageChannel& messages() { return messages_; }

  void signal(int number) const;
  ProcessEnd waitForEnd();

 private:
  pid_t process_ = -1;
  int socket_ = -1;
  MessageChannel messages_;
};

}  // namespace asdfvk
