#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "predict/prediction.h"

namespace asdfvk {

/// Largest numbers of seeds and faces in one batch.
struct PredictionBatchSize {
  size_t maxSeedCount = 0, maxFaceCount = 0;  ///< At least kMaxContributingSeedCount seeds and 1 face.
};

/// Divides the faces of an input into batches. A batch has cells that are close in space and the seeds that contribute
/// to them. Faces whose earlier values are kept are left out.
class PredictionBatches {
 public:
  /// The input must outlive this object.
  explicit PredictionBatches(const PredictionInput& input);

  /// Whether a node of the cell keeps its earlier value.
  [[nodiscard]] bool isKept(uint32_t cell, uint32_t node) const {
    return hasEarlierSeeds_[cell] && input_.earlier.cellOf[node] == cell;
  }
  /// Number of faces in all batches together.
  [[nodiscard]] size_t allFaceCount() const { return allFaceCount_; }
  /// Whether no face is left after the current batch.
  [[nodiscard]] bool isLast() const { return doneCount_ + batchFaceCount_ == allFaceCount_; }

  /// Makes the next batch. Returns false if no face is left.
  bool next(const PredictionBatchSize& size);
  /// Counts and seeds of the current batch.
  [[nodiscard]] size_t faceCount() const { return batchFaceCount_; }
  [[nodiscard]] size_t cellCount() const { return parts_.size(); }
  [[nodiscard]] std::span<const uint32_t> seeds() const { return seeds_; }
  /// Writes faces and cells of the current batch in the layout that is described at PredictionPush.
  void write(std::span<uint32_t> work) const;

 private:
  /// A cell, or a part of one.
  struct Part {
    uint32_t cell, firstFace, faceCount;  // Faces that are kept are not counted.
    uint32_t firstItem;
  };

  void finishBatch();
  void addSeeds(uint32_t cell);
  template <typename Visit>
  void forEachNode(const Part& part, const Visit& visit) const;

  const PredictionInput& input_;
  std::vector<uint8_t> hasEarlierSeeds_;  // One entry per cell.
  std::vector<uint32_t> faceCounts_;      // One entry per cell.
  size_t allFaceCount_ = 0, doneCount_ = 0;
  size_t nextCell_ = 0;  // Index in the order of the input.
  uint32_t nextFace_ = 0;

  std::vector<Part> parts_;
  std::vector<uint32_t> seeds_;
  std::vector<uint32_t> placeOf_;  // For each seed, its place in the batch, or kNoSeed.
  size_t batchFaceCount_ = 0;
};

}  // namespace asdfvk
