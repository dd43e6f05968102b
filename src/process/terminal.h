#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace asdfvk {

/// Writes all of it to standard output. Throws Error{OutputNotWritable} with the reason: a full disk, a closed pipe.
void writeStandardOutput(std::string_view text);

/// Writes to standard error; ignores a failure, which cannot be reported anywhere.
void writeStandardError(std::string_view text);

/// "asdf-vk: error: SUBJECT: MESSAGE" as one line on standard error; without the subject where that is empty.
void printError(std::string_view subject, std::string_view message);

/// The line that printError() writes, with its line end; and that of a warning.
[[nodiscard]] std::string errorLine(std::string_view subject, std::string_view message);
[[nodiscard]] std::string warningLine(std::string_view subject, std::string_view message);

/// Wipes the line of the cursor on a terminal.
inline constexpr std::string_view kWipeLine = "\r\x1b[K";

/// Ignores SIGPIPE and SIGXFSZ, so that write() reports a closed pipe and a limit on the size of files. Opens standard
/// streams that the caller closed, so that no other file gets their descriptors.
void secureStandardStreams();

[[nodiscard]] bool isStandardErrorTerminal();

/// A one-line bar, shown after one second, redrawn at most ten times per second, and wiped by the destructor.
class ProgressBar {
 public:
  /// `write` writes text to the terminal; `now` returns seconds.
  ProgressBar(std::function<void(std::string_view)> write, std::function<double()> now);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// fraction: clamped to [0, 1].
  void update(double fraction);
  /// Wipes the bar; must be called before anything else is written to the terminal.
  void clear();

 private:
  std::function<void(std::string_view)> write_;
  std::function<double()> now_;
  double start_;
  double lastDrawn_;
  bool isVisible_ = false;
};

/// "[#####               ]  25 %", 40 cells wide.
[[nodiscard]] std::string progressBarText(double fraction);

}  // namespace asdfvk
