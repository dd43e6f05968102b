#include "batch/message_channel.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <stdexcept>
#include <system_error>

namespace asdfvk {

bool MessageChannel::send(std::string_view message) {
  const std::string bytes = std::to_string(message.size()) + "\n" + std::string(message);
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t count = ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    rest.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

bool MessageChannel::read(int flags) {
  std::array<char, 1 << 16> piece{};
  ssize_t count = 0;
  do count = ::recv(socket_, piece.data(), piece.size(), flags);
  while (count < 0 && errno == EINTR);
  if (count > 0) received_.append(piece.data(), static_cast<size_t>(count));
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK));
}

bool MessageChannel::receive() {
  for (;;) {
    const size_t size = received_.size();
    if (!read(MSG_DONTWAIT)) return false;
    if (received_.size() == size) return true;
  }
}

std::optional<std::string> MessageChannel::take() {
  const size_t end = received_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  size_t size = 0;
  const auto [last, error] = std::from_chars(received_.data(), received_.data() + end, size);
  if (error != std::errc() || last != received_.data() + end)
    throw std::runtime_error("a worker process sent bytes that are not a message");
  if (received_.size() - end - 1 < size) return std::nullopt;
  std::string message = received_.substr(end + 1, size);
  received_.erase(0, end + 1 + size);
  return message;
}

std::optional<std::string> MessageChannel::wait() {
  for (;;) {
    if (std::optional<std::string> message = take()) return message;
    if (!read(0)) return std::nullopt;
  }
}

}  // namespace asdfvk
