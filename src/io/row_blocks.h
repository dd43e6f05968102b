#pragma once

#include <cstdint>

#include "core/byte_output.h"
#include "core/function_ref.h"

namespace asdfvk {

class AtomicFile;

/// Writes rows in their order. putRows(to, begin, end) appends the rows [begin, end). The calls of putRows() are in
/// parallel, and their ranges do not depend on the number of threads. Keeps a few blocks of rows in memory.
void writeRowBlocks(AtomicFile& file, uint64_t rowCount,
                    FunctionRef<void(ByteBuffer& to, uint64_t begin, uint64_t end)> putRows);

/// Like writeRowBlocks(), but putRow(to, row) appends one row.
template <typename PutRow>
void writeRows(AtomicFile& file, uint64_t rowCount, const PutRow& putRow) {
  writeRowBlocks(file, rowCount, [&](ByteBuffer& to, uint64_t begin, uint64_t end) {
    for (uint64_t row = begin; row < end; ++row) putRow(to, row);
  });
}

}  // namespace asdfvk
