// The floating-point environment of the caller neither reaches a computation nor changes.
#include <doctest/doctest.h>

#include <cfenv>
#include <thread>
#if defined(__SSE__)
#include <immintrin.h>
#endif

#include "c/c_objects.h"
#include "core/parallel.h"
#include "generate/creatures.h"
#include "support/bits.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

constexpr int kTraps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW | FE_UNDERFLOW;

/// What of an environment can be read; flags included.
struct EnvironmentState {
  int rounding = std::fegetround(), traps = ::fegetexcept(), flags = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__SSE__)
  unsigned control = _mm_getcsr();  ///< Rounding, masks, flags, FTZ and DAZ.
#else
  unsigned control = 0;
#endif
  bool operator==(const EnvironmentState&) const = default;
};

/// Rounds upwards, flushes denormals to zero and traps.
void setHostileEnvironment() {
  std::fesetround(FE_UPWARD);
#if defined(__SSE__)
  _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ and DAZ.
#endif
  std::feclearexcept(FE_ALL_EXCEPT);
  ::feenableexcept(kTraps);
}

int keepEnvironment(double, const char*, void* user) {
  static_cast<std::vector<EnvironmentState>*>(user)->emplace_back();
  return 0;
}

/// What a caller sees of a computation.
struct Computed {
  asdf_vk_status status = ASDF_VK_INTERNAL;
  std::vector<double> sdf, thickness, atPoint{0};
  std::vector<EnvironmentState> inProgress;
  EnvironmentState before, after;
};

/// In another thread, without a check: doctest does not run in a hostile environment.
Computed computedInThread(const Mesh& mesh, const char* backend, bool isHostile) {
  const Owned<asdf_vk_options> options = optionsOfC({{"seeds", "20%"}, {"measure", "both"}, {"segment", "parts"}});
  const Owned<asdf_vk_options> ofSession = optionsOfC({{"backend", backend}});
  Computed computed{.sdf = std::vector<double>(mesh.faces.size()), .thickness = std::vector<double>(mesh.faces.size())};
  const auto compute = [&] {
    if (isHostile) setHostileEnvironment();
    // A caller that uses TBB itself: the arena of this thread has the environment of its first loop.
    forEachRange(64, 1, [](size_t, size_t) { std::this_thread::yield(); });
    computed.before = {};
    asdf_vk_session* session = nullptr;
    asdf_vk_scene* scene = nullptr;
    asdf_vk_result* result = nullptr;
    const double point[]{0.1, 0.2, 0.3}, normal[]{0, 0, 1};
    asdf_vk_session_create(ofSession.get(), &session);
    asdf_vk_scene_create(session, mesh.vertices.data(), ASDF_VK_FLOAT64, mesh.vertices.size(), mesh.faces.data(),
                         ASDF_VK_UINT32, mesh.faces.size(), nullptr, &scene);
    computed.status = asdf_vk_compute(scene, options.get(), keepEnvironment, &computed.inProgress, &result);
    asdf_vk_values_at(scene, nullptr, point, normal, 1, computed.atPoint.data(), nullptr, nullptr);
    const size_t count = mesh.faces.size();
    asdf_vk_result_copy(result, "sdf", ASDF_VK_PER_FACE, ASDF_VK_FLOAT64, computed.sdf.data(), count);
    asdf_vk_result_copy(result, "thickness", ASDF_VK_PER_FACE, ASDF_VK_FLOAT64, computed.thickness.data(), count);
    asdf_vk_result_find(result, "none", ASDF_VK_PER_FACE, nullptr);  // An error.
    asdf_vk_result_destroy(result);
    asdf_vk_scene_destroy(scene);
    asdf_vk_session_destroy(session);
    computed.after = {};
    std::fesetenv(FE_DFL_ENV);
  };
  std::thread(compute).join();
  REQUIRE(computed.status == ASDF_VK_OK);
  return computed;
}

}  // namespace

TEST_CASE("results have the same bits in any floating-point environment of the caller, which stays") {
  const Mesh mesh = makeAnimal(4000).mesh;
  for (const char* backend : {"cpu", "vulkan"}) {
    CAPTURE(backend);
    const Computed usual = computedInThread(mesh, backend, false), hostile = computedInThread(mesh, backend, true);
    CHECK(haveSameBits(usual.sdf, hostile.sdf));
    CHECK(haveSameBits(usual.thickness, hostile.thickness));
    CHECK(haveSameBits(usual.atPoint, hostile.atPoint));
    CHECK(hostile.before == hostile.after);
    CHECK(hostile.before.rounding == FE_UPWARD);
#if defined(__SSE__)  // Other processors may have no traps.
    CHECK(hostile.before.traps == kTraps);
    CHECK((hostile.before.control & 0x8040) == 0x8040);
#endif
    CHECK(usual.before == usual.after);
    CHECK(hostile.inProgress.size() > 3);
    for (const EnvironmentState& state : hostile.inProgress) CHECK(state == hostile.before);
  }
}
