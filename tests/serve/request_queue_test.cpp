#include "serve/request_queue.h"

#include <doctest/doctest.h>

#include <set>

#include "asdf_vk/error.h"
#include "serve/fake_computer.h"
#include "support/require_failure.h"

namespace asdfvk::test {

TEST_CASE("one thread answers in the order of the requests") {
  KeptAnswers kept;
  for (int i = 0; i < 100; ++i) kept.queue.add(i, 1, [i](const RequestContext&) { return std::to_string(i); });
  kept.queue.finish();
  REQUIRE_EQ(kept.lines.size(), 100);
  for (int i = 0; i < 100; ++i) CHECK_EQ(kept.lines[static_cast<size_t>(i)], std::to_string(i));
}

TEST_CASE("several threads answer every request once, and share the cores") {
  KeptAnswers kept(3);
  std::atomic<size_t> greatest{0}, leastSharers{99};
  for (int i = 0; i < 300; ++i)
    kept.queue.add(i, 1, [&, i](const RequestContext& context) {
      greatest = std::max(greatest.load(), context.worker);
      leastSharers = std::min(leastSharers.load(), context.sharerCount);
      return std::to_string(i);
    });
  kept.queue.finish();
  CHECK_EQ(std::set<std::string>(kept.lines.begin(), kept.lines.end()).size(), 300);
  CHECK_EQ(kept.lines.size(), 300);
  CHECK_LT(greatest, 3);
  CHECK_GE(leastSharers, 1);
}

TEST_CASE("a cancel stops running and waiting requests with its id only") {
  KeptAnswers kept;
  const auto add = [&](const Json& id, const char* mesh) {
    kept.queue.add(id, 1, [&kept, mesh](const RequestContext& context) {
      MeshRequest request;
      request.mesh = mesh;
      const MeshAnswer answer = kept.computer.compute(request, context, {});
      return answer.failure ? answer.failure->code : "done";
    });
  };
  add("running", "slow");
  add(2, "waiting");
  add(3, "kept");
  kept.computer.waitForRequests(1);
  CHECK(kept.queue.cancel(2));
  CHECK_FALSE(kept.queue.cancel("2"));
  CHECK_FALSE(kept.queue.cancel(4));
  CHECK(kept.queue.cancel("running"));
  kept.queue.finish();
  CHECK(kept.lines == std::vector<std::string>{"cancelled", "cancelled", "done"});
  CHECK_FALSE(kept.queue.cancel(3));
}

TEST_CASE("a stop from outside stops all requests, and each has an answer") {
  KeptAnswers kept;
  for (int i = 0; i < 3; ++i)
    kept.queue.add(i, 1, [&kept](const RequestContext& context) {
      MeshRequest request;
      request.mesh = "slow";
      return kept.computer.compute(request, context, {}).failure->code;
    });
  kept.computer.waitForRequests(1);
  kept.stop.request_stop();
  kept.queue.finish();
  CHECK(kept.lines == std::vector<std::string>(3, "cancelled"));
  CHECK(kept.queue.token().stop_requested());
}

TEST_CASE("a full queue waits for its requests") {
  std::atomic<size_t> open{0}, greatest{0};
  RequestQueue queue(1, 100, [](std::string_view) {}, {});
  for (int i = 0; i < 20; ++i) {
    ++open;
    queue.add(i, 60, [&](const RequestContext&) {
      greatest = std::max(greatest.load(), open.load());
      --open;
      return std::string();
    });
  }
  queue.finish();
  CHECK_LE(greatest, 3);  // One runs, one waits, and one is being added.
}

TEST_CASE("an output that fails stops the queue, and finish() throws the error") {
  RequestQueue queue(1, 100, [](std::string_view) { throw Error(ErrorCode::OutputNotWritable, "closed"); }, {});
  queue.add(1, 1, [](const RequestContext&) { return "answer"; });
  requireFailure([&] { queue.finish(); }, ErrorCode::OutputNotWritable, "closed");
  CHECK(queue.token().stop_requested());
}

}  // namespace asdfvk::test
