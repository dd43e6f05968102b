#include "io/row_blocks.h"

#include <algorithm>
#include <vector>

#include "core/atomic_file.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

// A block of a usual PLY has 200 KiB: it fits into the cache of a processor, and takes far longer than the overhead of
// a task.
constexpr uint64_t kRowsPerBlock = 8192;

}  // namespace

void writeRowBlocks(AtomicFile& file, uint64_t rowCount, FunctionRef<void(ByteBuffer&, uint64_t, uint64_t)> putRows) {
  const size_t blockCount = (rowCount + kRowsPerBlock - 1) / kRowsPerBlock;
  // One block per thread is made while another block per thread waits until the preceding blocks are written.
  std::vector<ByteBuffer> blocks(std::min(2 * threadLimit(), blockCount));
  forEachInOrder(
      blockCount, blocks.size(),
      [&](size_t block, size_t slot) {
        blocks[slot].clear();
        putRows(blocks[slot], block * kRowsPerBlock, std::min(rowCount, (block + 1) * kRowsPerBlock));
      },
      [&](size_t, size_t slot) { file.write(blocks[slot].written()); });
}

}  // namespace asdfvk
