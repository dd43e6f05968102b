#pragma once

#include <stop_token>
#include <thread>

namespace asdfvk {

/// While it lives, SIGINT, SIGTERM and SIGHUP (those that were not ignored) are ours. A first one asks the computation
/// to stop where there is one, and ends the program at once where there is none and thus nothing to leave half done; a
/// second one always ends it at once, with ExitCode::Cancelled and without a half-written file. One object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  /// Marks the time in which a stop request is listened to.
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
