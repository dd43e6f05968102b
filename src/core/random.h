#pragma once

#include <cstdint>
#include <span>
#include <utility>

namespace asdfvk {

/// A seeded generator (SplitMix64, Steele, Lea and Flood 2014). Unlike std::shuffle and the std distributions, Random
/// gives the same numbers with every standard library.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  [[nodiscard]] uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// A uniformly distributed number in [0, bound), without bias. Precondition: bound > 0.
  [[nodiscard]] uint32_t index(uint32_t bound) {
    const uint32_t threshold = (0u - bound) % bound;
    for (;;) {
      const uint64_t product = (next() >> 32) * bound;
      if (static_cast<uint32_t>(product) >= threshold) return static_cast<uint32_t>(product >> 32);
    }
  }

  /// A uniformly distributed number in [0, 1).
  [[nodiscard]] double real() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  template <typename T>
  void shuffle(std::span<T> items) {
    for (size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[index(static_cast<uint32_t>(i))]);
  }

 private:
  uint64_t state_;
};

}  // namespace asdfvk
