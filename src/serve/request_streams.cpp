#include "serve/request_streams.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"
#include "core/write_all.h"

namespace asdfvk {
namespace {

constexpr int kPollMilliseconds = 50;  // A stop request is noticed within this time.
constexpr size_t kReadBytes = size_t{1} << 16;

/// Moves a standard stream to a descriptor that no child process inherits, and opens `replacement` in its place.
int movedStream(int stream, int replacement) {
  const int moved = fcntl(stream, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (moved < 0 || replacement < 0 || dup2(replacement, stream) < 0)
    throw std::system_error(errno, std::generic_category(), "the standard streams cannot be moved");
  return moved;
}

}  // namespace

RequestStreams::RequestStreams(int input, int output, size_t maxLineBytes)
    : input_(input), output_(output), maxLineBytes_(maxLineBytes) {}

RequestStreams RequestStreams::ofProcess(size_t maxLineBytes) {
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int input = movedStream(STDIN_FILENO, nothing);
  close(nothing);
  return {input, movedStream(STDOUT_FILENO, STDERR_FILENO), maxLineBytes};
}

bool RequestStreams::fill(const std::stop_token& stop) {
  for (;;) {
    if (stop.stop_requested()) return false;
    pollfd waiting{.fd = input_, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, kPollMilliseconds) <= 0) continue;
    const size_t size = pending_.size();
    pending_.resize(size + kReadBytes);
    const ssize_t count = ::read(input_, pending_.data() + size, kReadBytes);
    const int error = errno;
    pending_.resize(size + static_cast<size_t>(std::max<ssize_t>(count, 0)));
    if (count > 0) return true;
    if (count == 0) return false;
    if (error != EINTR && error != EAGAIN)
      throw Error(ErrorCode::UnreadableInput, fmt::format("standard input cannot be read: {}", std::strerror(error)));
  }
}

std::optional<RequestLine> RequestStreams::read(const std::stop_token& stop) {
  for (;;) {
    const size_t end = pending_.find('\n', searched_);
    const bool isComplete = end != std::string::npos;
    searched_ = isComplete ? 0 : pending_.size();
    if (!isComplete) {
      if (pending_.size() > maxLineBytes_) {
        isSkipping_ = true;
        pending_.clear();
        searched_ = 0;
      }
      if (fill(stop)) continue;
      if (stop.stop_requested() || (pending_.empty() && !isSkipping_)) return std::nullopt;
    }
    RequestLine line;
    line.isTooLong = std::exchange(isSkipping_, false) || (isComplete && end > maxLineBytes_);
    if (!line.isTooLong) line.text = pending_.substr(0, end);
    pending_.erase(0, isComplete ? end + 1 : end);
    if (line.isTooLong || line.text.find_first_not_of(" \t\r") != std::string::npos) return line;
  }
}

void RequestStreams::write(std::string_view line) {
  std::string text(line);
  text += '\n';
  const std::lock_guard<std::mutex> lock(writing_);
  if (const int error = writeAll(output_, text); error != 0)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("standard output cannot be written: {}", std::strerror(error)));
}

}  // namespace asdfvk
