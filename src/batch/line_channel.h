#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asdfvk {

/// Lines of text over a connected stream socket, in both directions. Does not own the descriptor.
class LineChannel {
 public:
  explicit LineChannel(int socket = -1) : socket_(socket) {}

  /// Adds the line end. False where the other end is closed.
  bool send(std::string_view line);
  /// Reads what has arrived, without waiting. False where the other end is closed.
  bool receive();
  /// The next complete line that was received.
  [[nodiscard]] std::optional<std::string> take();
  /// Waits for the next line. Unset where the other end is closed.
  [[nodiscard]] std::optional<std::string> waitForLine();

 private:
  /// False at the end; true also where nothing has arrived.
  bool read(int flags);

  int socket_;
  std::string received_;
};

}  // namespace asdfvk
