#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <list>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/json.h"

namespace asdfvk {

/// What a request in progress can use.
struct RequestContext {
  size_t worker = 0;       ///< Index of the thread that runs the request. A thread runs one request at a time.
  size_t sharerCount = 1;  ///< Requests that share the cores, this one included.
  std::stop_token stop;    ///< Requests a stop if the request is cancelled or the program ends.
  size_t byteCount = 0;    ///< Size of the request.
};

/// Runs requests on threads while further requests arrive. With one thread, requests run in their order.
class RequestQueue {
 public:
  /// Returns the line of the answer; empty: no answer.
  using Work = std::function<std::string(const RequestContext& context)>;
  using Write = std::function<void(std::string_view line)>;

  /// write: writes a line; thread-safe. If it fails, all requests are stopped. stop: stops all requests.
  RequestQueue(size_t threadCount, size_t maxBytes, Write write, const std::stop_token& stop);
  ~RequestQueue();
  RequestQueue(const RequestQueue&) = delete;
  RequestQueue& operator=(const RequestQueue&) = delete;

  /// Waits while the requests that have not begun have more than maxBytes or kMaxWaiting members.
  void add(Json id, size_t byteCount, Work work);
  /// Requests a stop of all requests with this id. Returns false if there is none that has no answer yet.
  bool cancel(const Json& id);
  /// Writes a line at once.
  void answer(std::string_view line);
  /// Requests a stop if no further request is useful.
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
  /// Waits for the answers of all requests. No request may be added later. Throws the error of `write`.
  void finish();

  static constexpr size_t kMaxWaiting = 100'000;

 private:
  struct Entry {
    Json id;
    size_t byteCount = 0;
    Work work;
    std::stop_source stop = {};
  };
  using Entries = std::list<Entry>;
  struct StopAll {
    RequestQueue& queue;
    void operator()() const { queue.stopAll(); }
  };

  void runRequests(size_t worker);
  void stopAll();

  const size_t threadCount_, maxBytes_;
  const Write write_;
  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Entries waiting_, running_;
  size_t waitingBytes_ = 0;
  bool isFinished_ = false;
  std::exception_ptr failure_;  ///< The first error of `write`.
  std::stop_callback<StopAll> onStop_;
  std::vector<std::jthread> threads_;
};

}  // namespace asdfvk
