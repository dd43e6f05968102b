#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "core/parallel.h"
#include "core/unset_vector.h"

namespace asdfvk {

/// Disjoint sets of the items [0, itemCount), merged by any number of threads at once; each set is identified by its
/// lowest item (Anderson and Woll 1991, "Wait-free parallel algorithms for the union-find problem", with links to the
/// lower index).
class DisjointSets {
 public:
  explicit DisjointSets(size_t itemCount) : parents_(itemCount) {
    forEachInParallel(itemCount, [&](uint32_t item) { parents_[item] = item; });
  }

  [[nodiscard]] uint32_t lowestOf(uint32_t item) {
    for (;;) {
      const uint32_t parent = load(item);
      if (parent == item) return item;
      const uint32_t grandparent = load(parent);
      if (parent == grandparent) return parent;
      parentOf(item).store(grandparent, std::memory_order_relaxed);  // Path halving: any ancestor is valid.
      item = grandparent;
    }
  }

  /// Returns whether the items were in different sets.
  bool join(uint32_t a, uint32_t b) {
    for (;;) {
      a = lowestOf(a);
      b = lowestOf(b);
      if (a == b) return false;
      if (a < b) std::swap(a, b);
      uint32_t expected = a;
      if (parentOf(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return true;
    }
  }

 private:
  [[nodiscard]] std::atomic_ref<uint32_t> parentOf(uint32_t item) { return std::atomic_ref<uint32_t>(parents_[item]); }
  [[nodiscard]] uint32_t load(uint32_t item) { return parentOf(item).load(std::memory_order_relaxed); }

  UnsetVector<uint32_t> parents_;  ///< The parent of an item is never above the item.
};

}  // namespace asdfvk
