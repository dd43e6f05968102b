#include "process/heap.h"

#include <doctest/doctest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <vector>

namespace {

std::atomic<size_t> adviceCount = 0;

}  // namespace

// Replaces the function of the C library in this program, to count its calls.
extern "C" int madvise(void* memory, size_t byteCount, int advice) {
  ++adviceCount;
  return static_cast<int>(::syscall(SYS_madvise, memory, byteCount, advice));
}

namespace asdfvk {
namespace {

struct alignas(256) Wide {
  uint8_t bytes[256];
};

/// The flags of the mapping that contains the address, from /proc/self/smaps.
std::string mappingFlagsAt(const void* address) {
  std::ifstream maps("/proc/self/smaps");
  bool isInside = false;
  for (std::string line; std::getline(maps, line);) {
    uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream words(line);
    if (words >> std::hex >> begin >> dash >> end && dash == '-')
      isInside = begin <= reinterpret_cast<uintptr_t>(address) && reinterpret_cast<uintptr_t>(address) < end;
    else if (isInside && line.starts_with("VmFlags:"))
      return line + " ";
  }
  return "";
}

TEST_CASE("large memory, with and without an alignment, and the heap from its start are advised to have huge pages") {
  const auto mapped = std::make_unique<std::vector<uint8_t>>(64 << 20);  // Not in the heap, but above it.
  configureHeap();
  const std::vector<uint8_t> small(64 << 10);  // Too small for an advice of its own.
  const auto plain = std::make_unique<std::vector<uint8_t>>(8 << 20);
  const auto aligned = std::make_unique<std::vector<Wide>>(1 << 15);
  CHECK(reinterpret_cast<uintptr_t>(aligned->data()) % alignof(Wide) == 0);
  ::operator delete (::operator new (1, std::align_val_t{1}), std::align_val_t{1});
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage/enabled")) {
    MESSAGE("no huge pages on this system: the advice is not tested");
    return;
  }
  CHECK(mappingFlagsAt(small.data() + small.size() / 2).find(" hg ") != std::string::npos);
  CHECK(mappingFlagsAt(mapped->data() + mapped->size() / 2).find(" hg ") != std::string::npos);
  CHECK(mappingFlagsAt(plain->data() + plain->size() / 2).find(" hg ") != std::string::npos);
  CHECK(mappingFlagsAt(aligned->data() + aligned->size() / 2).find(" hg ") != std::string::npos);
}

TEST_CASE("memory that the heap reuses is not advised again") {
  configureHeap();
  const auto allocate = [](size_t byteCount) { ::operator delete(::operator new(byteCount)); };
  allocate(8 << 20);
  const size_t countBefore = adviceCount;
  for (int i = 0; i < 100; ++i) allocate(1 << 20);
  CHECK(adviceCount == countBefore);
}

}  // namespace
}  // namespace asdfvk
