#include "cli/memory_limit.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "batch/process_memory.h"

namespace asdfvk::test {

TEST_CASE("beyond the memory limit the largest request is stopped first") {
  constexpr uint64_t kSpare = uint64_t{100} << 20;
  MemoryLimit limit(residentBytesOf(getpid()) + kSpare);
  const MemoryLimit::Request small(limit, 10, {}), large(limit, 1000, {});
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK_FALSE(large.token().stop_requested());
  CHECK_FALSE(large.hasExceeded());
  {
    const std::vector<char> memory(3 * kSpare, 1);
    for (int i = 0; i < 12'000 && !large.token().stop_requested(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK_EQ(memory.back(), 1);
  }
  CHECK(large.token().stop_requested());
  CHECK(large.hasExceeded());
}

TEST_CASE("without a memory limit only another reason stops a request") {
  MemoryLimit limit(0);
  std::stop_source stop;
  const MemoryLimit::Request request(limit, 1, stop.get_token());
  CHECK_FALSE(request.token().stop_requested());
  stop.request_stop();
  CHECK(request.token().stop_requested());
  CHECK_FALSE(request.hasExceeded());
}

}  // namespace asdfvk::test
