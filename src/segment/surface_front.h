#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "segment/part_surface.h"

namespace asdfvk {

/// The distance of each face to the nearest source along arcs, and the label of this source. Dijkstra's algorithm with
/// buckets instead of a heap: faces of a bucket are processed in the order of addition. A face whose distance decreases
/// later is processed again. Deterministic. An object reuses its memory.
class SurfaceFront {
 public:
  using Arc = PartSurface::Arc;
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  /// Keeps views of the arguments. arcs: compressed rows; no length is negative. stop: after a stop request, advance()
  /// ends early.
  SurfaceFront(std::span<const uint32_t> offsets, std::span<const Arc> arcs, std::stop_token stop = {})
      : offsets_(offsets),
        arcs_(arcs),
        stop_(std::move(stop)),
        distances_(offsets.size() - 1, kUnreached),
        labels_(offsets.size() - 1, 0),
        buckets_(kBucketCount) {
    double sum = 0;
    for (const Arc& arc : arcs) sum += std::isfinite(arc.length) ? double{arc.length} : 0;
    const double width = sum > 0 ? kWidthOverMeanLength * sum / static_cast<double>(arcs.size()) : 1;
    perWidth_ = static_cast<float>(1 / width);
  }

  /// Makes a face a source at this distance. Has no effect if the face already has a distance that is not greater.
  /// advance() computes the distances of other faces. A distance of NaN or infinity is ignored.
  void add(uint32_t face, float distance, uint32_t label) {
    if (!(distance < distances_[face])) return;
    if (distances_[face] == kUnreached) touched_.push_back(face);
    distances_[face] = distance;
    labels_[face] = label;
    put({distance, face});
  }

  /// Computes all distances up to `limit`, over faces for which mayEnter(face) is true. After a stop request, distances
  /// and labels are incomplete, and only the destructor may be called.
  template <typename MayEnter>
  void advance(float limit, const MayEnter& mayEnter) {
    for (current_ = 0; entryCount_ > 0 && !stop_.stop_requested(); ++current_) {
      std::vector<Entry>& bucket = buckets_[current_ % kBucketCount];
      for (size_t i = 0; i < bucket.size(); ++i) {
        const Entry entry = bucket[i];
        if (entry.distance > distances_[entry.face]) continue;
        if (bucketOf(entry.distance) > current_) {  // The distance was beyond the last bucket when the entry was added.
          put(entry);
          continue;
        }
        const uint32_t label = labels_[entry.face];
        for (uint32_t row = offsets_[entry.face]; row < offsets_[entry.face + 1]; ++row) {
          const Arc& arc = arcs_[row];
          const float distance = entry.distance + arc.length;
          if (distance < distances_[arc.face] && distance <= limit && mayEnter(arc.face))
            add(arc.face, distance, label);
        }
      }
      entryCount_ -= bucket.size();
      bucket.clear();
    }
    current_ = 0;
  }
  void advance() {
    advance(kUnreached, [](uint32_t) { return true; });
  }

  void clear() {
    for (const uint32_t face : touched_) distances_[face] = kUnreached;
    touched_.clear();
  }

  /// #F, kUnreached if no source reaches the face.
  [[nodiscard]] std::span<const float> distances() const { return distances_; }
  [[nodiscard]] std::span<const uint32_t> labels() const { return labels_; }    ///< #F, meaningless if unreached.
  [[nodiscard]] std::span<const uint32_t> reached() const { return touched_; }  ///< Each face once.

 private:
  struct Entry {
    float distance;
    uint32_t face;
  };
  static constexpr size_t kBucketCount = 64;
  static constexpr double kWidthOverMeanLength = 0.5;

  [[nodiscard]] size_t bucketOf(float distance) const {
    return static_cast<size_t>(std::min(distance * perWidth_, 1e9f));
  }
  void put(const Entry& entry) {
    const size_t bucket = std::clamp(bucketOf(entry.distance), current_, current_ + kBucketCount - 1);
    buckets_[bucket % kBucketCount].push_back(entry);
    ++entryCount_;
  }

  std::span<const uint32_t> offsets_;
  std::span<const Arc> arcs_;
  std::stop_token stop_;
  std::vector<float> distances_;
  std::vector<uint32_t> labels_, touched_;
  std::vector<std::vector<Entry>> buckets_;  ///< A ring buffer of the buckets from current_ on.
  size_t current_ = 0, entryCount_ = 0;
  float perWidth_ = 1;
};

}  // namespace asdfvk
