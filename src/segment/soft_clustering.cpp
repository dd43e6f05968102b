#include "segment/soft_clustering.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/options.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr uint32_t kMaxMoveCount = 10, kMaxMaximizationCount = 10;
constexpr double kMinProduct = 1e-200;
constexpr double kConvergedChange = 1e-3;  ///< The iteration ends at a smaller relative change of the likelihood.

/// The generator rand48 of POSIX with CGAL's seed.
class Rand48 {
 public:
  Rand48() { static_cast<void>(next()); }  // CGAL does not use the first number.

  uint32_t next() {
    constexpr uint64_t kMask = (uint64_t{1} << 48) - 1;
    state_ = (state_ * 0x5DEECE66D + 11) & kMask;
    return static_cast<uint32_t>(state_ >> 17);
  }

  /// A number in [0, count), computed as in boost::uniform_int.
  size_t index(size_t count) {
    const size_t bucket = kRange / count;
    for (;;)
      if (const size_t drawn = next() / bucket; drawn < count) return drawn;
  }

  /// A number in [0, 1).
  double real() { return next() / static_cast<double>(kRange); }

 private:
  static constexpr size_t kRange = size_t{1} << 31;
  uint64_t state_ = uint64_t{1340818006} << 16 | 0x330E;
};

[[noreturn]] void refuse(uint32_t clusterCount) {
  throw Error(ErrorCode::TooFewValues, fmt::format("fewer than {} different values; {} clusters need at least as many",
                                                   clusterCount, clusterCount));
}

void requireDifferentValues(std::span<const double> values, uint32_t clusterCount) {
  std::vector<double> different;
  for (const double value : values) {
    if (different.size() == clusterCount) return;
    if (std::find(different.begin(), different.end(), value) == different.end()) different.push_back(value);
  }
  if (different.size() < clusterCount) refuse(clusterCount);
}

/// Draws each further seed with a probability proportional to the squared distance to the nearest earlier seed.
std::vector<double> chooseSeeds(std::span<const double> values, uint32_t clusterCount) {
  Rand48 random;
  std::vector<double> seeds{values[random.index(values.size())]};
  std::vector<double> squares(values.size(), std::numeric_limits<double>::infinity());
  while (seeds.size() < clusterCount) {
    double total = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      const double distance = values[i] - seeds.back();
      squares[i] = std::min(squares[i], distance * distance);
      total += squares[i];
    }
    if (total == 0) refuse(clusterCount);  // The squares of all distances are too small for a double.
    const double target = random.real() * total;
    size_t chosen = 0, i = 0;
    for (double sum = 0; i < values.size() && !(sum > target); ++i)
      if (squares[i] > 0) {
        sum += squares[i];
        chosen = i;
      }
    seeds.push_back(values[chosen]);
  }
  return seeds;
}

/// Returns whether a value changed its cluster. If several centres are equally near, the first one is taken.
bool assignToNearest(std::span<const double> values, std::span<const double> centres, std::span<uint32_t> clusterOf) {
  bool isChanged = false;
  for (size_t i = 0; i < values.size(); ++i) {
    uint32_t nearest = 0;
    double least = std::abs(values[i] - centres[0]);
    for (uint32_t c = 1; c < centres.size(); ++c) {
      const double distance = std::abs(values[i] - centres[c]);
      nearest = distance < least ? c : nearest;
      least = std::min(least, distance);
    }
    isChanged |= clusterOf[i] != nearest;
    clusterOf[i] = nearest;
  }
  return isChanged;
}

/// Moves each centre to the mean of its values. A centre without values is not moved.
void moveToMeans(std::span<const double> values, std::span<const uint32_t> clusterOf, std::span<double> centres) {
  std::vector<double> sums(centres.size()), counts(centres.size());
  for (size_t i = 0; i < values.size(); ++i) {
    sums[clusterOf[i]] += values[i];
    ++counts[clusterOf[i]];
  }
  for (size_t c = 0; c < centres.size(); ++c)
    if (counts[c] > 0) centres[c] = sums[c] / counts[c];
}

struct Gaussian {
  double mean, deviation, weight;
  double factor = weight / deviation, exponent = -0.5 / (deviation * deviation);

  /// The density without the factor 1 / sqrt(2 pi). A Gaussian with deviation 0 has the density 1 at the mean, else 0.
  [[nodiscard]] double density(double value) const {
    const double distance = value - mean;
    if (std::isinf(exponent)) return distance == 0 ? weight : 0;
    return factor * std::exp(exponent * distance * distance);
  }
};

class Mixture {
 public:
  Mixture(std::span<const double> values, const HardClustering& clusters)
      : values_(values), probabilities_(values.size() * clusters.centres.size()) {
    std::vector<double> squares(clusters.centres.size()), counts(clusters.centres.size());
    for (size_t i = 0; i < values.size(); ++i) {
      const double distance = values[i] - clusters.centres[clusters.clusterOf[i]];
      squares[clusters.clusterOf[i]] += distance * distance;
      ++counts[clusters.clusterOf[i]];
    }
    const double weight = 1.0 / static_cast<double>(clusters.centres.size());
    for (size_t c = 0; c < clusters.centres.size(); ++c)
      gaussians_.push_back({clusters.centres[c], counts[c] > 0 ? std::sqrt(squares[c] / counts[c]) : 0, weight});
  }

