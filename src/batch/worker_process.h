#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/message_channel.h"

namespace asdfvk {

struct ProcessEnd {
  int signal = 0;    ///< The signal that ended the process; 0 where it exited.
  int exitCode = 0;  ///< Where it exited.
};
/// "ended by signal 11 (Segmentation fault)", "ended with exit code 3".
[[nodiscard]] std::string textOf(const ProcessEnd& end);

/// A process that reads messages from its standard input and answers with messages on its standard output. Both are the
/// same socket. Its standard error is that of this process. The destructor kills it.
class WorkerProcess {
 public:
  /// arguments: the first one is the name that the process sees. Throws std::system_error.
  WorkerProcess(const std::string& program, const std::vector<std::string>& arguments);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  [[nodiscard]] pid_t id() const { return process_; }
  /// For poll(): readable where a message arrives or the process ended.
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
