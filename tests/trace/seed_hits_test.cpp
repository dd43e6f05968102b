#include "trace/seed_hits.h"

#include <doctest/doctest.h>

#include <vector>

#include "asdf_vk/error.h"

using namespace asdfvk;

namespace {

constexpr size_t kHitsPerSeed = 2;

/// Has memory for three seeds; the hits of seed i are at distance i.
class SmallStore final : public HitStore {
 public:
  void reserve(size_t furtherSeedCount) override {
    if (seedCount + furtherSeedCount > 3) throw Error(ErrorCode::OutOfDeviceMemory, "no memory is left");
  }
  [[nodiscard]] std::vector<ConeHit> download() const override {
    std::vector<ConeHit> hits(seedCount * kHitsPerSeed);
    for (size_t i = 0; i < hits.size(); ++i) hits[i] = {static_cast<float>(i / kHitsPerSeed), 0};
    return hits;
  }
  void release() override { seedCount = 0; }
  [[nodiscard]] VulkanHitStore* onVulkan() override { return nullptr; }

  size_t seedCount = 0;
};

}  // namespace

TEST_CASE("hits of seeds are kept on the host in the order of the seeds, or nowhere") {
  SeedHits hits(kHitsPerSeed), none(0);
  CHECK(hits.areKept());
  CHECK_FALSE(none.areKept());
  std::vector<double> values(2);
  for (SeedHits* const each : {&hits, &none}) each->reserve(4);
  CHECK(none.resultsFor(values).hits.empty());
  CHECK(hits.resultsFor(values).hits.size() == 4);
  const ConeResults further = hits.resultsFor(values);
  CHECK(further.values.data() == values.data());
  CHECK(further.store == nullptr);
  CHECK(hits.onHost().size() == 8);
  CHECK(further.hits.data() == hits.onHost().data() + 4);
  CHECK(none.onHost().empty());
}

TEST_CASE("hits move from a store without memory to the host, where further ones follow") {
  SmallStore store;
  SeedHits hits(kHitsPerSeed);
  hits.keepIn(&store);
  std::vector<double> values(3);
  const ConeResults first = hits.resultsFor(values);
  CHECK(first.store == &store);
  CHECK(first.hits.empty());
  CHECK(hits.onHost().empty());
  store.seedCount = 3;  // A tracer adds them.
  const ConeResults further = hits.resultsFor(std::span(values).first(1));
  CHECK(further.store == nullptr);
  CHECK(further.hits.size() == kHitsPerSeed);
  CHECK(store.seedCount == 0);
  REQUIRE(hits.onHost().size() == 4 * kHitsPerSeed);
  CHECK(hits.onHost()[2 * kHitsPerSeed].distance == 2);
}
