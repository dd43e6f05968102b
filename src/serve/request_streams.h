#pragma once

#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

namespace asdfvk {

struct RequestLine {
  std::string text;        ///< Without the line end. Empty if the line is too long.
  bool isTooLong = false;  ///< Whether the line had more bytes than allowed, and was skipped.
};

/// Reads requests as lines from one descriptor, and writes answers as lines to another one.
class RequestStreams {
 public:
  RequestStreams(int input, int output, size_t maxLineBytes);

  /// Streams of this process: from now on, standard input is empty, and other text for standard output goes to standard
  /// error. So neither meshes nor libraries can disturb requests and answers. Throws std::system_error.
  [[nodiscard]] static RequestStreams ofProcess(size_t maxLineBytes);

  RequestStreams(const RequestStreams&) = delete;
  RequestStreams& operator=(const RequestStreams&) = delete;

  /// The next line that is not blank. Returns nothing at the end of the input or after a stop request. The last line
  /// may lack its line end. Throws Error{UnreadableInput}.
  [[nodiscard]] std::optional<RequestLine> read(const std::stop_token& stop);

  /// Writes a line and a line end. Thread-safe. Throws Error{OutputNotWritable}.
  void write(std::string_view line);

 private:
  /// Appends further bytes to `pending_`. Returns false at the end of the input or after a stop request.
  [[nodiscard]] bool fill(const std::stop_token& stop);

  int input_, output_;
  size_t maxLineBytes_;
  std::string pending_;      ///< Bytes that were read and not returned.
  size_t searched_ = 0;      ///< Bytes of `pending_` without a line end.
  bool isSkipping_ = false;  ///< Whether the present line is too long.
  std::mutex writing_;
};

}  // namespace asdfvk
