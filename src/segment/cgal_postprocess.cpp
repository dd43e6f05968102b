#include "segment/cgal_postprocess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/lane_exp.h"
#include "core/parallel.h"
#include "segment/face_windows.h"

namespace asdfvk {
namespace {

constexpr size_t kFacesPerBlock = 256, kBlocksPerProgress = 64;
constexpr size_t kLanes = kLaneCount<Double4>;
/// Largest magnitude of an exponent for which expOfNegative() is used.
constexpr double kMaxLaneExponent = 511;

/// Computes the filtered values of kLanes faces at a time, one per lane. The windows are the faces around each face;
/// sums have the order of the window.
class WindowFilter {
 public:
  WindowFilter(const FaceNeighbours& neighbours, std::span<const double> values, std::span<const double> ringWeights)
      : values_(values), ringWeights_(ringWeights), windows_(neighbours), ringEnds_(kLanes * ringWeights.size()) {}

  void filter(std::span<const uint32_t> block, InstructionSet instructionSet, std::span<double> filtered) {
    windows_.setBlock(block, static_cast<uint32_t>(ringWeights_.size() - 1));
    const size_t stride = windows_.faces().size() + 1;
    faces_.resize(kLanes * stride);
    others_.resize(kLanes * stride);
    valuesAround_.resize(windows_.faces().size());
    for (size_t i = 1; i < valuesAround_.size(); ++i) valuesAround_[i] = values_[windows_.faces()[i]];
    for (size_t first = 0; first < block.size(); first += kLanes) {
      search(static_cast<uint32_t>(first), static_cast<uint32_t>(block.size()), stride);
      double results[kLanes];
      dispatch<Float8>(instructionSet,
                       [&]<typename Floats>() ASDFVK_ALWAYS_INLINE { store(results, filteredValues<Floats>()); });
      for (size_t lane = 0; lane < std::min(kLanes, block.size() - first); ++lane)
        filtered[block[first + lane]] = results[lane];
    }
  }

 private:
  /// Sets others_ to the values of the windows. Beyond the end of a window, the value of the face is used.
  void search(uint32_t first, uint32_t blockSize, size_t stride) {
    std::array<FaceWindow, kLanes> windows;
    for (size_t lane = 0; lane < kLanes; ++lane)
      windows[lane] = {std::min(first + static_cast<uint32_t>(lane), blockSize - 1),
                       std::span(faces_).subspan(lane * stride, stride),
                       std::span(ringEnds_).subspan(lane * ringWeights_.size(), ringWeights_.size())};
    static_assert(kLanes % 2 == 0);
    for (size_t lane = 0; lane < kLanes; lane += 2) windows_.search(windows[lane], windows[lane + 1]);
    for (size_t lane = 0; lane < kLanes; ++lane) counts_[lane] = windows[lane].ringEnds.back();
    longest_ = std::ranges::max(counts_);
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const uint32_t* const faces = &faces_[lane * stride];
      for (uint32_t i = 0; i < counts_[lane]; ++i) others_[i * kLanes + lane] = valuesAround_[faces[i]];
      for (uint32_t i = counts_[lane]; i < longest_; ++i) others_[i * kLanes + lane] = others_[lane];
    }
  }

  template <typename Floats>
  [[nodiscard]] ASDFVK_ALWAYS_INLINE inline Double4 filteredValues() const {
    const double* const others = others_.data();
    const Double4 value = load<Double4>(others);
    Double4 squares{}, greatest{}, deviation;
    for (uint32_t i = 0; i < longest_; ++i) {
      const Double4 difference = load<Double4>(&others[i * kLanes]) - value, square = difference * difference;
      squares += square;
      greatest = max(greatest, square);
    }
    bool isInRange = hasFusedMultiplyAdd<Floats>();
    for (size_t lane = 0; lane < kLanes; ++lane) {
      deviation[lane] = 1.5 * std::sqrt(squares[lane] / counts_[lane]);
      isInRange &= greatest[lane] <= 2 * kMaxLaneExponent * deviation[lane] * deviation[lane];
    }
    return isInRange
               ? weightedMeans(value, deviation,
                               [](const Double4& exponent) ASDFVK_ALWAYS_INLINE { return expOfNegative(exponent); })
               : weightedMeans(value, deviation, expOfLibrary);
  }

  static Double4 expOfLibrary(const Double4& exponent) {
    Double4 power;
    for (size_t lane = 0; lane < kLanes; ++lane) power[lane] = std::exp(exponent[lane]);
    return power;
  }

  template <typename Exp>
  [[nodiscard]] ASDFVK_ALWAYS_INLINE inline Double4 weightedMeans(const Double4& value, const Double4& deviation,
                                                                  const Exp& exp) const {
    const double* const others = others_.data();
    Double4 weights{}, sum{}, ringWeight{};
    uint32_t rings[kLanes] = {};
    for (uint32_t i = 0; i < longest_;) {
      uint32_t end = longest_;
      for (size_t lane = 0; lane < kLanes; ++lane) {
        const uint32_t* const ends = &ringEnds_[lane * ringWeights_.size()];
        while (rings[lane] < ringWeights_.size() && ends[rings[lane]] <= i) ++rings[lane];
        const bool isWithin = rings[lane] < ringWeights_.size();
        ringWeight[lane] = isWithin ? ringWeights_[rings[lane]] : 0;
        if (isWithin) end = std::min(end, ends[rings[lane]]);
      }
      for (; i < end; ++i) {
        const Double4 other = load<Double4>(&others[i * kLanes]), ratio = (other - value) / deviation;
        const Double4 weight = ringWeight * exp(-0.5 * ratio * ratio);
        weights += weight;
        sum += weight * other;
      }
    }
    Double4 result = sum / weights;
    for (size_t lane = 0; lane < kLanes; ++lane) result[lane] = deviation[lane] == 0 ? value[lane] : result[lane];
    return result;
  }

