#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <thread>

#include "batch/job.h"
#include "batch/message_channel.h"

namespace asdfvk {
namespace {

std::string allBytes() {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  return all;
}

/// Both ends of a connection.
struct Connection {
  std::array<int, 2> sockets{};

  Connection() { REQUIRE_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets.data()), 0); }
  ~Connection() {
    closeFirst();
    ::close(sockets[1]);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  void closeFirst() {
    if (sockets[0] >= 0) ::close(sockets[0]);
    sockets[0] = -1;
  }
};

TEST_CASE("names and texts of jobs keep all bytes, also those that are not UTF-8") {
  const Job job{allBytes(), "caf\xe9.ply"};
  const auto received = decode(encode(job)).get<Job>();
  CHECK_EQ(received.input, job.input);
  CHECK_EQ(received.output, job.output);
  JobResult result;
  result.record.input = job.input;
  result.record.output = job.output;
  result.record.status = MeshStatus::Failed;
  result.record.code = 2;
  result.report = allBytes();
  result.messages = "line\n";
  const auto answer = decode(encode(result)).get<JobResult>();
  CHECK_EQ(answer.record.input, job.input);
  CHECK_EQ(answer.record.output.value(), job.output);
  CHECK(answer.record.status == MeshStatus::Failed);
  CHECK_EQ(answer.record.code, 2);
  CHECK_EQ(answer.report, result.report);
  CHECK_EQ(answer.messages, result.messages);
}

TEST_CASE("the description of a computer arrives as it was") {
  const ComputerDescription description{"vulkan", "two\nlines\n", false};
  const auto received = decode(encode(description)).get<ComputerDescription>();
  CHECK_EQ(received.backend, "vulkan");
  CHECK_EQ(received.deviceLines, "two\nlines\n");
  CHECK_FALSE(received.isCpu);
}

TEST_CASE("messages arrive whole and in their order, whatever their bytes and sizes") {
  Connection connection;
  const std::vector<std::string> sent{"", "a\nb", allBytes(), std::string(3'000'000, '\n'), "end"};
  std::jthread sender([&] {
    MessageChannel channel(connection.sockets[0]);
    for (const std::string& message : sent) CHECK(channel.send(message));
  });
  MessageChannel channel(connection.sockets[1]);
  for (const std::string& message : sent) CHECK(channel.wait() == message);
  CHECK(channel.receive());
  CHECK_FALSE(channel.take().has_value());
  sender.join();
  connection.closeFirst();
  CHECK_FALSE(channel.receive());
  CHECK_FALSE(channel.wait().has_value());
}

TEST_CASE("bytes that are no message are an error") {
  for (const std::string bytes : {"no number\n", "-1\n", "\n", "99999999999999999999999\n"}) {
    Connection connection;
    REQUIRE_EQ(::send(connection.sockets[0], bytes.data(), bytes.size(), 0), bytes.size());
    MessageChannel channel(connection.sockets[1]);
    CHECK_THROWS_AS((void)channel.wait(), std::runtime_error);
  }
}

}  // namespace
}  // namespace asdfvk
