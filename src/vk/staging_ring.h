#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "vk/buffer.h"

namespace asdfvk {

class CommandList;

/// Copies between host memory and buffers that are not mapped, through mapped pieces: the host fills or empties one
/// piece while the device copies the other. The pieces are kept; they grow with the largest copy so far, up to
/// kMaxPieceByteCount.
class StagingRing {
 public:
  static constexpr size_t kPieceCount = 2;
  static constexpr uint64_t kMaxPieceByteCount = 8u << 20;

  /// The device must outlive it. Allocates nothing yet.
  explicit StagingRing(const Device& device);
  ~StagingRing();

  /// Copies to the first bytes of `to` (VK_BUFFER_USAGE_TRANSFER_DST_BIT); later submissions see them.
  void upload(std::span<const std::byte> bytes, const Buffer& to);
  /// The first bytes of `from` (VK_BUFFER_USAGE_TRANSFER_SRC_BIT).
  void download(const Buffer& from, std::span<std::byte> bytes);

 private:
  struct Piece;
  /// Ends the work of the pieces, also when an exception is thrown.
  struct Drain;
  Piece& prepare(size_t index, uint64_t byteCount);

  const Device& device_;
  std::array<std::unique_ptr<Piece>, kPieceCount> pieces_;
};

}  // namespace asdfvk
