#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace asdfvk {

/// Calls body(row) for each row on all cores; a body that writes its own row only gives the same bits on any number.
template <typename Body>
void forEachRow(size_t rowCount, const Body& body) {
  constexpr size_t kGrain = 4096;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, rowCount, kGrain), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t row = range.begin(); row < range.end(); ++row) body(row);
  });
}

}  // namespace asdfvk
