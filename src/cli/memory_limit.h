#pragma once

#include <cstdint>
#include <list>
#include <mutex>
#include <stop_token>
#include <thread>

namespace asdfvk {

/// Stops requests if the resident memory of this process exceeds a limit. The memory is measured every 10 ms. If it
/// exceeds the limit, the largest request is stopped, and 0.1 s later the next one. A computation notices a stop
/// between its steps, so that the process may exceed the limit for a short time.
class MemoryLimit {
 public:
  /// bytes: 0: no limit.
  explicit MemoryLimit(uint64_t bytes);

  [[nodiscard]] uint64_t bytes() const { return bytes_; }

  /// A request in progress.
  class Request {
   public:
    /// byteCount: size of its mesh. outer: another reason to stop it.
    Request(MemoryLimit& limit, uint64_t byteCount, const std::stop_token& outer);
    ~Request();
    Request(const Request&) = delete;
    Request& operator=(const Request&) = delete;

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
    /// Whether the limit requested the stop.
    [[nodiscard]] bool hasExceeded() const;

   private:
    friend class MemoryLimit;
    struct Forward {
      std::stop_source& source;
      void operator()() const noexcept { source.request_stop(); }
    };

    MemoryLimit& limit_;
    uint64_t byteCount_;
    bool hasExceeded_ = false;
    std::stop_source source_;
    std::stop_callback<Forward> forward_;
  };

 private:
  void watch(const std::stop_token& ending);
  /// Requests a stop of the largest request that has none. Returns whether there is one.
  bool stopLargest();

  uint64_t bytes_;
  mutable std::mutex mutex_;
  std::list<Request*> requests_;
  std::jthread watcher_;
};

}  // namespace asdfvk
