#include "cli/serve_commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "asdf_vk/run_control.h"
#include "cli/command_line.h"
#include "cli/program_values.h"
#include "core/parallel.h"
#include "process/interrupt.h"
#include "process/terminal.h"
#include "serve/line_protocol.h"
#include "serve/mcp_protocol.h"

namespace asdfvk {
namespace {

/// Greatest size of a request, and of all requests that wait.
constexpr size_t kMaxRequestBytes = size_t{256} << 20;
/// A request and its mesh need several times the bytes of the line.
constexpr size_t kMemoryPerRequestByte = 8;

constexpr double kMaxServerSeconds = 1e9, kMaxServerJobs = 1024;

OptionRows serverRows(ServerOptions& options, bool isMcp) {
  return withGroups({
      OptionRow{.name = "root",
                .group = "Limits",
                .member = memberAs<NameCodec>(&options.root),
                .text = "Refuse files outside of this folder. Relative paths of requests are relative to it",
                .placeholder = "DIR",
                .defaultText = isMcp ? "the current folder" : "-"},
      OptionRow{.name = "max-memory",
                .member = memberAs<MemoryCodec>(&options.maxMemoryBytes),
                .text = "Stop a request if the memory of the program exceeds this size, such as 500M or 2G",
                .placeholder = "SIZE"},
      OptionRow{.name = "timeout",
                .member = &options.timeoutSeconds,
                .range = aboveUpTo(0, kMaxServerSeconds),
                .unit = OptionUnit::Seconds,
                .text = "Stop a request that takes longer than this. A request can have a shorter time",
                .defaultText = "-"},
      OptionRow{.name = "jobs",
                .member = &options.jobCount,
                .range = fromTo(1, kMaxServerJobs),
                .text = "Number of requests that are computed at once. With 1, answers are in the order of requests",
                .placeholder = "N",
                .defaultText = "the number of cores"},
  });
}

PathRoot rootOf(const ServerOptions& options, bool isMcp) {
  if (!options.root.empty()) return PathRoot(options.root);
  return isMcp ? PathRoot(".") : PathRoot();
}

/// Reads and answers requests until the end of the input. Returns whether a signal ended it.
template <typename Protocol>
bool answerRequests(const ServerOptions& options, const ServerSettings& settings, const std::stop_token& stop) {
  MeshRequestComputer computer(settings);
  const size_t maxBytes = options.maxMemoryBytes == 0
                              ? kMaxRequestBytes
                              : std::min<size_t>(kMaxRequestBytes, options.maxMemoryBytes / kMemoryPerRequestByte);
  RequestStreams streams = RequestStreams::ofProcess(maxBytes);
  RequestQueue queue(
      settings.workerCount, maxBytes, [&](std::string_view line) { streams.write(line); }, stop);
  Protocol protocol(queue, computer);
  while (std::optional<RequestLine> line = streams.read(queue.token())) protocol.receive(std::move(*line));
  queue.finish();
  return stop.stop_requested();
}

}  // namespace

ArgumentParser serverParser(std::string_view command, ServerOptions& options) {
  const bool isMcp = command == kMcp;
  std::vector<Argument> arguments;
  addArguments(serverRows(options, isMcp), arguments);
  addArguments(sessionRows(options.session), arguments);
  ArgumentParser parser(
      fmt::format("asdf-vk {}", command),
      isMcp
          ? "Serves the tools check_walls, measure, find_parts and picture by the Model Context Protocol, on standard "
            "input and output, until the end of the input."
          : "Answers requests until the end of standard input: a JSON object per line, such as {\"id\": 1, "
            "\"mesh\": \"part.stl\", \"options\": {\"thinnerThan\": 0.8}}, and an answer per line on standard "
            "output.",
      "", std::move(arguments));
  parser.footer = fmt::format("{} describes the protocol.", isMcp ? "docs/mcp.md" : "docs/serve.md");
  return parser;
}

ExitCode runServer(std::string_view command, const std::vector<std::string>& arguments) {
  const bool isMcp = command == kMcp;
  ServerOptions options;
  if (const std::string answer = serverParser(command, options).parse(arguments); !answer.empty()) {
    writeStandardOutput(answer);
    return ExitCode::Done;
  }
  requireValid(options.session, OptionSpelling::Flag);
  const ThreadLimit threads(options.session.threadCount);
  const ServerSettings settings{.session = options.session,
                                .files = {.root = rootOf(options, isMcp), .protectsFiles = isMcp},
                                .maxMemoryBytes = options.maxMemoryBytes,
                                .timeoutSeconds = options.timeoutSeconds,
                                .workerCount = options.jobCount > 0 ? options.jobCount : threadLimit(),
                                .describesInText = isMcp};
  const Interrupt interrupt;
  const Interrupt::Listening listening;
  const bool isStopped = isMcp ? answerRequests<McpProtocol>(options, settings, interrupt.token())
                               : answerRequests<LineProtocol>(options, settings, interrupt.token());
  return isStopped ? ExitCode::Cancelled : ExitCode::Done;
}

}  // namespace asdfvk
