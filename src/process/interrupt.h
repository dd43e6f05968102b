#pragma once

#include <stop_token>
#include <thread>

namespace asdfvk {

/// Exit code of a process that a signal cancelled: 128 + SIGINT.
inline constexpr int kCancelledCode = 130;

/// Handles SIGINT, SIGTERM and SIGHUP, except those that were ignored, during its lifetime. The first signal requests a
/// stop of the computation, or ends the program if no Listening exists. The second one ends the program; one within
/// 0.2 s belongs to the first, which a terminal or a wrapper may send twice. The program then exits with
/// kCancelledCode and leaves no half-written file. One object at a time.
class Interrupt {
 public:
  /// isWorker: further signals are ignored, since the main process kills a worker that does not react, and nothing is
  /// printed.
  explicit Interrupt(bool isWorker = false);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  /// During its lifetime a computation polls token(). Several may exist.
  class Listening {
   public:
    Listening();
    ~Listening();
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
  };

 private:
  std::stop_source source_;
  std::jthread waiter_;
};

}  // namespace asdfvk
