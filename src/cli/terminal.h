#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace asdfvk {

/// Writes all of it to standard output. Throws Error{Output} with the reason: a full disk, a closed pipe.
void writeStandardOutput(std::string_view text);

/// Writes to standard error; ignores a failure, which cannot be reported anywhere.
void writeStandardError(std::string_view text);

/// "asdf-vk: error: SUBJECT: MESSAGE" as one line on standard error; without the subject where that is empty.
void printError(std::string_view subject, std::string_view message);
void printWarning(std::string_view subject, std::string_view message);

/// A failed write becomes an error of the call instead of a signal, and a file that is opened can never take the place
/// of a standard stream that the caller closed.
void secureStandardStreams();

[[nodiscard]] bool isStandardErrorTerminal();

/// A one-line bar that first shows after a second, is redrawn ten times a second at most, and leaves no trace.
class ProgressBar {
 public:
  /// `write` puts text on the terminal; `now` gives seconds.
  ProgressBar(std::function<void(std::string_view)> write, std::function<double()> now);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// fraction in [0, 1]; what lies outside is taken for the nearer end.
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
[[nodiscard]] std::string progressText(double fraction);

}  // namespace asdfvk
