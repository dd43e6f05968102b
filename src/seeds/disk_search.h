#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seeds/label_correcting.h"

namespace asdfvk {

/// Finds the disk of one face after another: the faces that are nearer to it than to all darts so far.
/// SurfaceDistances::add() would find the same faces; here they are stored in a hash table of the size of the disk.
class DiskSearch {
 public:
  /// Finds the disk of `centre`, up to `radius`. before: #F, the distances to the darts so far; one below 0 counts as
  /// unreached.
  void find(const DualGraph& graph, std::span<const float> arcLengths, std::span<const float> before, uint32_t centre,
            float radius);

  /// The faces of the last disk and their distances to the centre. The centre is the first.
  [[nodiscard]] const std::vector<FaceDistance>& members() const { return members_; }

 private:
  struct Labels;
  [[nodiscard]] size_t slotOf(uint32_t face) const;
  void insert(size_t slot, FaceDistance member);

  std::vector<FaceDistance> members_;
  std::vector<size_t> slotOfMember_;
  std::vector<uint32_t> slots_;  ///< Linear probing; index of a member + 1, or 0.
  int shift_ = 0;                ///< 32 - log2(slots)
  std::vector<PendingFace> pending_;
};

}  // namespace asdfvk
