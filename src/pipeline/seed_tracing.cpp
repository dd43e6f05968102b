#include "pipeline/seed_tracing.h"

#include <utility>

#include "asdf_vk/error.h"
#include "core/free_memory.h"
#include "core/parallel.h"
#include "seeds/component_seeds.h"
#include "trace/reference_tracer.h"

namespace asdfvk {
namespace {

/// Builds the hierarchy for the expected backend if there is none, encodes it, and then waits for the backend. Builds
/// the hierarchy again if another backend was opened.
std::unique_ptr<EncodedScene> encodeHierarchy(const Computation& computation, PreparedScene& scene,
                                              const RunControl& control) {
  LazyBackend& backend = computation.backend;
  const BvhOptions expected = backend.expectedBvhOptions();
  scene.requireHierarchy(expected, computation.clock, control);
  std::unique_ptr<EncodedScene> encoded;
  {
    const auto scope = computation.clock.time(Stage::Encode);
    encoded = backend.encode(computation.scene);
  }
  if (!backend.isOpen()) {
    const auto scope = computation.clock.time(Stage::Upload);
    (void)backend.open(control.stop);
  }
  if (backend.openFor(computation.options.solver, control.stop).bvhOptions() == expected) return encoded;
  freeMemory(scene.bvh.nodes);
  scene.requireHierarchy(backend->bvhOptions(), computation.clock, control);
  return nullptr;
}

}  // namespace

SeedTracing::SeedTracing(const Computation& computation, const RaySource& source, const RunControl& control)
    : computation_(computation), scene_(source.scene), keepsNodes_(source.keepsNodes) {
  const ConeOptions& cone = computation.options.cone;
  const TracerNeeds needs{.hits = computation.keepsHits()};
  if (source.kept != nullptr) {
    (void)computation.backend.openFor(computation.options.solver, control.stop);  // Its thread may make kernels.
    tracer_ = source.kept->get(cone, needs, computation.clock);
    return;
  }
  std::unique_ptr<EncodedScene> encoded = encodeHierarchy(computation, source.scene, control);
  tracer_ = std::make_shared<KeptTracer>(*computation.backend, computation.scene, cone, needs, computation.clock,
                                         std::move(encoded));
}

SeedTracing::~SeedTracing() {
  const auto scope = computation_.clock.time(setUpStage(*computation_.backend));
  tracer_.reset();
  if (!keepsNodes_) freeMemory(scene_.bvh.nodes);
}

std::unique_ptr<DeviceHits> SeedTracing::makeDeviceHits() const {
  const bool predictsOnDevice =
      computation_.keepsHits() && computation_.backend->predictsOnDevice(computation_.options.solver);
  return predictsOnDevice ? tracer_->tracer->makeDeviceHits() : nullptr;
}

void SeedTracing::reserveHits(Seeds& seeds, size_t count, const RunControl& control) {
  if (seeds.hitsOnDevice) {
    try {
      return seeds.hitsOnDevice->reserve(seeds.size() + count);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Device) throw;
      moveHitsToHost(computation_, scene_, seeds, control);
    }
  }
  seeds.hits.reserve((seeds.size() + count) * seeds.hitsPerSeed);
}

void SeedTracing::trace(std::span<const uint32_t> nodes, std::span<const SeedKind> kinds, Seeds& seeds,
                        const RunControl& control) {
  if (seeds.hitsOnDevice) reserveHits(seeds, nodes.size(), control);
  const size_t earlierCount = seeds.size(), earlierHitCount = seeds.hits.size();
  const std::vector<uint32_t> faces = facesAt(computation_.domain, nodes);
  seeds.values.resize(earlierCount + nodes.size());
  ConeResults results{.values = std::span(seeds.values).subspan(earlierCount), .onDevice = seeds.hitsOnDevice.get()};
  if (results.onDevice == nullptr) {
    seeds.hits.resize(earlierHitCount + nodes.size() * seeds.hitsPerSeed);
    results.hits = std::span(seeds.hits).subspan(earlierHitCount);
  }
  const TraceStatistics statistics = tracer_->tracer->trace(faces, results, control);
  seeds.nodes.insert(seeds.nodes.end(), nodes.begin(), nodes.end());
  seeds.kinds.insert(seeds.kinds.end(), kinds.begin(), kinds.end());
  seeds.statistics.rayCount += statistics.rayCount;
  seeds.statistics.redoneConeCount += statistics.redoneConeCount;
}

void SeedTracing::traceComponentsWithoutValue(Seeds& seeds, const RunControl& control) {
  const FaceDomain& domain = computation_.domain;
  const auto isUsed = [&](size_t seed) { return !seeds.isHeldOut(seed); };
  const std::vector<uint32_t> untried = untriedWithoutValue(domain, seeds, isUsed);
  if (untried.empty()) return;
  std::vector<double> values = constraintsOf(seeds, domain.size(), isUsed);
  ComponentSeeds further(domain.componentOf, values, untried, computation_.options.randomSeed);
  for (auto batch = further.next(values); !batch.empty(); batch = further.next(values)) {
    const size_t earlierCount = seeds.size();
    trace(batch, SeedKind::Component, seeds, control.withoutProgress());
    for (size_t i = 0; i < batch.size(); ++i) values[batch[i]] = seeds.values[earlierCount + i];
  }
}

void moveHitsToHost(const Computation& computation, PreparedScene& scene, Seeds& seeds, const RunControl& control) {
  const std::shared_ptr<DeviceHits> onDevice = std::exchange(seeds.hitsOnDevice, nullptr);
  seeds.hits.resize(seeds.size() * seeds.hitsPerSeed);
  try {
    onDevice->download(seeds.hits);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device) throw;
    const RunControl stopOnly = control.withoutProgress();
    scene.requireHierarchy(computation.backend->bvhOptions(), computation.clock, stopOnly);
    UnsetVector<double> values(seeds.size());
    makeReferenceTracer(computation.scene, computation.cone)
        ->trace(facesAt(computation.domain, seeds.nodes), {values, seeds.hits}, stopOnly);
  }
}

}  // namespace asdfvk
