#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

/// A process that takes lines on its standard input and answers with lines on its standard output, both ends of one
/// socket. It is killed by the destructor. Its standard error is that of this process.
class WorkerProcess {
 public:
  /// Throws std::system_error.
  explicit WorkerProcess(const std::vector<std::string>& command);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  [[nodiscard]] pid_t id() const { return process_; }
  /// For poll(): readable where a line arrives or the process ended.
  [[nodiscard]] int descriptor() const { return socket_; }

  /// False where the process ended.
  bool send(std::string_view line);
  /// Reads what has arrived without waiting. False where the process closed its output.
  bool receive();
  /// The next complete line that was received.
  [[nodiscard]] std::optional<std::string> takeLine();

  void signal(int number) const;
  /// Waits for its end; describes it: "ended by signal 11 (Segmentation fault)", "ended with exit code 3".
  [[nodiscard]] std::string waitForEnd();

 private:
  pid_t process_ = -1;
  int socket_ = -1;
  std::string received_;
};

}  // namespace asdfvk
