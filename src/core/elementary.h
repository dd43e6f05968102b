#pragma once

namespace asdfvk {

// Functions of <cmath> whose bits do not depend on the C library and the processor, for values that a result shows.
// They are computed with 106 bits and rounded, so that nearly all results are the doubles nearest to the true values.
// They take about a microsecond.

/// Precondition: |radians| <= 10,000.
[[nodiscard]] double sine(double radians);
[[nodiscard]] double cosine(double radians);

/// The angle of the vector (x, y), from -pi to pi, as std::atan2(y, x). Precondition: the numbers are finite.
[[nodiscard]] double angleOf(double y, double x);

/// base to the power of the exponent. Precondition: base > 0; the result and its logarithm are neither tiny nor huge.
[[nodiscard]] double power(double base, double exponent);

}  // namespace asdfvk