  std::span<const double> values_, ringWeights_;
  FaceWindows windows_;
  std::vector<uint32_t> ringEnds_;    ///< The ends of the rings of the windows, lane after lane.
  std::vector<uint32_t> faces_;       ///< The windows, lane after lane.
  std::vector<double> valuesAround_;  ///< The values of windows_.faces().
  std::vector<double> others_;        ///< The values of the windows, the lanes side by side.
  std::array<uint32_t, kLanes> counts_{};
  uint32_t longest_ = 0;
};

/// A power of two that brings the greatest magnitude into [0.5, 1), so that squares neither overflow nor underflow.
/// Returns 1 if all values are 0 or missing.
double unitOf(std::span<const double> values) {
  double greatest = 0;
  for (const double value : values)
    if (std::abs(value) > greatest) greatest = std::abs(value);
  int exponent = 0;
  std::frexp(greatest, &exponent);
  return std::ldexp(1.0, std::min(-exponent, 1023));
}

double fromUnit(double value, double unit) { return std::min(value / unit, std::numeric_limits<double>::max()); }

}  // namespace

std::vector<double> fillMissingValues(const FaceNeighbours& neighbours, std::span<const double> values) {
  ASDFVK_CHECK_OP(values.size(), ==, neighbours.size());
  std::vector<double> filled(values.begin(), values.end());
  for (size_t face = 0; face < filled.size(); ++face) {
    if (!std::isnan(filled[face])) continue;
    double sum = 0;
    uint32_t count = 0;
    for (const uint32_t neighbour : neighbours[face])
      if (neighbour != kNoNeighbour && !std::isnan(filled[neighbour])) {
        sum += filled[neighbour];
        ++count;
      }
    if (count > 0) filled[face] = sum / count;
  }
  double least = kNoValue;
  for (const double value : filled)
    if (!(least <= value)) least = std::isnan(value) ? least : value;
  if (std::isnan(least)) throw Error(ErrorCode::NoValues, "no face has a value");
  for (double& value : filled)
    if (std::isnan(value)) value = least;
  return filled;
}

std::vector<double> filterLikeCgal(const FaceNeighbours& neighbours, std::span<const double> values,
                                   const RunControl& control, InstructionSet instructionSet) {
  ASDFVK_CHECK_OP(values.size(), ==, neighbours.size());
  const auto ringCount = static_cast<uint32_t>(std::sqrt(static_cast<double>(values.size()) / 2000)) + 1;
  std::vector<double> ringWeights;
  for (uint32_t ring = 0; ring <= ringCount; ++ring) {
    const double ratio = ring / (ringCount / 2.0);
    ringWeights.push_back(std::exp(-0.5 * ratio * ratio));
  }
  std::vector<double> filtered(values.size());
  const std::vector<uint32_t> order = orderByBlocks(neighbours, kFacesPerBlock);
  PerThread<WindowFilter> filters([&] { return WindowFilter(neighbours, values, ringWeights); });
  constexpr size_t kFacesPerProgress = kFacesPerBlock * kBlocksPerProgress;
  for (size_t begin = 0; begin < order.size(); begin += kFacesPerProgress) {
    control.checkpoint(static_cast<double>(begin) / static_cast<double>(order.size()));
    const auto faces = std::span(order).subspan(begin, std::min(kFacesPerProgress, order.size() - begin));
    forEachTask((faces.size() + kFacesPerBlock - 1) / kFacesPerBlock, [&](size_t block) {
      if (control.stop.stop_requested()) return;
      const size_t first = block * kFacesPerBlock;
      filters.local().filter(faces.subspan(first, std::min(kFacesPerBlock, faces.size() - first)), instructionSet,
                             filtered);
    });
  }
  control.checkpoint(1);
  return filtered;
}

CgalValues postprocessLikeCgal(const FaceNeighbours& neighbours, std::span<const double> values,
                               const RunControl& control) {
  const double unit = unitOf(values);
  std::vector<double> scaled(values.begin(), values.end());
  for (double& value : scaled) value *= unit;
  CgalValues result{filterLikeCgal(neighbours, fillMissingValues(neighbours, scaled), control)};
  const auto [least, greatest] = std::minmax_element(result.normalized.begin(), result.normalized.end());
  const double min = *least, max = *greatest, range = max - min;
  for (double& value : result.normalized) value = range == 0 ? fromUnit(value, unit) : (value - min) / range;
  result.min = fromUnit(min, unit);
  result.max = fromUnit(max, unit);
  return result;
}

}  // namespace asdfvk
