#include "vk/staging_ring.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/parallel.h"
#include "vk/command_list.h"

namespace asdfvk {
namespace {

constexpr uint64_t kMinPieceByteCount = 64u << 10;

/// memcpy() on several threads: one does not saturate the memory.
void copyInParallel(std::byte* to, const std::byte* from, uint64_t byteCount) {
  constexpr uint64_t kPartByteCount = 1u << 20;
  forEachTask((byteCount + kPartByteCount - 1) / kPartByteCount, [&](size_t part) {
    const uint64_t begin = part * kPartByteCount;
    std::memcpy(to + begin, from + begin, std::min(kPartByteCount, byteCount - begin));
  });
}

/// The part of a copy that goes through one piece.
struct Part {
  uint64_t begin, byteCount;
};

Part partOf(uint64_t byteCount, uint64_t index) {
  const uint64_t begin = index * StagingRing::kMaxPieceByteCount;
  return {begin, std::min(StagingRing::kMaxPieceByteCount, byteCount - begin)};
}

uint64_t partCount(uint64_t byteCount) {
  return (byteCount + StagingRing::kMaxPieceByteCount - 1) / StagingRing::kMaxPieceByteCount;
}

}  // namespace

struct StagingRing::Piece {
  explicit Piece(const Device& device) : commands(device) {}
  Buffer memory;
  CommandList commands;
};

struct StagingRing::Drain {
  StagingRing& ring;
  ~Drain() {
    for (const std::unique_ptr<Piece>& piece : ring.pieces_)
      if (piece) piece->commands.finish();
  }
};

StagingRing::StagingRing(const Device& device) : device_(device) {}
StagingRing::~StagingRing() = default;

StagingRing::Piece& StagingRing::prepare(size_t index, uint64_t byteCount) {
  std::unique_ptr<Piece>& piece = pieces_[index % kPieceCount];
  if (!piece) piece = std::make_unique<Piece>(device_);
  piece->commands.wait();
  if (piece->memory.byteCount() < byteCount)
    piece->memory =
        Buffer(device_, std::bit_ceil(std::max(byteCount, kMinPieceByteCount)),
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::HostVisible);
  piece->commands.begin();
  return *piece;
}

void StagingRing::upload(std::span<const std::byte> bytes, const Buffer& to) {
  const Drain drain{*this};
  for (uint64_t i = 0; i < partCount(bytes.size()); ++i) {
    const Part part = partOf(bytes.size(), i);
    Piece& piece = prepare(i, part.byteCount);
    copyInParallel(piece.memory.mapped(), bytes.data() + part.begin, part.byteCount);
    piece.commands.copy(piece.memory, 0, to, part.begin, part.byteCount);
    piece.commands.barrier();
    piece.commands.submit();
  }
  for (const std::unique_ptr<Piece>& piece : pieces_)
    if (piece) piece->commands.wait();
}

void StagingRing::download(const Buffer& from, std::span<std::byte> bytes) {
  const Drain drain{*this};
  for (uint64_t i = 0; i <= partCount(bytes.size()); ++i) {
    if (i < partCount(bytes.size())) {
      const Part part = partOf(bytes.size(), i);
      Piece& piece = prepare(i, part.byteCount);
      piece.commands.copy(from, part.begin, piece.memory, 0, part.byteCount);
      piece.commands.barrier();
      piece.commands.submit();
    }
    if (i == 0) continue;
    const Part part = partOf(bytes.size(), i - 1);
    Piece& piece = *pieces_[(i - 1) % kPieceCount];
    piece.commands.wait();
    copyInParallel(bytes.data() + part.begin, piece.memory.mapped(), part.byteCount);
  }
}

}  // namespace asdfvk
