#include "cli/batch_worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "batch/worker_pool.h"
#include "cli/interrupt.h"
#include "cli/job_threads.h"
#include "cli/report.h"
#include "cli/terminal.h"
#include "core/atomic_file.h"
#include "viewer/json.h"

namespace asdfvk {
namespace {

std::string lineOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json messageOf(const MeshRun& run) {
  return {{"code", static_cast<int>(run.code)},
          {"json", textOfBytes(run.json)},
          {"text", textOfBytes(run.text)},
          {"record", toJsonLine(run.record)}};
}

MeshRun runOf(const Json& message) {
  MeshRun run;
  run.code = static_cast<ExitCode>(message.at("code").get<int>());
  run.json = bytesOfText(message.at("json").get<std::string>());
  run.text = bytesOfText(message.at("text").get<std::string>());
  run.record = parseRecord(message.at("record").get<std::string>()).value();
  return run;
}

/// How a mesh fails whose worker was killed or crashed.
Failure failureOf(const TaskOutcome& outcome, const BatchOptions& batch) {
  switch (outcome.end) {
    case TaskEnd::TimedOut:
      return {ExitCode::Limit, fmt::format("took longer than --timeout {:g}", batch.timeoutSeconds), "timeLimit"};
    case TaskEnd::MemoryExceeded:
      return {ExitCode::Limit, fmt::format("took {} MiB of memory, more than --memory-limit", outcome.peakBytes >> 20),
              "memoryLimit"};
    case TaskEnd::Dropped:
      return {ExitCode::Cancelled, "cancelled", "cancelled"};
    default:
      return {ExitCode::Internal, fmt::format("internal error: the worker process {}; please report it", outcome.text),
              "crashed"};
  }
}

/// Reads lines from a descriptor.
class LineReader {
 public:
  explicit LineReader(int descriptor) : descriptor_(descriptor) {}

  std::optional<std::string> next() {
    for (;;) {
      if (const size_t end = buffer_.find('\n'); end != std::string::npos) {
        std::string line = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        return line;
      }
      std::array<char, 1 << 16> piece{};
      const ssize_t count = ::read(descriptor_, piece.data(), piece.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return std::nullopt;
      buffer_.append(piece.data(), static_cast<size_t>(count));
    }
  }

 private:
  int descriptor_;
  std::string buffer_;
};

/// False where the other end is closed.
bool writeLine(int descriptor, std::string line) {
  line += '\n';
  for (std::string_view rest = line; !rest.empty();) {
    const ssize_t count = ::write(descriptor, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    rest.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

}  // namespace

ExitCode runIsolated(const CommandLine& line, const std::vector<std::string>& arguments, MeshRunner& runner,
                     BatchMonitor& monitor, const std::vector<MeshTask>& tasks, const std::vector<JobPhase>& phases,
                     const std::stop_token& stop) {
  Json greeting{{"arguments", Json::array()}};
  for (const std::string& argument : arguments) greeting["arguments"].push_back(textOfBytes(argument));
  bool printsDevices = !line.quiet;
  std::optional<ExitCode> failure;
  for (const JobPhase& phase : phases) {
    if (stop.stop_requested() || failure) break;
    greeting["threads"] = phase.threadCount;
    const WorkerPoolOptions options{
        .command = {std::filesystem::read_symlink("/proc/self/exe").string(), kWorkerArgument},
        .greeting = lineOf(greeting),
        .workerCount = phase.jobCount,
        .timeoutSeconds = line.batch.timeoutSeconds,
        .memoryBytes = line.batch.memoryBytes};
    const WorkerPoolClient client{
        .request =
            [&](size_t index) {
              const MeshTask& task = tasks[phase.tasks[index]];
              return lineOf({{"input", textOfBytes(task.input)}, {"output", textOfBytes(task.output)}});
            },
        .ready =
            [&](const std::string& answer) {
              const Json json = Json::parse(answer);
              if (json.contains("failure")) {
                failure = static_cast<ExitCode>(json.at("code").get<int>());
                printError("", json.at("failure").get<std::string>());
                return false;
              }
              if (std::exchange(printsDevices, false))
                writeStandardError(bytesOfText(json.at("devices").get<std::string>()));
              return true;
            },
        .finished =
            [&](const TaskOutcome& outcome) {
              const MeshTask& task = tasks[phase.tasks[outcome.task]];
              if (outcome.end == TaskEnd::Answered) {
                MeshRun run = runOf(Json::parse(outcome.text));
                run.record.input = task.input;  // Not all names survive JSON.
                if (run.record.output) run.record.output = task.output;
                monitor.add(phase.tasks[outcome.task], std::move(run));
                return;
              }
              const auto folder = std::filesystem::path(task.output).parent_path();
              removeFilesOfProcess(folder.empty() ? "." : folder, outcome.worker);
              MeshRun run = runner.failedRun(task, failureOf(outcome, line.batch));
              run.record.totalSeconds = outcome.seconds;
              run.record.peakMemoryBytes = outcome.peakBytes;
              monitor.add(phase.tasks[outcome.task], std::move(run));
            }};
    runOnWorkers(phase.tasks.size(), options, client, stop);
  }
  return failure.value_or(ExitCode::Done);
}

ExitCode runWorker() {
  // A worker does not outlive the process that gives it meshes.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // What any library prints goes to standard error.
  const int input = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3), output = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const int none = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::dup2(none, STDIN_FILENO);

  LineReader reader(input);
  const std::optional<std::string> first = reader.next();
  if (!first) return ExitCode::Done;
  const Json greeting = Json::parse(*first);
  std::vector<std::string> arguments;
  for (const Json& argument : greeting.at("arguments")) arguments.push_back(bytesOfText(argument.get<std::string>()));
  const CommandLine line = parseCommandLine(std::move(arguments));
  const ThreadLimit threadLimit(greeting.at("threads").get<uint32_t>());
  const Interrupt interrupt;
  const Interrupt::Listening listening;  // While idle, the end of the input ends the process.
  std::unique_ptr<Session> session;
  try {
    session = std::make_unique<Session>(line.session);
  } catch (...) {
    const Failure failure = currentFailure(line.session.requireGpu);
    writeLine(output, lineOf({{"failure", failure.message}, {"code", static_cast<int>(failure.code)}}));
    return failure.code;
  }
  writeLine(output, lineOf({{"devices", textOfBytes(deviceLinesOf(*session))}}));
  MeshRunner runner(line, 1);
  while (const std::optional<std::string> request = reader.next()) {
    const Json json = Json::parse(*request);
    const MeshTask task{bytesOfText(json.at("input").get<std::string>()),
                        bytesOfText(json.at("output").get<std::string>())};
    const MeshRun run = runner.run(*session, task, std::nullopt, true, interrupt.token());
    if (!writeLine(output, lineOf(messageOf(run)))) break;
    if (run.code == ExitCode::Device) break;  // Another worker opens the device anew.
  }
  return ExitCode::Done;
}

std::string textOfBytes(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return text;
}

std::string bytesOfText(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80 || i + 1 == text.size()) {
      bytes += text[i];
    } else {
      ++i;
      bytes += static_cast<char>((byte & 0x03) << 6 | (static_cast<unsigned char>(text[i]) & 0x3f));
    }
  }
  return bytes;
}

}  // namespace asdfvk
