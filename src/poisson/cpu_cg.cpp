#include "poisson/cpu_cg.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace asdfvk {
namespace {

constexpr size_t kBlock = 4096;  // Rows; small enough for every core of a big machine to get some of a small mesh.
constexpr size_t kChunk = 256;   // Rows that are multiplied and then summed while the first cache has them.
constexpr size_t kSumCount = 8;

}  // namespace

CpuCg::CpuCg(const ScaledSystem& system, UnsetVector<float> rightHandSide, double reduction)
    : system_(system),
      solution_(rightHandSide.size()),
      residual_(std::move(rightHandSide)),
      direction_(residual_.size()),
      product_(residual_.size()),
      sums_((residual_.size() + kBlock - 1) / kBlock) {
  forEachBlock([&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      solution_[i] = 0;
      direction_[i] = residual_[i];
    }
  });
  state_.residualSquared = 1;
  state_.toleranceSquared = static_cast<float>(reduction * reduction);
}

template <typename Body>
void CpuCg::forEachBlock(const Body& body) {
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, sums_.size()),
      [&](const tbb::blocked_range<size_t>& range) {
        for (size_t block = range.begin(); block < range.end(); ++block)
          body(block, block * kBlock, std::min((block + 1) * kBlock, direction_.size()));
      },
      partitioner_);
}

void CpuCg::multiplyRows(size_t begin, size_t end) {
  const PoissonRow* rows = system_.rows().data();
  const uint32_t* tailColumns = system_.tailColumns().data();
  const float* tailCouplings = system_.tailCouplings().data();
  const float* p = direction_.data();
  float* product = product_.data();
  for (size_t i = begin; i < end; ++i) {
    const PoissonRow& row = rows[i];
    float coupled = row.coupling0 * p[row.column0] + row.coupling1 * p[row.column1] + row.coupling2 * p[row.column2];
    for (uint32_t k = row.tailBegin; k < row.tailBegin + row.tailCount; ++k)
      coupled += tailCouplings[k] * p[tailColumns[k]];
    product[i] = p[i] - coupled;
  }
}

CpuCg::BlockSums CpuCg::sumRows(size_t begin, size_t end) const {
  const float* weights = system_.residualWeights().data();
  // What compilers turn into vector instructions without leave to reorder sums.
  std::array<std::array<float, kSumCount>, std::tuple_size_v<BlockSums>> lanes{};
  const auto add = [&](size_t i, size_t lane) {
    const float p = direction_[i], product = product_[i], r = residual_[i];
    lanes[0][lane] += p * p;
    lanes[1][lane] += p * product;
    lanes[2][lane] += product * product;
    lanes[3][lane] += r * product;
    lanes[4][lane] += r * r;
    lanes[5][lane] += r * r * weights[i];
  };
  size_t i = begin;
  for (; i + kSumCount <= end; i += kSumCount)
    for (size_t lane = 0; lane < kSumCount; ++lane) add(i + lane, lane);
  for (; i < end; ++i) add(i, 0);
  BlockSums sums{};
  for (size_t k = 0; k < sums.size(); ++k)
    for (float lane : lanes[k]) sums[k] += static_cast<double>(lane);
  return sums;
}

CgSums CpuCg::multiply() {
  const auto addTo = [](BlockSums& sums, const BlockSums& more) {
    for (size_t k = 0; k < sums.size(); ++k) sums[k] += more[k];
  };
  forEachBlock([&](size_t block, size_t begin, size_t end) {
    BlockSums sums{};
    for (size_t chunk = begin; chunk < end; chunk += kChunk) {
      const size_t chunkEnd = std::min(chunk + kChunk, end);
      multiplyRows(chunk, chunkEnd);
      addTo(sums, sumRows(chunk, chunkEnd));
    }
    sums_[block] = sums;
  });
  BlockSums total{};
  for (const BlockSums& sums : sums_) addTo(total, sums);
  return std::apply([](auto... sum) { return CgSums{static_cast<float>(sum)...}; }, total);
}

void CpuCg::step(float alpha, float beta) {
  forEachBlock([&](size_t, size_t begin, size_t end) {
    float* __restrict x = solution_.data();
    float* __restrict r = residual_.data();
    float* __restrict p = direction_.data();
    const float* __restrict product = product_.data();
    for (size_t i = begin; i < end; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * product[i];
      p[i] = r[i] + beta * p[i];
    }
  });
}

CgState CpuCg::advance(uint32_t iterationCount) {
  for (uint32_t i = 0; i < iterationCount && state_.status == kCgRunning; ++i) {
    const CgSums sums = multiply();
    const CgStep next = nextCgStep(sums, state_.toleranceSquared);
    state_.residualSquared = sums.residualSquared;
    state_.status = next.status;
    if (next.status != kCgRunning) break;
    step(next.alpha, next.beta);
    ++state_.iterationCount;
  }
  return state_;
}

}  // namespace asdfvk
