#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/session.h"
#include "pipeline/vk/vulkan_backend.h"
#include "support/bits.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "support/test_device.h"

using namespace asdfvk;

namespace {

struct Task {
  Mesh mesh;
  Options options;
};

/// Meshes with coplanar, coincident and touching faces among others, with options that share kernels and solvers.
std::vector<Task> makeTasks(bool usesDeviceSolvers) {
  const Mesh plate = shapes::box({4, 4, 1}, 6);
  std::vector<Task> tasks;
  for (Mesh mesh : {shapes::doubledCube(), shapes::joined(plate, shapes::box({2, 2, 1}, 5), {0, 0, 1}),
                    shapes::openBox({1, 2, 3}, 4), shapes::grid(6), shapes::soup(60, 1), shapes::torus(2, 0.5, 40, 20)})
    tasks.push_back({std::move(mesh), {}});
  tasks.push_back({shapes::sphere(3), {}});
  tasks.back().options.cone.rayCount = 7;
  tasks.push_back({shapes::sphere(3), test::allSeeds()});
  tasks.push_back({plate, {}});
  applyDefinition(Definition::Cgal, tasks.back().options);
  if (usesDeviceSolvers)
    for (const SolverChoice solver : {SolverChoice::Cg, SolverChoice::Jacobi}) {
      tasks.push_back({shapes::torus(2, 0.5, 30, 20), {}});
      tasks.back().options.solver = solver;
    }
  return tasks;
}

bool hasSolversOnDevice() {
  return test::hasBuffersForSolvers(*vulkanDeviceOf(*openBackend({.backend = BackendChoice::Vulkan}).backend));
}

}  // namespace

TEST_CASE("results do not depend on what the session computed before") {
  for (const BackendChoice backend : {BackendChoice::Vulkan, BackendChoice::Cpu}) {
    CAPTURE(nameOf(kBackendNames, backend));
    Session forwards({.backend = backend}), backwards({.backend = backend});
    const std::vector<Task> tasks = makeTasks(backend == BackendChoice::Vulkan && hasSolversOnDevice());
    std::vector<std::vector<double>> values;
    for (const Task& task : tasks) values.push_back(forwards.compute(task.mesh, task.options).sdf());
    for (size_t i = tasks.size(); i-- > 0;) {
      CAPTURE(i);
      CHECK(test::haveSameBits(backwards.compute(tasks[i].mesh, tasks[i].options).sdf(), values[i]));
    }
  }
}
