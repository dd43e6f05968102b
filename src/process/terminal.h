#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace asdfvk {

/// Writes the whole text to standard output. Throws Error{OutputNotWritable}, for example for a full disk.
void writeStandardOutput(std::string_view text);

/// Writes to standard error. Ignores failures, because they cannot be reported.
void writeStandardError(std::string_view text);

/// Writes the line "asdf-vk: error: SUBJECT: MESSAGE" to standard error. An empty subject is left out.
void printError(std::string_view subject, std::string_view message);

/// The line that printError() writes, and the same line for a warning, each with its line end.
[[nodiscard]] std::string errorLine(std::string_view subject, std::string_view message);
[[nodiscard]] std::string warningLine(std::string_view subject, std::string_view message);

/// Text that clears the current line of a terminal.
inline constexpr std::string_view kWipeLine = "\r\x1b[K";

/// Ignores SIGPIPE and SIGXFSZ, so that write() reports a closed pipe or a limit of the file size as an error. Opens
/// standard streams that are closed, so that no other file gets their descriptors.
void secureStandardStreams();

[[nodiscard]] bool isStandardErrorTerminal();

/// A progress bar in one line. The bar appears after one second and is redrawn at most ten times per second. The
/// destructor clears the bar.
class ProgressBar {
 public:
  /// write: writes a text to the terminal. now: returns a time in seconds.
  ProgressBar(std::function<void(std::string_view)> write, std::function<double()> now);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar if necessary. fraction: clamped to [0, 1].
  void update(double fraction);
  /// Clears the bar. Must be called before other text is written to the terminal.
  void clear();

 private:
  std::function<void(std::string_view)> write_;
  std::function<double()> now_;
  double start_;
  double lastDrawn_;
  bool isVisible_ = false;
};

/// A progress bar as text: "[##### ] 25 %", with 40 cells.
[[nodiscard]] std::string progressBarText(double fraction);

}  // namespace asdfvk
