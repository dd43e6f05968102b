#pragma once

namespace asdfvk {

/// Makes the allocator of the program reuse freed memory and ask for huge pages, because the kernel needs time for each
/// new page. All threads share one heap, so that a thread can reuse memory that another thread freed. Every program
/// that links this layer has the operators `new` and `delete` of heap.cpp, which ask for huge pages. With jemalloc or
/// mimalloc instead, whole runs take up to 1.5 times as long (bench/experiments.md).
void configureHeap();

}  // namespace asdfvk
