#include "poisson/vk/vulkan_equation.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "poisson/poisson_system.h"
#include "spirv/equation_begin.comp.h"
#include "spirv/equation_correct.comp.h"
#include "spirv/equation_diagonal.comp.h"
#include "spirv/equation_residual.comp.h"
#include "spirv/equation_rows.comp.h"

namespace asdfvk {
namespace {

// Limits of the weights relative to their mean: no sum of limited weights leaves the range of float32.
constexpr double kMinScaledWeight = 1e-30, kMaxScaledWeight = 1e30;

ComputePipelineDescription describeKernel(const DeviceFacts& facts, const std::string& name,
                                          std::span<const uint32_t> spirv, uint32_t bindingCount) {
  ComputePipelineDescription description = describePoissonKernel(facts, name, spirv, bindingCount);
  description.pushConstantByteCount = sizeof(EquationPush);
  return description;
}

/// 1 / mean of the weights; 1 if this is not finite or not positive.
double scaleOfWeights(std::span<const double> weights) {
  const auto count = static_cast<double>(weights.size());
  const double scale = 1 / orderedSum(weights.size(), [&](size_t arc) { return weights[arc] / count; });
  return std::isfinite(scale) && scale > 0 ? scale : 1;
}

Buffer uploadWeights(const Device& device, std::span<const double> weights, double scale) {
  UnsetVector<float> scaled(weights.size());
  forEachInParallel(scaled.size(), [&](size_t arc) {
    scaled[arc] = static_cast<float>(std::clamp(weights[arc] * scale, kMinScaledWeight, kMaxScaledWeight));
  });
  return uploadVector(device, scaled);
}

VulkanMatrix makeMatrix(const Device& device, const DualGraph& graph) {
  const uint32_t longestRow = maxInParallel<uint32_t>(
      graph.faceCount(), [&](uint32_t face) { return graph.offsets[face + 1] - graph.offsets[face]; });
  const uint64_t startSize = uint64_t{graph.faceCount()} * (sizeof(EquationStart) / sizeof(float));
  requireSystemFits(device.facts(), graph.faceCount(), std::max<uint64_t>(graph.neighbours.size(), startSize),
                    longestRow);
  return {device, graph.faceCount(), uploadVector(device, graph.neighbours),
          makePoissonVector(device, longestRow > kPoissonRowHeadLength ? graph.neighbours.size() : 0)};
}

double largestMagnitude(std::span<const double> values) {
  return maxInParallel<double>(values.size(),
                               [&](size_t i) { return std::isfinite(values[i]) ? std::abs(values[i]) : 0; });
}

}  // namespace

VulkanEquationKernels::VulkanEquationKernels(const Device& device)
    : diagonal(device, describeKernel(device.facts(), "equation_diagonal.comp", k_equation_diagonal_comp, 4)),
      rows(device, describeKernel(device.facts(), "equation_rows.comp", k_equation_rows_comp, 6)),
      begin(device, describeKernel(device.facts(), "equation_begin.comp", k_equation_begin_comp, 8)),
      residual(device, describeKernel(device.facts(), "equation_residual.comp", k_equation_residual_comp, 8)),
      correct(device, describeKernel(device.facts(), "equation_correct.comp", k_equation_correct_comp, 4)) {}

VulkanGraph::VulkanGraph(const Device& device, const VulkanEquationKernels& kernels, const DualGraph& graph,
                         std::span<const double> arcWeights)
    : faceCount(graph.faceCount()),
      weightScale(scaleOfWeights(arcWeights)),
      matrix(makeMatrix(device, graph)),
      arcOffsets(uploadVector(device, graph.offsets)),
      weights(uploadWeights(device, arcWeights, weightScale)),
      // The residual weights of the matrix hold the inverse roots of its diagonal until an equation sets them.
      diagonalBindings_(device, kernels.diagonal,
                        std::array<Binding, 4>{matrix.residualWeights, arcOffsets, matrix.tailColumns, weights}),
      rowBindings_(device, kernels.rows,
                   std::array<Binding, 6>{matrix.rows, arcOffsets, matrix.tailColumns, weights, matrix.residualWeights,
                                          matrix.tailCouplings}),
      commands_(device) {
  ASDFVK_CHECK_OP(arcWeights.size(), ==, graph.neighbours.size());
  const EquationPush push{.faceCount = faceCount, .workgroupCount = matrix.grid.workgroupCount, .scale = 1};
  commands_.begin();
  commands_.dispatch(kernels.diagonal, diagonalBindings_, bytesOf(push), push.workgroupCount);
  commands_.barrier();
  commands_.dispatch(kernels.rows, rowBindings_, bytesOf(push), push.workgroupCount);
  commands_.barrier();
  commands_.submit();
}

VulkanEquation::VulkanEquation(const Device& device, const VulkanEquationKernels& kernels, const VulkanGraph& graph,
                               const GraphProblem& problem)
    : device_(device),
      kernels_(kernels),
      graph_(graph),
      problem_(problem),
      isReachable_(reachableFaces(problem.componentOf, problem.constraints)),
      constraintMean_(meanOfConstraints(problem.constraints)),
      scaledResidual_(makePoissonVector(device, graph.faceCount)),
      sums_(uploadBuffer(device, bytesOf(PoissonSums{}), kPoissonVectorUsage)),
      sumsOnHost_(device, sizeof(PoissonSums), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::HostVisible),
      differences_{makePoissonVector(device, graph.faceCount), makePoissonVector(device, graph.faceCount)},
      commands_(device) {
  for (const size_t count : {problem.constraints.size(), problem.firstGuess.size(), problem.componentOf.size()})
    ASDFVK_CHECK_OP(count, ==, size_t{graph.faceCount});
  if (!problem.guide.empty()) ASDFVK_CHECK_OP(problem.guide.size(), ==, size_t{graph.faceCount});
  if (!problem.divergence.empty()) ASDFVK_CHECK_OP(problem.divergence.size(), ==, size_t{graph.faceCount});
  const double largest = std::max(largestMagnitude(problem.constraints), largestMagnitude(problem.firstGuess));
  if (std::isfinite(1 / largest)) valueScale_ = 1 / largest;
  const Buffer starts = uploadVector(device, makeStarts());
  sources_ = problem.divergence.empty() ? makePoissonVector(device, graph.faceCount)
                                        : uploadVector(device, makeSources(), kPoissonVectorUsage);
  const VulkanMatrix& matrix = graph.matrix;
  const BindingSet beginBindings(device, kernels.begin,
                                 std::array<Binding, 8>{starts, graph.arcOffsets, matrix.tailColumns, graph.weights,
                                                        sources_, matrix.residualWeights, differences_[0], sums_});
  for (uint32_t i = 0; i < 2; ++i)
    residualBindings_[i].emplace(
        device, kernels.residual,
        std::array<Binding, 8>{sources_, graph.arcOffsets, matrix.tailColumns, graph.weights, matrix.residualWeights,
                               differences_[i], scaledResidual_, sums_});
  commands_.begin();
  if (problem.divergence.empty()) {
    commands_.fillWithZeros(sources_);
    commands_.barrier();
  }
  commands_.dispatch(kernels.begin, beginBindings, bytesOf(push(1)), matrix.grid.workgroupCount);
  commands_.barrier();
  const PoissonSums sums = submitAndRead(commands_, sums_, sumsOnHost_);
  rightHandNorm_ = rootOfSum(sums.directionSquared, matrix.grid);
  residualNorm_ = rootOfSum(sums.residualSquared, matrix.grid);
}

bool VulkanEquation::isGuided(uint32_t face) const {
  return !problem_.guide.empty() && std::isfinite(problem_.guide[face]);
}

double VulkanEquation::baseOf(uint32_t face) const {
  if (isGuided(face)) return problem_.guide[face];
  const double guess = problem_.firstGuess[face];
  return std::isfinite(guess) ? guess : constraintMean_;
}

UnsetVector<EquationStart> VulkanEquation::makeStarts() const {
  UnsetVector<EquationStart> starts(graph_.faceCount);
  forEachInParallel(starts.size(), [&](uint32_t face) {
    const double base = baseOf(face);
    EquationStart& start = starts[face];
    start = {static_cast<float>(base * valueScale_), 0, isGuided(face) ? kIsGuided : 0};
    if (isUnknown(face))
      start.flags |= kIsUnknown;
    else if (isReachable_[face])
      start.difference = static_cast<float>((problem_.constraints[face] - base) * valueScale_);
  });
  return starts;
}

UnsetVector<float> VulkanEquation::makeSources() const {
  UnsetVector<float> sources(graph_.faceCount);
  forEachInParallel(sources.size(), [&](uint32_t face) {
    const double divergence = problem_.divergence[face];
    sources[face] = std::isfinite(divergence) ? static_cast<float>(divergence * graph_.weightScale * valueScale_) : 0;
  });
  return sources;
}

EquationPush VulkanEquation::push(double scale) const {
  return {.faceCount = graph_.faceCount,
          .workgroupCount = graph_.matrix.grid.workgroupCount,
          .scale = static_cast<float>(scale)};
}

void VulkanEquation::recordResidual(uint32_t which, double scale) {
  commands_.dispatch(kernels_.residual, *residualBindings_[which], bytesOf(push(scale)),
                     graph_.matrix.grid.workgroupCount);
  commands_.barrier();
}

const Buffer& VulkanEquation::scaledResidual() {
  commands_.begin();
  recordResidual(current_, 1 / residualNorm_);
  commands_.submit();
  return scaledResidual_;
}

double VulkanEquation::tryCorrection(const Buffer& y) {
  const uint32_t tried = 1 - current_;
  const BindingSet bindings(
      device_, kernels_.correct,
      std::array<Binding, 4>{y, graph_.matrix.residualWeights, differences_[current_], differences_[tried]});
  commands_.begin();
  commands_.dispatch(kernels_.correct, bindings, bytesOf(push(residualNorm_)), graph_.matrix.grid.workgroupCount);
  commands_.barrier();
  recordResidual(tried, 1);
  triedNorm_ = rootOfSum(submitAndRead(commands_, sums_, sumsOnHost_).residualSquared, graph_.matrix.grid);
  return triedNorm_;
}

void VulkanEquation::accept() {
  current_ = 1 - current_;
  residualNorm_ = triedNorm_;
}

void VulkanEquation::download(std::span<double> values) const {
  const std::vector<float> solution = differences();
  forEachInParallel(values.size(), [&](uint32_t face) {
    if (isUnknown(face)) values[face] = baseOf(face) + static_cast<double>(solution[face]) / valueScale_;
  });
}

}  // namespace asdfvk
