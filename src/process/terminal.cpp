#include "process/terminal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "core/write_all.h"

namespace asdfvk {
namespace {

constexpr double kQuietSeconds = 1;
constexpr double kRedrawSeconds = 0.1;
constexpr int kCells = 40;

std::string messageLine(std::string_view kind, std::string_view subject, std::string_view message) {
  const std::string line = subject.empty() ? fmt::format("asdf-vk: {}: {}", kind, message)
                                           : fmt::format("asdf-vk: {}: {}: {}", kind, subject, message);
  return oneLine(line) + "\n";
}

}  // namespace

void writeStandardOutput(std::string_view text) {
  if (const int error = writeAll(STDOUT_FILENO, text); error != 0)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("standard output cannot be written: {}", std::strerror(error)));
}

void writeStandardError(std::string_view text) { static_cast<void>(writeAll(STDERR_FILENO, text)); }

void printError(std::string_view subject, std::string_view message) { writeStandardError(errorLine(subject, message)); }

std::string errorLine(std::string_view subject, std::string_view message) {
  return messageLine("error", subject, message);
}

std::string warningLine(std::string_view subject, std::string_view message) {
  return messageLine("warning", subject, message);
}

void secureStandardStreams() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // open() returns the lowest free descriptor, which is that of the missing stream. With O_RDONLY, writing to the
    // stream still fails.
    if (open("/dev/null", O_RDONLY) != stream) return;
  }
}

bool isStandardErrorTerminal() { return isatty(STDERR_FILENO) == 1; }

ProgressBar::ProgressBar(std::function<void(std::string_view)> write, std::function<double()> now)
    : write_(std::move(write)), now_(std::move(now)), start_(now_()), lastDrawn_(start_) {}

void ProgressBar::update(double fraction) {
  const double time = now_();
  if (time - start_ < kQuietSeconds) return;
  if (isVisible_ && time - lastDrawn_ < kRedrawSeconds) return;
  write_(fmt::format("{}{}", kWipeLine, progressBarText(fraction)));
  lastDrawn_ = time;
  isVisible_ = true;
}

void ProgressBar::clear() {
  if (!isVisible_) return;
  write_(kWipeLine);
  isVisible_ = false;
}

std::string progressBarText(double fraction) {
  const double share = fraction >= 0 ? std::fmin(fraction, 1) : 0;
  const int filled = static_cast<int>(std::floor(share * kCells));
  return fmt::format("[{}{}] {:3.0f} %", std::string(static_cast<size_t>(filled), '#'),
                     std::string(static_cast<size_t>(kCells - filled), ' '), std::floor(share * 100));
}

}  // namespace asdfvk
