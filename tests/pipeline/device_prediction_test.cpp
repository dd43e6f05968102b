#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "bvh/bvh.h"
#include "generate/shapes.h"
#include "pipeline/rounds.h"
#include "shared/prediction_layout.h"
#include "support/bits.h"
#include "support/changed_push.h"
#include "support/fake_device.h"
#include "support/require_failure.h"
#include "support/shared_session.h"

using namespace asdfvk;

namespace {

/// The Vulkan backend as one on a GPU, where "auto" selects the device for predictions and for the equation.
class GpuBackend final : public Backend {
 public:
  enum class Predictor { Works, IsMissing, Fails };

  explicit GpuBackend(Predictor predictor) : predictor_(predictor) {
    SessionOptions options;
    options.backend = BackendChoice::Vulkan;
    vulkan_ = makeVulkanBackend(options);
  }

  [[nodiscard]] std::string deviceName() const override { return vulkan_->deviceName(); }
  [[nodiscard]] std::vector<std::string> deviceLines() const override { return vulkan_->deviceLines(); }
  [[nodiscard]] bool runsOnCpu() const override { return false; }
  [[nodiscard]] BvhOptions bvhOptions() const override { return vulkan_->bvhOptions(); }
  [[nodiscard]] bool hasDevice() const override { return true; }
  [[nodiscard]] const Solver& automaticSolver() const override { return defaultSolver(true); }
  [[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(SolverChoice choice) const override {
    return vulkan_->makeSolver(choice);
  }
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                       const TracerNeeds& needs,
                                                       std::unique_ptr<EncodedScene> encoded) override {
    return vulkan_->makeTracer(scene, cone, needs, std::move(encoded));
  }
  [[nodiscard]] std::unique_ptr<DevicePredictor> makePredictor(const TraceScene& scene, const Cone& cone) override {
    ++requestCount;
    if (predictor_ == Predictor::IsMissing) throw Error(ErrorCode::DeviceLimit, "this device is too small");
    return std::make_unique<WatchedPredictor>(predictor_, vulkan_->makePredictor(scene, cone));
  }

  int requestCount = 0;

 private:
  class WatchedPredictor final : public DevicePredictor {
   public:
    WatchedPredictor(Predictor kind, std::unique_ptr<DevicePredictor> predictor)
        : kind_(kind), predictor_(std::move(predictor)) {}
    void predict(const PredictionInput& input, std::span<double> values, const RunControl& control) override {
      if (kind_ == Predictor::Works) return predictor_->predict(input, values, control);
      std::fill(values.begin(), values.end(), 1.0);
      throw Error(ErrorCode::DeviceLost, "this device was lost");
    }

   private:
    Predictor kind_;
    std::unique_ptr<DevicePredictor> predictor_;
  };

  Predictor predictor_;
  std::unique_ptr<Backend> vulkan_;
};

/// While it exists, the nth prediction on a device loses the device.
class LostInPrediction {
 public:
  explicit LostInPrediction(int n)
      : push_([](PredictionPush&) {
          if (++count == last) lost = std::make_unique<test::ScopedVariable>("ASDF_VK_FAKE_LOST_AT", "1");
        }) {
    count = 0;
    last = n;
  }
  ~LostInPrediction() { lost.reset(); }
  LostInPrediction(const LostInPrediction&) = delete;
  LostInPrediction& operator=(const LostInPrediction&) = delete;

  /// Predictions so far.
  static inline int count = 0;

