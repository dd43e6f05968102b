#pragma once

#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

namespace asdfvk::test {

struct ChildOptions {
  std::string input;                                             ///< Its standard input.
  std::vector<std::pair<std::string, std::string>> environment;  ///< Added to the inherited ones.
  std::string outputFile;        ///< Receives its standard output, instead of ChildOutcome.
  bool keepInputOpen = false;    ///< Its standard input does not end after `input`.
  bool errorIsTerminal = false;  ///< Standard error is a pseudo-terminal instead of a pipe.
};

struct ChildOutcome {
  int exitCode = -1;  ///< -1 when a signal ended it.
  int signal = 0;     ///< The signal that ended it; SIGKILL when it took longer than allowed.
  std::string output, error;
};

/// A process whose streams are held by the test.
class ChildProcess {
 public:
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments, const ChildOptions& options = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits until its standard error holds `text`; false when it ended or the time ran out before.
  bool waitForError(const std::string& text, double seconds);
  /// The same for its standard output.
  bool waitForOutput(const std::string& text, double seconds);
  void send(int signal) const;
  /// Waits for its end and kills it when it takes longer.
  ChildOutcome finish(double seconds);

 private:
  bool waitFor(const std::string& text, const std::string& stream, double seconds);
  /// One step of reading and feeding; false once both of its streams are closed.
  bool pump(int milliseconds);

  pid_t process_ = -1;
  int input_ = -1, output_ = -1, error_ = -1;
  std::string pendingInput_;
  const std::string keptInput_;  ///< The requests of `serve`, for keepJson().
  bool keepInputOpen_ = false;
  ChildOutcome outcome_;
};

/// Starts it and waits for its end, five minutes at most.
ChildOutcome runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const ChildOptions& options = {});

}  // namespace asdfvk::test
