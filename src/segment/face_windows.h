#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/face_neighbours.h"

namespace asdfvk {

/// All faces in an order in which consecutive faces are close to each other on the surface. Each block of `blockSize`
/// faces is found by a breadth-first search, which begins at a face beside the earlier blocks.
[[nodiscard]] std::vector<uint32_t> orderByBlocks(const FaceNeighbours& neighbours, size_t blockSize);

/// The faces around a face of a block, in the order of a breadth-first search. The face is first; faces
/// [ringEnds[r - 1], ringEnds[r]) are in ring r.
struct FaceWindow {
  uint32_t centre;            ///< Index into the block.
  std::span<uint32_t> faces;  ///< Receives indices into FaceWindows::faces(); has room for faces().size() + 1 entries.
  std::span<uint32_t> ringEnds;  ///< Receives ringCount + 1 entries.
};

/// The faces within some rings around the faces of a block. The breadth-first searches from faces of the block read
/// only a small table with copies of the neighbours. Needs 4 bytes per face of the mesh.
class FaceWindows {
 public:
  explicit FaceWindows(const FaceNeighbours& neighbours)
      : neighbours_(neighbours), localOf_(neighbours.size(), kOutside) {}

  /// Precondition: the block has no face twice.
  void setBlock(std::span<const uint32_t> block, uint32_t ringCount);

  /// Fills two windows with the same number of rings. The function does a step of the first search, then a step of the
  /// second search, and so on. The processor can execute these two steps at the same time. It cannot do so with two
  /// steps of one search, because a step needs the result of the step before.
  void search(const FaceWindow& first, const FaceWindow& second);

  /// The faces around the block. Face 0 stands for a missing neighbour. Face 1 + i is face i of the block.
  [[nodiscard]] std::span<const uint32_t> faces() const { return faces_; }

 private:
  using SearchNumber = uint8_t;  ///< 8 bits, so that visitedBy_ fits into the L1 cache.
  struct Search;

  static constexpr uint32_t kOutside = kNoNeighbour;

  const FaceNeighbours& neighbours_;
  std::vector<uint32_t> localOf_;  ///< #F, index into faces_.
  std::vector<uint32_t> faces_;
  std::vector<uint32_t> rows_;  ///< The three neighbours of each face less than ringCount rings from the block.
  std::array<std::vector<SearchNumber>, 2> visitedBy_;  ///< For both windows: the last search that visited the face.
  SearchNumber searchNumber_ = 0;
};

}  // namespace asdfvk