 private:
  static inline int last = 0;
  static inline std::unique_ptr<test::ScopedVariable> lost;
  test::ChangedPush<PredictionPush> push_;
};

struct DeviceOutcome {
  std::vector<double> values;
  std::vector<Warning> warnings;
  int predictorCount = 0;
};

DeviceOutcome runWith(GpuBackend::Predictor predictor, SolverChoice solver) {
  DeviceOutcome outcome;
  Options options = test::tenthOfFaces();
  options.solver = solver;
  const Mesh mesh = makeAnimal(2000).mesh;
  PreparedScene prepared(prepareMesh(mesh, Orientation::Keep));
  const TraceScene scene = prepared.view();
  const Cone cone = makeCone(options.cone);
  auto gpu = std::make_unique<GpuBackend>(predictor);
  const int& predictorCount = gpu->requestCount;
  LazyBackend backend({BackendChoice::Vulkan, "vulkan", std::move(gpu), {}});
  StageSeconds seconds;
  StageClock clock(seconds);
  const FaceDomain domain = wholeMesh(prepared.prepared);
  const InputFaceSet all;
  const Computation computation{options, prepared.prepared, domain, all, scene, cone, backend, clock, outcome.warnings};
  const RoundsResult result = runRounds(computation, {prepared, nullptr, true}, {});
  outcome.values = result.interpolated.values;
  outcome.predictorCount = predictorCount;
  return outcome;
}

}  // namespace

TEST_CASE("on a GPU the device predicts; where it cannot, the CPU does, with one warning") {
  using enum GpuBackend::Predictor;
  const DeviceOutcome device = runWith(Works, SolverChoice::Automatic), cpu = runWith(Works, SolverChoice::Eigen);
  CHECK(device.warnings.empty());
  CHECK(device.predictorCount == 1);
  CHECK(cpu.predictorCount == 0);
  CHECK(test::haveSameBits(device.values, runWith(Works, SolverChoice::Cg).values));
  for (const GpuBackend::Predictor predictor : {IsMissing, Fails}) {
    const DeviceOutcome outcome = runWith(predictor, SolverChoice::Automatic);
    REQUIRE(outcome.warnings.size() == 1);
    CHECK(outcome.warnings[0].code == WarningCode::PredictedOnCpu);
    CHECK(outcome.predictorCount == 1);
    CHECK_FALSE(test::haveSameBits(outcome.values, device.values));
    REQUIRE(outcome.values.size() == device.values.size());
    const double high = *std::max_element(cpu.values.begin(), cpu.values.end());
    for (const std::vector<double>* other : {&device.values, &cpu.values}) {
      double sum = 0;
      for (size_t face = 0; face < other->size(); ++face) sum += std::abs(outcome.values[face] - (*other)[face]);
      CHECK(sum / static_cast<double>(other->size()) < 1e-3 * high);
    }
  }
}

TEST_CASE("a device that is lost in the last prediction takes the hits with it: the CPU traces, predicts and solves") {
  const test::FakeDevice fake({{"ASDF_VK_FAKE_TYPE", "discrete"}, {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"}});
  const Mesh mesh = makeAnimal(8000).mesh;
  Session session({.backend = BackendChoice::Vulkan});
  (void)session.compute(makeAnimal(1000).mesh, test::tenthOfFaces());  // Checks the kernels.
  int predictionCount = 0;
  std::vector<double> expected;
  {
    const LostInPrediction never(0);
    expected = session.compute(mesh, test::tenthOfFaces()).sdf();
    predictionCount = LostInPrediction::count;
  }
  CHECK(predictionCount >= 2);
  const LostInPrediction lost(predictionCount);
  const Result result = session.compute(mesh, test::tenthOfFaces());
  CHECK(test::findWarning(result.report, WarningCode::PredictedOnCpu) != nullptr);
  CHECK(test::findWarning(result.report, WarningCode::SolvedOnCpu) != nullptr);
  double sum = 0;
  for (size_t face = 0; face < expected.size(); ++face) sum += std::abs(result.sdf()[face] - expected[face]);
  CHECK(sum / static_cast<double>(expected.size()) < 1e-3 * *std::ranges::max_element(expected));
}

TEST_CASE("with a named solver of the device a prediction that fails there is an error") {
  test::requireFailure([] { (void)runWith(GpuBackend::Predictor::Fails, SolverChoice::Cg); }, ErrorCode::DeviceLost,
                       "was lost");
}
