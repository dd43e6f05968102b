#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "seeds/disk_search.h"
#include "seeds/surface_distances.h"

namespace asdfvk {

/// Throws several darts in parallel, with the result of throwing them one after another: the darts that are accepted
/// are the lexicographically first maximal independent set of the conflicts between the faces of the block (Blelloch,
/// Fineman and Shun, "Greedy sequential maximal independent set and matching are parallel on average", 2012).
///
///   1. In parallel: faces nearer than the radius to an earlier dart are rejected; the others are open.
///   2. In parallel: each open face searches its disk for the faces that it would be nearest to. Of these, those of the
///      block are conflicts.
///   3. In order: an open face that no accepted face of the block has reached is accepted.
///   4. In parallel: the disks of the accepted faces lower the distances.
///
/// Disks of open faces that step 3 rejects were searched in vain.
class DartBlock {
 public:
  /// `distances` must outlive this object.
  explicit DartBlock(SurfaceDistances& distances) : distances_(distances) {}

  /// Throws at the faces in order, until `maxDarts` are accepted and one more could be. radius: as for
  /// SurfaceDistances::add(). No face occurs twice.
  void throwAt(std::span<const uint32_t> faces, float radius, uint64_t maxDarts);

  /// Distance in the last throw of faces[position] to all darts before it.
  [[nodiscard]] float distanceAt(size_t position) const { return throws_[position].whenThrown; }
  /// The positions of the accepted faces, ascending.
  [[nodiscard]] const std::vector<uint32_t>& darts() const { return darts_; }
  /// Number of faces whose disk was searched.
  [[nodiscard]] uint64_t openCount() const { return open_.size(); }
  /// More than maxDarts could be accepted. The distances are then unspecified.
  [[nodiscard]] bool isOverfull() const { return isOverfull_; }

 private:
  struct Throw {
    float whenThrown = 0;  ///< Distance to earlier darts, of this block too.
    float afterwards = 0;  ///< Distance to all darts up to the last one of the block.
  };
  /// A face of the block in the disk of an open face.
  struct Conflict {
    float distance = 0;
    uint32_t position = 0;
  };
  struct Disk {
    size_t reachedEnd = 0, conflictEnd = 0;
  };
  /// The disks of successive open faces, searched by one task.
  struct Disks {
    std::vector<FaceDistance> reached;  ///< Faces that are not of the block.
    std::vector<Conflict> conflicts;
    std::vector<Disk> ends;
    std::vector<uint8_t> isDart;
  };

  void read(std::span<const uint32_t> faces);
  void search(std::span<const uint32_t> faces, float radius);
  void decide(float radius, uint64_t maxDarts);
  void write(std::span<const uint32_t> faces);

  SurfaceDistances& distances_;
  std::vector<Throw> throws_;   ///< One per position in the block.
  std::vector<uint32_t> open_;  ///< Positions, ascending.
  std::vector<Disks> disks_;
  std::vector<uint32_t> darts_;
  PerThread<DiskSearch> searches_;
  bool isOverfull_ = false;
};

}  // namespace asdfvk
