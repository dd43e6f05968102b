#include "poisson/vk/vulkan_cg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/stopwatch.h"
#include "poisson/vk/vulkan_solver.h"
#include "spirv/cg_product.comp.h"
#include "spirv/cg_step.comp.h"

namespace asdfvk {
namespace {

// Rounding lets the residual of the recurrence differ from the true residual by about 1e-7 of the first residual.
constexpr double kMinReduction = 1e-6;
// Batches grow, because iterations after convergence do no work. A batch is still too short for a user to notice.
constexpr uint32_t kFirstBatch = 16, kFirstBatchOnCpu = 8;
constexpr uint32_t kMaxBatch = 64;
constexpr double kMaxBatchSeconds = 0.05;

constexpr VkBufferUsageFlags kSizeUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

std::array<CgState, 2> firstStates(double reduction) {
  const CgState state{.residualSquared = 1,
                      .toleranceSquared = static_cast<float>(reduction * reduction),
                      .iterationCount = 0,
                      .status = kCgRunning};
  return {state, state};
}

class VulkanCgSolver final : public VulkanSolver {
 public:
  explicit VulkanCgSolver(const Device& device) : VulkanSolver(device), kernels_(device) {}

  [[nodiscard]] double minReduction() const override { return kMinReduction; }
  [[nodiscard]] DevicePassResult solve(const DevicePass& pass) const override {
    VulkanCg cg(device(), kernels_, pass.matrix, pass.rightHandSide, pass.reduction);
    CgState state{};
    uint32_t batch = device().facts().isCpu() ? kFirstBatchOnCpu : kFirstBatch;
    for (uint32_t recorded = 0; state.status == kCgRunning && recorded < pass.maxIterations;) {
      const Stopwatch stopwatch;
      const uint32_t iterationCount = std::min(batch, pass.maxIterations - recorded);
      state = cg.advance(iterationCount);
      recorded += iterationCount;
      if (2 * stopwatch.seconds() < kMaxBatchSeconds) batch = std::min(2 * batch, kMaxBatch);
      pass.progress.checkpoint(pass.norm * std::sqrt(static_cast<double>(state.residualSquared)));
    }
    return {cg.takeSolution(), state.iterationCount};
  }

 private:
  VulkanCgKernels kernels_;
};

}  // namespace

VulkanCgKernels::VulkanCgKernels(const Device& device)
    : product(device, describePoissonKernel(device.facts(), "cg_product.comp", k_cg_product_comp, 8)),
      step(device, describePoissonKernel(device.facts(), "cg_step.comp", k_cg_step_comp, 7)) {}

VulkanCg::VulkanCg(const Device& device, const VulkanCgKernels& kernels, const VulkanMatrix& matrix,
                   const Buffer& rightHandSide, double reduction)
    : device_(device),
      kernels_(kernels),
      rightHandSide_(rightHandSide),
      unknownCount_(matrix.rowCount),
      workgroupCount_(matrix.grid.workgroupCount),
      solution_(makePoissonVector(device, unknownCount_)),
      residual_(makePoissonVector(device, unknownCount_)),
      direction_(makePoissonVector(device, unknownCount_)),
      product_(makePoissonVector(device, unknownCount_)),
      states_(uploadBuffer(device, bytesOf(firstStates(reduction)), kPoissonVectorUsage)),
      sums_(uploadBuffer(device, bytesOf(PoissonSums{}), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)),
      size_(uploadBuffer(device, bytesOf(DispatchSize{matrix.grid.workgroupCount, 1, 1}), kSizeUsage)),
      statesOnHost_(device, 2 * sizeof(CgState), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::HostVisible),
      productBindings_(device, kernels.product,
                       std::array<Binding, 8>{matrix.rows, matrix.tailColumns, matrix.tailCouplings,
                                              matrix.residualWeights, residual_, direction_, product_, sums_}),
      stepBindings_(device, kernels.step,
                    std::array<Binding, 7>{product_, solution_, residual_, direction_, sums_, states_, size_}),
      commands_(device) {}

void VulkanCg::recordStart() {
  commands_.fillWithZeros(solution_);
  for (const Buffer* const vector : {&residual_, &direction_})
    commands_.copy(rightHandSide_, 0, *vector, 0, unknownCount_ * sizeof(float));
  commands_.barrier();
}

CgState VulkanCg::advance(uint32_t iterationCount) {
  commands_.begin();
  if (!std::exchange(hasStarted_, true)) recordStart();
  for (uint32_t i = 0; i < iterationCount; ++i) {
    const PoissonPush push{unknownCount_, stateIndex_, workgroupCount_};
    commands_.dispatchIndirect(kernels_.product, productBindings_, bytesOf(push), size_);
    commands_.barrier();
    commands_.dispatchIndirect(kernels_.step, stepBindings_, bytesOf(push), size_);
    commands_.barrier();
    stateIndex_ = 1 - stateIndex_;
  }
  commands_.copy(states_, 0, statesOnHost_, 0, 2 * sizeof(CgState));
  commands_.barrier();
  commands_.submitAndWait();
  std::array<CgState, 2> states;
  std::memcpy(&states, statesOnHost_.mapped(), sizeof states);
  // The iteration that ended the run wrote its state last.
  return states[1 - stateIndex_].status != kCgRunning ? states[1 - stateIndex_] : states[stateIndex_];
}

uint32_t VulkanCg::workgroupCount() const {
  DispatchSize size;
  downloadBuffer(device_, size_, std::as_writable_bytes(std::span<DispatchSize, 1>(&size, 1)));
  return size.x;
}

std::vector<float> VulkanCg::download(const Buffer& vector) const {
  return downloadPoissonVector(device_, vector, unknownCount_);
}

std::unique_ptr<PoissonSolver> makeVulkanCgSolver(const Device* device) {
  return std::make_unique<VulkanCgSolver>(*device);
}

}  // namespace asdfvk
