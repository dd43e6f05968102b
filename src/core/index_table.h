#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace asdfvk {

/// A hash table from a few of many indices to values, with linear probing; at most half full. Keeps its memory.
template <typename Value>
class IndexTable {
 public:
  static constexpr uint32_t kNoIndex = std::numeric_limits<uint32_t>::max();  ///< Not allowed as an index.

  struct Entry {
    uint32_t index = kNoIndex;
    Value value{};
  };

  void clear() { resetFor(entries_.size() / 2); }
  /// Removes all entries. Further entries keep their addresses while there are at most `count`.
  void resetFor(size_t count) {
    entries_.assign(std::bit_ceil(2 * count), {});
    count_ = 0;
  }

  /// The entry of the index, and whether the entry is new. A new entry has the value Value{}.
  std::pair<Entry&, bool> add(uint32_t index) {
    Entry* entry = &placeOf(index);
    if (entry->index == index) return {*entry, false};
    if (2 * (count_ + 1) > entries_.size()) {
      grow();
      entry = &placeOf(index);
    }
    ++count_;
    entry->index = index;
    return {*entry, true};
  }
  /// Precondition: the index has an entry.
  [[nodiscard]] Value& operator[](uint32_t index) { return placeOf(index).value; }

 private:
  /// The entry of the index, or the empty entry for the index.
  Entry& placeOf(uint32_t index) {
    for (size_t place = index * 0x9e37'79b1u;; ++place) {  // Knuth's multiplicative hash.
      Entry& entry = entries_[place & (entries_.size() - 1)];
      if (entry.index == index || entry.index == kNoIndex) return entry;
    }
  }
  void grow() {
    std::vector<Entry> earlier(2 * entries_.size());
    earlier.swap(entries_);
    for (const Entry& entry : earlier)
      if (entry.index != kNoIndex) placeOf(entry.index) = entry;
  }

  std::vector<Entry> entries_ = std::vector<Entry>(256);  ///< The size is a power of two.
  size_t count_ = 0;
};

}  // namespace asdfvk
