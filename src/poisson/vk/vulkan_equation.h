#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "poisson/poisson_solver.h"
#include "poisson/vk/vulkan_system.h"
#include "shared/equation_layout.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

/// The equation of buildPoissonSystem() over all faces of a graph, with its rows and its right-hand side made on the
/// device.
namespace asdfvk {

/// The kernels shaders/poisson/equation_*.comp, created once per device.
struct VulkanEquationKernels {
  explicit VulkanEquationKernels(const Device& device);

  ComputePipeline diagonal, rows, begin, residual, correct;
};

/// A dual graph with weights, and the matrix of all its equations.
struct VulkanGraph {
  /// weights: one per arc, see featureWeights(). Throws Error{EquationLimit}, see requireSystemFits().
  VulkanGraph(const Device& device, const VulkanEquationKernels& kernels, const DualGraph& graph,
              std::span<const double> weights);

  uint32_t faceCount;
  double weightScale;   ///< Factor of the weights on the device.
  VulkanMatrix matrix;  ///< The tailColumns of the matrix are the neighbours of the graph. Each VulkanEquation sets the
                        ///< residual weights of the matrix.
  Buffer arcOffsets, weights;

 private:
  // The kernels that make the rows use these; the constructor does not wait for them.
  BindingSet diagonalBindings_, rowBindings_;
  CommandList commands_;  // Destroyed first; its destructor waits.
};

/// One equation and its solution. The solution is stored in float32 as differences from a base: from the guide or,
/// without a guide, from the first guess. Norms are those of asdfvk::residualNorm() with values multiplied by
/// valueScale_. The arguments must outlive this object.
class VulkanEquation {
 public:
  VulkanEquation(const Device& device, const VulkanEquationKernels& kernels, const VulkanGraph& graph,
                 const GraphProblem& problem);

  [[nodiscard]] double rightHandNorm() const { return rightHandNorm_; }
  /// Norm of the residual of the solution.
  [[nodiscard]] double residualNorm() const { return residualNorm_; }
  /// The vector b of (I - S) y = b, made from the residual of the solution and scaled to the weighted norm 1.
  /// Overwritten by tryCorrection().
  [[nodiscard]] const Buffer& scaledResidual();
  /// y represents a correction. Adds the correction to a copy of the solution, and returns the norm of the residual of
  /// the copy. accept() makes the copy the solution.
  [[nodiscard]] double tryCorrection(const Buffer& y);
  void accept();

  /// Writes the values of the unknown faces. values: #F.
  void download(std::span<double> values) const;
  /// Residual weights and differences, #F, for tests.
  [[nodiscard]] std::vector<float> residualWeights() const {
    return downloadPoissonVector(device_, graph_.matrix.residualWeights, graph_.faceCount);
  }
  [[nodiscard]] std::vector<float> differences() const {
    return downloadPoissonVector(device_, differences_[current_], graph_.faceCount);
  }

 private:
  [[nodiscard]] UnsetVector<EquationStart> makeStarts() const;
  [[nodiscard]] UnsetVector<float> makeSources() const;
  [[nodiscard]] EquationPush push(double scale) const;
  void recordResidual(uint32_t which, double scale);
  [[nodiscard]] bool isUnknown(uint32_t face) const {
    return isReachable_[face] != 0 && !std::isfinite(problem_.constraints[face]);
  }
  [[nodiscard]] bool isGuided(uint32_t face) const;
  [[nodiscard]] double baseOf(uint32_t face) const;

  const Device& device_;
  const VulkanEquationKernels& kernels_;
  const VulkanGraph& graph_;
  const GraphProblem& problem_;
  std::vector<uint8_t> isReachable_;
  double constraintMean_ = 0, valueScale_ = 1;  ///< valueScale_: factor of the values on the device.
  Buffer sources_, scaledResidual_, sums_, sumsOnHost_;
  std::array<Buffer, 2> differences_;  ///< The solution and its corrected copy.
  uint32_t current_ = 0;               ///< Index of the solution in differences_.
  std::array<std::optional<BindingSet>, 2> residualBindings_;
  CommandList commands_;
  double rightHandNorm_ = 0, residualNorm_ = 0, triedNorm_ = 0;
};

}  // namespace asdfvk
