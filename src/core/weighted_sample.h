#pragma once

#include <algorithm>
#include <vector>

namespace asdfvk {

/// Numbers with weights, for quantiles. No number is NaN. Precondition of min(), max() and quantile(): there is at
/// least one number, and sort() was called.
class WeightedSample {
 public:
  void add(double number, double weight) { entries_.push_back({number, weight}); }

  void sort() {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.number != b.number ? a.number < b.number : a.weight < b.weight;
    });
    for (const Entry& entry : entries_) sum_ += entry.weight;
  }

  /// The smallest number x for which the numbers up to x have at least this share of the sum of all weights.
  [[nodiscard]] double quantile(double share) const {
    double below = 0;
    for (const Entry& entry : entries_) {
      below += entry.weight;
      if (below >= share * sum_) return entry.number;
    }
    return entries_.back().number;
  }

  [[nodiscard]] bool isEmpty() const { return entries_.empty(); }
  [[nodiscard]] double min() const { return entries_.front().number; }
  [[nodiscard]] double max() const { return entries_.back().number; }

 private:
  struct Entry {
    double number, weight;
  };
  std::vector<Entry> entries_;
  double sum_ = 0;
};

}  // namespace asdfvk
