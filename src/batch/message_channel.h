#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/json.h"

namespace asdfvk {

/// Encodes a message in CBOR. Strings may contain any bytes.
[[nodiscard]] inline std::string encode(const Json& json) {
  std::string message;
  Json::to_cbor(json, message);
  return message;
}
[[nodiscard]] inline Json decode(std::string_view message) { return Json::from_cbor(message); }

/// Sends and receives messages of any bytes over a connected stream socket. A message is sent as its size in decimal
/// digits, a line end, and its bytes. Does not own the descriptor.
class MessageChannel {
 public:
  explicit MessageChannel(int socket = -1) : socket_(socket) {}

  /// False if the other end is closed.
  bool send(std::string_view message);
  /// Reads the bytes that have arrived, without waiting. False if the other end is closed.
  bool receive();
  /// Returns the next complete message, if there is one. Throws std::runtime_error for bytes that are not a message.
  [[nodiscard]] std::optional<std::string> take();
  /// Waits for the next message. Unset if the other end is closed. Throws like take().
  [[nodiscard]] std::optional<std::string> wait();

 private:
  /// Receives bytes at most once. Returns false if the other end is closed. Returns true also if no bytes have arrived.
  bool read(int flags);

  int socket_;
  std::string received_;
};

}  // namespace asdfvk
