#include "process/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>
#include <system_error>

#include "core/check.h"
#include "core/unfinished_files.h"

namespace asdfvk {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

// The signal handler uses only lock-free atomics, removeUnfinishedFiles() and a pipe. A byte in the pipe is a stop
// request. Closing the pipe ends the waiting thread.
std::atomic<int> listenerCount{0};
std::atomic<int> signalCount{0};
std::atomic<int> pipeWriteEnd{-1};
std::atomic<int64_t> firstSignalNanoseconds{0};
std::atomic<bool> isOfWorker{false};
constexpr int64_t kRepeatNanoseconds = 200'000'000;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<int64_t>::is_always_lock_free);

std::array<int, 2> stopPipe{-1, -1};
std::array<struct sigaction, kSignals.size()> previousActions;

int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

extern "C" void onSignal(int) {
  const int savedErrno = errno;
  int64_t none = 0;
  firstSignalNanoseconds.compare_exchange_strong(none, now());
  const bool isFirst = signalCount.fetch_add(1) == 0;
  if (!isFirst && (isOfWorker || now() - firstSignalNanoseconds < kRepeatNanoseconds)) {
    errno = savedErrno;
    return;
  }
  if (!isFirst || listenerCount.load() == 0) {
    removeUnfinishedFiles();
    constexpr std::string_view kMessage = "asdf-vk: error: cancelled\n";
    if (!isOfWorker) {
      [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
    }
    _exit(kCancelledCode);
  }
  [[maybe_unused]] const ssize_t written = write(pipeWriteEnd.load(), "x", 1);
  errno = savedErrno;
}

}  // namespace

Interrupt::Interrupt(bool isWorker) {
  ASDFVK_CHECK_OP(pipeWriteEnd.load(), ==, -1);
  if (pipe2(stopPipe.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  pipeWriteEnd = stopPipe[1];
  signalCount = 0;
  firstSignalNanoseconds = 0;
  isOfWorker = isWorker;
  waiter_ = std::jthread([this] {
    char byte = 0;
    ssize_t count = 0;
    do count = read(stopPipe[0], &byte, 1);
    while (count < 0 && errno == EINTR);
    if (count == 1) source_.request_stop();
  });
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  for (size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &previousActions[i]);
    if (previousActions[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &previousActions[i], nullptr);
  pipeWriteEnd = -1;
  close(stopPipe[1]);
  waiter_.join();
  close(stopPipe[0]);
}

Interrupt::Listening::Listening() { listenerCount.fetch_add(1); }
Interrupt::Listening::~Listening() { listenerCount.fetch_sub(1); }

Deadline::Deadline(double seconds, const std::stop_token& outer) : forward_(outer, Forward{source_}) {
  constexpr double kMaxSeconds = 1e9;  // A longer time would overflow the clock.
  if (!(seconds <= kMaxSeconds)) return;
  waiter_ = std::jthread([this, seconds](const std::stop_token& ending) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (isEnding_.wait_for(lock, ending, std::chrono::duration<double>(seconds), [] { return false; })) return;
    if (ending.stop_requested() || source_.stop_requested()) return;
    hasExpired_ = true;
    source_.request_stop();
  });
}

}  // namespace asdfvk
