#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/face_neighbours.h"

namespace asdfvk {

/// All faces in an order in which consecutive faces are close to each other on the surface. Each block of `blockSize`
/// faces is found by a breadth-first search, which begins at a face beside the earlier blocks.
[[nodiscard]] std::vector<uint32_t> orderByBlocks(const FaceNeighbours& neighbours, size_t blockSize);

/// The faces within some rings around the faces of a block. The breadth-first search from a face of the block reads
/// only a small table with copies of the neighbours. Needs 4 bytes per face of the mesh.
class FaceWindows {
 public:
  explicit FaceWindows(const FaceNeighbours& neighbours)
      : neighbours_(neighbours), localOf_(neighbours.size(), kOutside) {}

  /// Precondition: the block has no face twice.
  void setBlock(std::span<const uint32_t> block, uint32_t ringCount);

  /// Finds the faces around face i of the block, in the order of a breadth-first search. Face i is first; faces
  /// [ringEnds[r - 1], ringEnds[r]) are in ring r. window: receives indices into faces(); has room for faces().size() +
  /// 1 entries. ringEnds: ringCount + 1 entries.
  void search(uint32_t i, std::span<uint32_t> window, std::span<uint32_t> ringEnds);

  /// The faces around the block. Face 0 stands for a missing neighbour. Face 1 + i is face i of the block.
  [[nodiscard]] std::span<const uint32_t> faces() const { return faces_; }

 private:
  static constexpr uint32_t kOutside = kNoNeighbour;

  const FaceNeighbours& neighbours_;
  std::vector<uint32_t> localOf_;  ///< #F, index into faces_.
  std::vector<uint32_t> faces_;
  std::vector<uint32_t> rows_;       ///< The three neighbours of each face less than ringCount rings from the block.
  std::vector<uint32_t> visitedBy_;  ///< The last search that visited the face.
  uint32_t searchCount_ = 0;
};

}  // namespace asdfvk
