#include "batch/line_channel.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>

namespace asdfvk {

bool LineChannel::send(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t count = ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    rest.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

bool LineChannel::read(int flags) {
  std::array<char, 1 << 16> piece{};
  ssize_t count = 0;
  do count = ::recv(socket_, piece.data(), piece.size(), flags);
  while (count < 0 && errno == EINTR);
  if (count > 0) received_.append(piece.data(), static_cast<size_t>(count));
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK));
}

bool LineChannel::receive() {
  for (;;) {
    const size_t size = received_.size();
    if (!read(MSG_DONTWAIT)) return false;
    if (received_.size() == size) return true;
  }
}

std::optional<std::string> LineChannel::take() {
  const size_t end = received_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

std::optional<std::string> LineChannel::waitForLine() {
  for (;;) {
    if (std::optional<std::string> line = take()) return line;
    if (!read(0)) return std::nullopt;
  }
}

}  // namespace asdfvk
