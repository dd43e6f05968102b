#include "trace/seed_hits.h"

#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {

void SeedHits::reserve(size_t furtherSeedCount) {
  if (store_ != nullptr) {
    try {
      return store_->reserve(furtherSeedCount);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Device) throw;
    }
    moveToHost();
  }
  hits_.reserve(hits_.size() + furtherSeedCount * rayCount_);
}

ConeResults SeedHits::resultsFor(std::span<double> values) {
  if (store_ != nullptr) reserve(values.size());
  if (store_ != nullptr) return {values, {}, store_};
  const size_t earlierCount = hits_.size();
  hits_.resize(earlierCount + values.size() * rayCount_);
  return {values, std::span(hits_).subspan(earlierCount)};
}

void SeedHits::moveToHost() {
  if (store_ == nullptr) return;
  hits_ = store_->download();
  std::exchange(store_, nullptr)->release();
}

}  // namespace asdfvk