  /// Sets the probabilities of the clusters; returns the logarithm of the likelihood, without constants.
  double expect() {
    const auto logarithmOf = [&](size_t begin, size_t end) {
      double sum = 0, product = 1;  // A product of likelihoods, because a logarithm per value takes long.
      for (size_t i = begin; i < end; ++i) {
        double* row = &probabilities_[i * gaussians_.size()];
        double total = 0;
        for (size_t c = 0; c < gaussians_.size(); ++c) total += row[c] = gaussians_[c].density(values_[i]);
        if (!(total > 0)) total = row[nearest(values_[i])] = kMinProduct;
        if (product * total < kMinProduct || product * total > 1 / kMinProduct)
          sum += std::log(std::exchange(product, 1)) + std::log(total);
        else
          product *= total;
        const double inverse = 1 / total;
        for (size_t c = 0; c < gaussians_.size(); ++c) row[c] *= inverse;
      }
      return sum + std::log(product);
    };
    return foldInParallel<double>(values_.size(), logarithmOf, std::plus<>());
  }

  /// Sets the Gaussians that are most likely for the probabilities.
  void maximize() {
    using Sums = std::array<double, 2>;
    const size_t clusterCount = gaussians_.size();
    for (size_t c = 0; c < clusterCount; ++c) {
      const auto sumUp = [&](size_t begin, size_t end) {
        Sums sums{};
        for (size_t i = begin; i < end; ++i) {
          const double p = probabilities_[i * clusterCount + c];
          sums[0] += p;
          sums[1] += p * values_[i];
        }
        return sums;
      };
      const auto plus = [](const Sums& a, const Sums& b) { return Sums{a[0] + b[0], a[1] + b[1]}; };
      const auto [share, first] = foldInParallel<Sums>(values_.size(), sumUp, plus);
      if (share == 0) {
        gaussians_[c] = {gaussians_[c].mean, gaussians_[c].deviation, 0};
        continue;
      }
      const double mean = first / share;
      const auto sumSquares = [&](size_t begin, size_t end) {
        double sum = 0;
        for (size_t i = begin; i < end; ++i) {
          const double distance = values_[i] - mean;
          sum += probabilities_[i * clusterCount + c] * distance * distance;
        }
        return sum;
      };
      const double second = foldInParallel<double>(values_.size(), sumSquares, std::plus<>());
      gaussians_[c] = {mean, std::sqrt(second / share), share / static_cast<double>(values_.size())};
    }
  }

  [[nodiscard]] SoftClustering byMean() const {
    std::vector<size_t> order(gaussians_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return gaussians_[a].mean < gaussians_[b].mean; });
    SoftClustering result;
    result.probabilities.resize(probabilities_.size());
    for (size_t c = 0; c < order.size(); ++c) {
      const Gaussian& gaussian = gaussians_[order[c]];
      result.means.push_back(gaussian.mean);
      result.deviations.push_back(gaussian.deviation);
      result.weights.push_back(gaussian.weight);
      for (size_t i = 0; i < values_.size(); ++i)
        result.probabilities[i * order.size() + c] = probabilities_[i * order.size() + order[c]];
    }
    return result;
  }

 private:
  /// The cluster with the nearest mean. Used for a value at which all densities underflow.
  [[nodiscard]] size_t nearest(double value) const {
    const auto isNearer = [&](const Gaussian& a, const Gaussian& b) {
      return std::abs(value - a.mean) < std::abs(value - b.mean);
    };
    return static_cast<size_t>(std::min_element(gaussians_.begin(), gaussians_.end(), isNearer) - gaussians_.begin());
  }

  std::span<const double> values_;
  std::vector<Gaussian> gaussians_;
  std::vector<double> probabilities_;
};

}  // namespace

HardClustering clusterByMeans(std::span<const double> values, uint32_t clusterCount, const RunControl& stopOnly) {
  ASDFVK_CHECK(1 <= clusterCount && clusterCount <= kMaxClusterCount);
  requireDifferentValues(values, clusterCount);
  HardClustering result{chooseSeeds(values, clusterCount), std::vector<uint32_t>(values.size())};
  assignToNearest(values, result.centres, result.clusterOf);
  bool isChanged = true;
  for (uint32_t move = 0; move < kMaxMoveCount && isChanged; ++move) {
    stopOnly.checkpoint(0);
    moveToMeans(values, result.clusterOf, result.centres);
    isChanged = assignToNearest(values, result.centres, result.clusterOf);
  }
  return result;
}

SoftClustering clusterSoftly(std::span<const double> values, uint32_t clusterCount, const RunControl& stopOnly) {
  Mixture mixture(values, clusterByMeans(values, clusterCount, stopOnly));
  static_cast<void>(mixture.expect());
  double before = 0;
  for (uint32_t step = 0; step < kMaxMaximizationCount; ++step) {
    stopOnly.checkpoint(0);
    mixture.maximize();
    const double likelihood = mixture.expect();
    // The first comparison is after the second step.
    if (step > 0 && std::abs(likelihood - before) < kConvergedChange * std::abs(likelihood)) break;
    before = likelihood;
  }
  return mixture.byMean();
}

}  // namespace asdfvk
