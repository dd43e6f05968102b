#include <doctest/doctest.h>

#include "generate/shapes.h"
#include "support/shapes.h"
#include "support/test_device.h"
#include "trace_results.h"
#include "vulkan_variants.h"

using namespace asdfvk;

namespace {

ConeOptions ofCgal(uint32_t rayCount) { return {.rayCount = rayCount, .definition = Definition::Cgal}; }

/// A mesh and its values by the reference.
struct CgalReference {
  TracedMesh traced;
  ConeOptions options;
  std::vector<double> values;

  CgalReference(const Mesh& mesh, uint32_t rayCount)
      : traced(mesh), options(ofCgal(rayCount)), values(traceByReference(traced, options, Wanted::Values).values) {}

  void check(const VulkanConeKernel& kernel) const {
    const std::vector<double> found = traceByKernel(kernel, traced, options, Wanted::Values).values;
    CHECK(differingCount(found, values, traced.geometry.bounds.diagonal()) == 0);
  }
};

}  // namespace

TEST_CASE("the kernels give the reference's values by CGAL's definition" * doctest::test_suite("slow")) {
  // CGAL's bound of outliers has no slack. With 22 rays, every length of these shapes differs from its bound by at
  // least 5e-6 of the median. With 25 rays, 38 faces of the slab have a length at 1.4e-7 from the bound, where the
  // rounding of float32 decides.
  constexpr uint32_t kRayCount = 22;
  const test::ValidatedDevice device;
  std::vector<CgalReference> references;
  for (const std::string_view name : shapeNames()) references.emplace_back(generateShape(name, 2000).mesh, kRayCount);
  for (const Mesh& mesh : {shapes::openBox({1, 2, 3}, 8), shapes::soup(2000, 5), shapes::shell(2, 1)})
    references.emplace_back(shapes::jittered(mesh, 1e-3, 1), kRayCount);
  forEveryVariant(Fetches::TexelOnly, [&](const VulkanTraceChoice& choice) {
    const VulkanConeKernel kernel(*device, {kRayCount, false, choice, Definition::Cgal});
    for (size_t i = 0; i < references.size(); ++i) {
      CAPTURE(i);
      references[i].check(kernel);
    }
  });
}

TEST_CASE("any number of rays gives the reference's values by CGAL's definition" * doctest::test_suite("slow")) {
  const test::ValidatedDevice device;
  const Mesh mesh = generateShape("torus", 200).mesh;
  for (const uint32_t rayCount : {1u, 33u, 1000u}) {
    CAPTURE(rayCount);
    const CgalReference reference(mesh, rayCount);
    for (const auto& [name, kernel] : kKernels)
      reference.check(VulkanConeKernel(*device, {rayCount, false, VulkanTraceChoice{kernel}, Definition::Cgal}));
  }
}

TEST_CASE("a kernel of one definition refuses a cone of another one") {
  const test::ValidatedDevice device;
  const TracedMesh traced(shapes::icosphere(0));
  const VulkanConeKernel kernel(*device, {30});
  const Cone cone = makeCone(ofCgal(30));
  CHECK_THROWS_AS((void)makeVulkanTracer(kernel, traced.scene(), cone), CheckFailure);
}
