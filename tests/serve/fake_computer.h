#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "asdf_vk/error.h"
#include "serve/mesh_request.h"
#include "support/kept_json.h"

namespace asdfvk::test {

/// Answers requests without a computation. A request for the mesh "slow" waits for its stop, and the mesh "missing"
/// cannot be read.
class FakeComputer : public RequestComputer {
 public:
  [[nodiscard]] MeshAnswer compute(const MeshRequest& request, const RequestContext& context,
                                   const std::function<void(double)>& progress) override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      requests_.push_back(request);
      begun_.notify_all();
    }
    if (progress)
      for (const double fraction : {0.1, 0.1, 0.6, 0.5, 1.0}) {
        progress(fraction);
        std::this_thread::sleep_for(std::chrono::milliseconds(110));  // Longer than between two notifications.
      }
    if (request.mesh == "slow") waitForStop(context.stop);
    if (context.stop.stop_requested()) return failed(nameOf(ErrorCode::Cancelled), "cancelled", 130);
    if (request.mesh == "missing") return failed(nameOf(ErrorCode::UnreadableInput), "missing: cannot be opened", 2);
    MeshAnswer answer;
    answer.report = jsonText({{"mesh", request.mesh}, {"verdict", "failed"}});
    answer.rows = {{"thickness", "FAIL: 1 wall thinner than 0.8"}, {"mesh", "12 faces"}};
    if (request.picture) answer.picture = AnsweredFile{"png", "cGljdHVyZQ=="};
    if (request.mesh == "thin") answer.failure = RequestFailure{"tooThin", "FAIL: 1 wall thinner than 0.8", 6};
    return answer;
  }

  void waitForRequests(size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    begun_.wait(lock, [&] { return requests_.size() >= count; });
  }
  [[nodiscard]] std::vector<MeshRequest> requests() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return requests_;
  }

 private:
  static MeshAnswer failed(const std::string& code, const std::string& message, int exitCode) {
    MeshAnswer answer;
    answer.failure = RequestFailure{code, message, exitCode};
    return answer;
  }
  static void waitForStop(const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock<std::mutex> lock(mutex);
    never.wait(lock, stop, [] { return false; });
  }

  mutable std::mutex mutex_;
  std::condition_variable begun_;
  std::vector<MeshRequest> requests_;
};

/// A queue whose answers are kept.
struct KeptAnswers {
  FakeComputer computer;
  std::mutex mutex;
  std::vector<std::string> lines;
  std::stop_source stop;
  RequestQueue queue;

  explicit KeptAnswers(size_t threadCount = 1)
      : queue(
            threadCount, size_t{1} << 20, [this](std::string_view line) { keep(line); }, stop.get_token()) {}

  void keep(std::string_view line) {
    const std::lock_guard<std::mutex> lock(mutex);
    lines.emplace_back(line);
  }
  /// The answers of all lines, as JSON.
  template <typename Protocol>
  std::vector<Json> answersTo(const std::vector<std::string>& requests) {
    Protocol protocol(queue, computer);
    for (const std::string& request : requests) protocol.receive({request});
    queue.finish();
    std::vector<Json> answers;
    for (const std::string& line : lines) {
      const bool isFake = line.find("\"report\"") != std::string::npos;
      if (!isFake && line.starts_with("{\"formatVersion\"")) keepJson(line);
      answers.push_back(Json::parse(line));
    }
    return answers;
  }
};

}  // namespace asdfvk::test
