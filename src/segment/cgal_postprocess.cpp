#include "segment/cgal_postprocess.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr size_t kFacesPerProgress = size_t{1} << 14, kFacesPerPoll = 256;

/// The faces around a face by breadth-first search.
class RingSearch {
 public:
  explicit RingSearch(size_t faceCount) : visitedFor_(faceCount, kNoNeighbour) {}

  void search(const FaceNeighbours& neighbours, uint32_t centre, uint32_t ringCount) {
    faces_.assign(1, centre);
    ringEnds_.assign(1, 1);
    visitedFor_[centre] = centre;
    for (size_t parent = 0; ringEnds_.size() <= ringCount;) {
      for (const size_t end = faces_.size(); parent < end; ++parent)
        for (const uint32_t face : neighbours[faces_[parent]])
          if (face != kNoNeighbour && visitedFor_[face] != centre) {
            visitedFor_[face] = centre;
            faces_.push_back(face);
          }
      ringEnds_.push_back(faces_.size());
    }
  }

  [[nodiscard]] std::span<const uint32_t> faces() const { return faces_; }
  [[nodiscard]] std::span<const size_t> ringEnds() const { return ringEnds_; }  ///< In faces(), from ring 0 on.

 private:
  std::vector<uint32_t> visitedFor_;  ///< #F, the centre of the last search that found the face.
  std::vector<uint32_t> faces_;
  std::vector<size_t> ringEnds_;
};

double filteredValue(const RingSearch& rings, std::span<const double> ringWeights, std::span<const double> values) {
  const double value = values[rings.faces().front()];
  double squares = 0;
  for (const uint32_t face : rings.faces()) {
    const double difference = values[face] - value;
    squares += difference * difference;
  }
  const double deviation = 1.5 * std::sqrt(squares / static_cast<double>(rings.faces().size()));
  if (deviation == 0) return value;
  double weights = 0, sum = 0;
  size_t i = 0;
  for (size_t ring = 0; ring < rings.ringEnds().size(); ++ring)
    for (; i < rings.ringEnds()[ring]; ++i) {
      const double other = values[rings.faces()[i]], ratio = (other - value) / deviation;
      const double weight = ringWeights[ring] * std::exp(-0.5 * ratio * ratio);
      weights += weight;
      sum += weight * other;
    }
  return sum / weights;
}

/// A power of two that brings the greatest magnitude into [0.5, 1), so that no square overflows or underflows; 1 where
/// all values are 0 or missing.
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
                                   const RunControl& control) {
  ASDFVK_CHECK_OP(values.size(), ==, neighbours.size());
  const auto ringCount = static_cast<uint32_t>(std::sqrt(static_cast<double>(values.size()) / 2000)) + 1;
  std::vector<double> ringWeights;
  for (uint32_t ring = 0; ring <= ringCount; ++ring) {
    const double ratio = ring / (ringCount / 2.0);
    ringWeights.push_back(std::exp(-0.5 * ratio * ratio));
  }
  std::vector<double> filtered(values.size());
  PerThread<RingSearch> searches([&] { return RingSearch(values.size()); });
  for (size_t begin = 0; begin < values.size(); begin += kFacesPerProgress) {
    control.checkpoint(static_cast<double>(begin) / static_cast<double>(values.size()));
    const size_t end = std::min(values.size(), begin + kFacesPerProgress);
    forEachTask((end - begin + kFacesPerPoll - 1) / kFacesPerPoll, [&](size_t block) {
      if (control.stop.stop_requested()) return;
      RingSearch& rings = searches.local();
      const size_t first = begin + block * kFacesPerPoll, last = std::min<size_t>(end, first + kFacesPerPoll);
      for (auto face = static_cast<uint32_t>(first); face < last; ++face) {
        rings.search(neighbours, face, ringCount);
        filtered[face] = filteredValue(rings, ringWeights, values);
      }
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
