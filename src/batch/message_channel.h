#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/json.h"

namespace asdfvk {

/// A message in CBOR. Strings may have any bytes.
[[nodiscard]] inline std::string encode(const Json& json) {
  std::string message;
  Json::to_cbor(json, message);
  return message;
}
[[nodiscard]] inline Json decode(std::string_view message) { return Json::from_cbor(message); }

/// Messages of any bytes over a connected stream socket, in both directions. A message is its size in decimal digits, a
/// line end, and its bytes. Does not own the descriptor.
class MessageChannel {
 public:
  explicit MessageChannel(int socket = -1) : socket_(socket) {}

  /// False where the other end is closed.
  bool send(std::string_view message);
  /// Reads what has arrived, without waiting. False where the other end is closed.
  bool receive();
  /// The next complete message that was received. Throws std::runtime_error where the bytes are no message.
  [[nodiscard]] std::optional<std::string> take();
  /// Waits for the next message. Unset where the other end is closed. Throws as take().
  [[nodiscard]] std::optional<std::string> wait();

 private:
  /// False at the end; true also where nothing has arrived.
  bool read(int flags);

  int socket_;
  std::string received_;
};

}  // namespace asdfvk
