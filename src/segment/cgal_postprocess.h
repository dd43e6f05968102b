#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "core/simd.h"
#include "segment/face_neighbours.h"

/// The post-processing of CGAL's sdf_values_postprocessing(): missing values are filled, then all values are smoothed
/// by a bilateral filter and mapped to [0, 1]. Derived from the manual and the outputs of version 5.5.1, without code
/// of CGAL.
namespace asdfvk {

struct CgalValues {
  std::vector<double> normalized;  ///< #F, in [0, 1]; not mapped if all smoothed values are equal.
  double min = 0, max = 0;         ///< Range of the smoothed values, in the unit of the input.
};

/// values: #F, finite, or NaN for no value. On manifold meshes the result differs from the result of CGAL by at most
/// 1e-12. Multiplying the values by a power of two changes no bit of `normalized`. The result has the same bits on any
/// number of threads. Throws Error{NoValues} if no face has a value, and Error{Cancelled}.
[[nodiscard]] CgalValues postprocessLikeCgal(const FaceNeighbours& neighbours, std::span<const double> values,
                                             const RunControl& control = {});

/// The first step of the post-processing. Faces are processed in order. A missing value becomes the mean of the values
/// of the neighbours, including values that were filled before. Values that are still missing at the end become the
/// least value. Throws the errors of postprocessLikeCgal().
[[nodiscard]] std::vector<double> fillMissingValues(const FaceNeighbours& neighbours, std::span<const double> values);

/// The second step of the post-processing; smooth/bilateral.h has its differences from smoothBilaterally(). Let
/// R = 1 + floor(sqrt(#F / 2000)). The value v_f of a face f becomes a weighted mean of the values v_g of the faces g
/// in the rings 0 to R around f; ring 0 is f itself. A face g in ring r has the weight
///   exp(-(r / (R / 2))^2 / 2) exp(-((v_g - v_f) / sigma_f)^2 / 2),
/// with a real division R / 2. sigma_f is 1.5 times the root mean square of v_g - v_f over the same faces g. If sigma_f
/// is 0, v_f does not change. Precondition: the values and their squares are finite. Polls `control` every 256 faces.
/// Throws Error{Cancelled}. Sums have the order of a breadth-first search, so that the bits do not depend on the number
/// of threads. If exp() has the bits of core/lane_exp.h, the bits do not depend on the instruction set either.
[[nodiscard]] std::vector<double> filterLikeCgal(const FaceNeighbours& neighbours, std::span<const double> values,
                                                 const RunControl& control = {},
                                                 InstructionSet instructionSet = widestInstructionSet());

}  // namespace asdfvk
