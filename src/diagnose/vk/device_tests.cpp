#include "diagnose/device_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "asdf_vk/error.h"
#include "core/stopwatch.h"
#include "mesh/arc_angles.h"
#include "pipeline/backend.h"
#include "pipeline/generated_mesh.h"
#include "pipeline/vk/vulkan_backend.h"
#include "poisson/poisson_solver.h"
#include "poisson/poisson_system.h"
#include "trace/tracer_check.h"
#include "trace/vk/vulkan_cone_kernel.h"
#include "trace/vk/vulkan_tracer.h"
#include "vk/device.h"

namespace asdfvk {
namespace {

constexpr uint32_t kMaxDifferingCount = 1;  // A ray that grazes an edge may hit either face of the edge.
constexpr int kRunCount = 3;

struct TestTorus : GeneratedMesh {
  explicit TestTorus(double duration) : GeneratedMesh(bumpyTorus(200, 100)), secondsPerRun(duration) {}

  double secondsPerRun;
  Cone cone = makeCone({});
};

/// Runs `test`. If the test cannot run, stores the reason.
template <typename Report>
void runTest(Report& report, const std::function<void()>& test) {
  try {
    test();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::Cancelled) throw;
    const bool isRefused = error.code() == ErrorCode::DeviceLimit || error.code() == ErrorCode::EquationLimit ||
                           error.code() == ErrorCode::KernelUnsupported;
    (isRefused ? report.refusal : report.failure) = error.what();
    report.passed = false;
  }
}

struct RunSeconds {
  double host = 0, kernels = 0;  ///< kernels: by the clock of the device; 0 without timestamps.
};

/// Sets the rays per second. In a short run, the overhead takes most of the time. Therefore the number of faces is
/// doubled until a run takes secondsPerRun. The faces are spread over the mesh.
void measureRates(TracerReport& report, ConeTracer& tracer, const Device* device, const TestTorus& test,
                  const RunControl& control) {
  constexpr size_t kFirstFaceCount = 2048;
  const std::vector<uint32_t>& all = test.scene.prepared.traceableFaces;
  std::vector<uint32_t> faces;
  std::vector<double> values;
  const auto secondsFor = [&](size_t count) {
    faces.resize(count);
    for (size_t i = 0; i < count; ++i) faces[i] = all[i * all.size() / count];
    values.resize(count);
    const auto kernelSeconds = [&] { return device != nullptr ? device->seconds().kernels : 0; };
    const double before = kernelSeconds();
    const Stopwatch watch;
    tracer.trace(faces, {values, {}}, control.withoutProgress());
    return RunSeconds{watch.seconds(), kernelSeconds() - before};
  };
  size_t count = std::min(kFirstFaceCount, all.size());
  RunSeconds best = secondsFor(count);
  while (count < all.size() && best.host < test.secondsPerRun) {
    count = std::min(2 * count, all.size());
    best = secondsFor(count);
  }
  for (int run = 1; run < kRunCount; ++run) {
    const RunSeconds seconds = secondsFor(count);
    best = {std::min(best.host, seconds.host), std::min(best.kernels, seconds.kernels)};
  }
  const auto rayCount = static_cast<double>(count * test.cone.directions.size());
  report.raysPerSecond = rayCount / std::max(best.host, 1e-9);
  if (best.kernels > 0) report.kernelRaysPerSecond = rayCount / best.kernels;
}

/// device: that of the tracer, or null.
void testTracer(TracerReport& report, ConeTracer& tracer, const Device* device, const TestTorus& test,
                const RunControl& control) {
  const TracerCheck check = checkTracer(tracer, test.scene.view(), test.cone);
  report.comparedCount = check.comparedCount;
  report.differingCount = check.differingCount;
  report.passed = check.isConclusive() && check.differingCount <= kMaxDifferingCount;
  measureRates(report, tracer, device, test, control);
}

void testVariants(DeviceReport& report, const Device& device, const TestTorus& test, const RunControl& control) {
  for (const auto& [kernelName, kernel] : kKernels) {
    for (const auto& [fetchName, fetch] : kFetches) {
      control.checkpoint(0);
      const VulkanTraceChoice choice{kernel, fetch};
      TracerReport tracer{.backend = nameOf(kBackendNames, BackendChoice::Vulkan),
                          .variant = choice.variant(),
                          .isDefault = choice == report.choice};
      runTest(tracer, [&] {
        const VulkanConeKernel compiled(
            device, {.rayCount = report.rayCount, .choice = choice, .definition = test.cone.definition});
        testTracer(tracer, *makeVulkanTracer(compiled, test.scene.view(), test.cone), &device, test, control);
      });
      report.tracers.push_back(std::move(tracer));
    }
  }
}

/// open() returns the backend, which exists until the test ends.
template <typename Open>
void testOther(DeviceReport& report, const std::string& name, const TestTorus& test, const RunControl& control,
               const Open& open) {
  TracerReport tracer{.backend = name};
  runTest(tracer, [&] {
    Backend& backend = open();
    testTracer(tracer, *backend.makeTracer(test.scene.view(), test.cone, {}, nullptr), nullptr, test, control);
  });
  report.tracers.push_back(std::move(tracer));
}

/// An equation with the values of a smooth function at every eighth face, and its solution.
struct TestEquation {
  explicit TestEquation(const TestTorus& test)
      : graph(test.scene.prepared.graph),
        weights(featureWeights(arcAngles(graph, test.scene.prepared.geometry))),
        constraints(graph.faceCount(), kNoValue),
        componentOf(graph.faceCount(), 0) {
    for (size_t f = 0; f < constraints.size(); f += 8)
      constraints[f] = 1 + test.scene.prepared.geometry.barycentres[f].x / 4;
  }

