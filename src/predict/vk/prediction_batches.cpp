#include "predict/vk/prediction_batches.h"

#include <algorithm>

#include "core/parallel.h"
#include "shared/prediction_layout.h"

namespace asdfvk {

PredictionBatches::PredictionBatches(const PredictionInput& input)
    : input_(input),
      hasEarlierSeeds_(input.hits.seeds.size(), 0),
      faceCounts_(input.hits.seeds.size(), 0),
      placeOf_(input.hits.seeds.size(), kNoSeed) {
  forEachInParallel(input.order.size(), [&](size_t i) {
    const uint32_t cell = input.order[i];
    const std::span<const uint32_t> faces = input.cells[cell];
    hasEarlierSeeds_[cell] = input.hasEarlierSeeds(cell) ? 1 : 0;
    faceCounts_[cell] = static_cast<uint32_t>(
        hasEarlierSeeds_[cell] ? std::ranges::count_if(faces, [&](uint32_t face) { return !isKept(cell, face); })
                               : static_cast<std::ptrdiff_t>(faces.size()));
  });
  for (const uint32_t count : faceCounts_) allFaceCount_ += count;
}

bool PredictionBatches::next(const PredictionBatchSize& size) {
  finishBatch();
  for (; nextCell_ < input_.order.size(); ++nextCell_, nextFace_ = 0) {
    const uint32_t cell = input_.order[nextCell_];
    if (faceCounts_[cell] == 0) continue;
    if (batchFaceCount_ == size.maxFaceCount || seeds_.size() + kMaxContributingSeedCount > size.maxSeedCount) break;
    addSeeds(cell);
    const auto count =
        static_cast<uint32_t>(std::min<size_t>(faceCounts_[cell] - nextFace_, size.maxFaceCount - batchFaceCount_));
    parts_.push_back({cell, nextFace_, count, static_cast<uint32_t>(batchFaceCount_)});
    batchFaceCount_ += count;
    nextFace_ += count;
    if (nextFace_ < faceCounts_[cell]) break;
  }
  return !parts_.empty();
}

void PredictionBatches::finishBatch() {
  doneCount_ += batchFaceCount_;
  for (const uint32_t seed : seeds_) placeOf_[seed] = kNoSeed;
  parts_.clear();
  seeds_.clear();
  batchFaceCount_ = 0;
}

void PredictionBatches::addSeeds(uint32_t cell) {
  for (const uint32_t seed : input_.nearest.of(cell)) {
    if (placeOf_[seed] != kNoSeed) continue;
    placeOf_[seed] = static_cast<uint32_t>(seeds_.size());
    seeds_.push_back(seed);
  }
}

template <typename Visit>
void PredictionBatches::forEachNode(const Part& part, const Visit& visit) const {
  const std::span<const uint32_t> nodes = input_.cells[part.cell];
  if (faceCounts_[part.cell] == nodes.size()) {
    std::ranges::for_each(nodes.subspan(part.firstFace, part.faceCount), visit);
    return;
  }
  uint32_t index = 0;
  for (const uint32_t node : nodes) {
    if (isKept(part.cell, node)) continue;
    if (index >= part.firstFace + part.faceCount) break;
    if (index++ >= part.firstFace) visit(node);
  }
}

void PredictionBatches::write(std::span<uint32_t> work) const {
  forEachInParallel(parts_.size(), [&](size_t i) {
    const Part& part = parts_[i];
    uint32_t* item = &work[2 * size_t{part.firstItem}];
    forEachNode(part, [&](uint32_t node) {
      *item++ = input_.domain.faceOf(node);
      *item++ = static_cast<uint32_t>(i);
    });
    const std::span<uint32_t> seeds =
        work.subspan(2 * batchFaceCount_ + i * kMaxContributingSeedCount, kMaxContributingSeedCount);
    std::ranges::fill(seeds, kNoSeed);
    std::ranges::transform(input_.nearest.of(part.cell), seeds.begin(), [&](uint32_t seed) { return placeOf_[seed]; });
  });
}

}  // namespace asdfvk
