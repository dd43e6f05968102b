#include "serve/request_streams.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "support/require_failure.h"

namespace asdfvk::test {
namespace {

struct Pipe {
  std::array<int, 2> ends{-1, -1};

  Pipe() { REQUIRE_EQ(pipe2(ends.data(), O_CLOEXEC), 0); }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void write(const std::string& text) const {
    REQUIRE_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void end() { close(std::exchange(ends[1], -1)); }
};

/// The lines of an input; "(too long)" for a line that was skipped.
std::vector<std::string> linesOfInput(const std::string& text, size_t maxBytes) {
  Pipe in, out;
  std::thread writer([&] {
    in.write(text);
    in.end();
  });
  RequestStreams streams(in.ends[0], out.ends[1], maxBytes);
  std::vector<std::string> lines;
  while (const std::optional<RequestLine> line = streams.read({}))
    lines.push_back(line->isTooLong ? "(too long)" : line->text);
  writer.join();
  return lines;
}

}  // namespace

TEST_CASE("requests are lines, blank lines are ignored, and the last line needs no end") {
  using Lines = std::vector<std::string>;
  CHECK(linesOfInput("", 10) == Lines{});
  CHECK(linesOfInput("\n \t\r\n\n", 10) == Lines{});
  CHECK(linesOfInput("a\nb\r\n\nc", 10) == Lines{"a", "b\r", "c"});
}

TEST_CASE("a line that is too long is skipped, and the next line is read") {
  using Lines = std::vector<std::string>;
  const std::string big(300'000, 'x');
  CHECK(linesOfInput("a\n" + big + "\nb\n", 100) == Lines{"a", "(too long)", "b"});
  CHECK(linesOfInput("a\n" + big, 100) == Lines{"a", "(too long)"});
  CHECK(linesOfInput("12345\n123456\nb", 5) == Lines{"12345", "(too long)", "b"});
  CHECK(linesOfInput(big + "\nb\n", 300'000) == Lines{big, "b"});
}

TEST_CASE("a stop request ends the wait for a line") {
  const Pipe in, out;
  RequestStreams streams(in.ends[0], out.ends[1], 100);
  std::stop_source stop;
  const std::jthread stopper([&] { stop.request_stop(); });
  CHECK_FALSE(streams.read(stop.get_token()));
}

TEST_CASE("an answer is a line, and a closed output is an error") {
  signal(SIGPIPE, SIG_IGN);
  const Pipe in;
  Pipe out;
  RequestStreams streams(in.ends[0], out.ends[1], 100);
  streams.write("{}");
  std::array<char, 8> bytes{};
  CHECK_EQ(read(out.ends[0], bytes.data(), bytes.size()), 3);
  CHECK_EQ(std::string(bytes.data()), "{}\n");
  close(std::exchange(out.ends[0], -1));
  requireFailure([&] { streams.write("{}"); }, ErrorCode::OutputNotWritable);
}

}  // namespace asdfvk::test