  SolverReport solveWith(GraphSolver& solver, std::vector<double>& values, const RunControl& control) const {
    GraphProblem problem{.constraints = constraints,
                         .firstGuess = std::vector<double>(constraints.size(), kNoValue),
                         .guide = {},
                         .divergence = {},
                         .componentOf = componentOf};
    return solver.solve(std::move(problem), {.tolerance = 1e-6}, values, control);
  }

  const DualGraph& graph;
  UnsetVector<double> weights;
  std::vector<double> constraints;
  std::vector<uint32_t> componentOf;
};

void testSolvers(DeviceReport& report, const Device& device, const TestTorus& test, const RunControl& control) {
  const TestEquation equation(test);
  const auto unknownCount = static_cast<uint32_t>(std::count_if(
      equation.constraints.begin(), equation.constraints.end(), [](double value) { return std::isnan(value); }));
  std::vector<double> expected, values;
  const std::unique_ptr<PoissonSolver> onCpu = makeSolver(defaultSolver(false).choice, nullptr);
  equation.solveWith(*onCpu->onGraph(equation.graph, equation.weights), expected, {});
  const auto [min, max] = std::minmax_element(expected.begin(), expected.end());
  const double range = *max - *min;
  for (const Solver& solver : solverTable()) {
    if (!solver.needsDevice) continue;
    control.checkpoint(0);
    SolverCheckReport check{.name = nameOf(solver), .unknownCount = unknownCount};
    runTest(check, [&] {
      const std::unique_ptr<PoissonSolver> made = solver.make(&device);
      const std::unique_ptr<GraphSolver> onGraph = made->onGraph(equation.graph, equation.weights);
      for (int run = 0; run < kRunCount; ++run) {
        const Stopwatch watch;
        const SolverReport solved = equation.solveWith(*onGraph, values, control.withoutProgress());
        check.seconds = run == 0 ? watch.seconds() : std::min(check.seconds, watch.seconds());
        check.iterations = solved.iterations;
        check.finishedOnCpu = solved.finishedOnCpu;
        check.passed = solved.converged;
      }
      for (size_t i = 0; i < values.size(); ++i)
        check.difference = std::max(check.difference, std::abs(values[i] - expected[i]) / range);
      check.passed = check.passed && check.difference <= kSolverTolerance;
    });
    report.solvers.push_back(std::move(check));
  }
}

}  // namespace

DeviceReport reportDevice(const SessionOptions& options, const RunControl& control, double secondsPerRun) {
  const bool isAutomatic = options.backend == BackendChoice::Automatic;
  SessionOptions requested = options;
  requested.variant = {};
  const TestTorus test(secondsPerRun);
  DeviceReport report;
  report.faceCount = test.mesh.faces.size();
  report.rayCount = static_cast<uint32_t>(test.cone.directions.size());

  std::optional<NamedBackend> vulkan;
  if (isAutomatic) requested.backend = BackendChoice::Vulkan;
  try {
    NamedBackend opened = openBackend(requested);
    report.deviceLines = opened.deviceLines;
    if (vulkanDeviceOf(*opened.backend) == nullptr) {
      testOther(report, opened.name, test, control, [&]() -> Backend& { return *opened.backend; });
    } else {
      vulkan = std::move(opened);
    }
  } catch (const Error& error) {
    if (!isAutomatic || error.kind() != ErrorKind::Device || options.requireGpu || !options.device.empty()) throw;
    report.failure = error;
  }
  if (vulkan) {
    const Device& device = *vulkanDeviceOf(*vulkan->backend);
    report.device = device.facts();
    report.choice = traceChoiceFor(device.facts(), {}, test.scene.bvh);
    report.defaultSolver = nameOf(vulkan->backend->automaticSolver());
    testVariants(report, device, test, control);
    testSolvers(report, device, test, control);
    try {
      vulkan->backend->requireSilentValidation();
    } catch (const Error& error) {
      report.failure = error;
    }
  }
  if (isAutomatic && !options.requireGpu) {
    NamedBackend cpu;
    testOther(report, nameOf(kBackendNames, BackendChoice::Cpu), test, control, [&]() -> Backend& {
      SessionOptions cpuOptions;
      cpuOptions.backend = BackendChoice::Cpu;
      cpu = openBackend(cpuOptions);
      return *cpu.backend;
    });
  }
  return report;
}

}  // namespace asdfvk
