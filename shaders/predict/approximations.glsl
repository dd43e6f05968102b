// The approximations of src/core/simd.h and src/predict/prediction_kernel.cpp, for equal systematic errors.

// exp(-x) with a relative error of 1e-4, for x from 0 to 80.
float expNegative(float x) {
  const float exponent = 127.0 - x * 1.44269504;
  const float whole = floor(exponent);
  const float rest = exponent - whole;
  const float powerOfRest = 0.99992522 + rest * (0.695833507 + rest * (0.226067254 + rest * 0.0780244537));
  return powerOfRest * uintBitsToFloat(uint(whole) << 23);
}

// The square of the angle with this cosine, by a series. Error: 0.3 % at 90 degrees. Weights of larger angles are about
// 0.
float squaredAngle(float cosine) {
  const float u = max(1.0 - cosine, 0.0);
  return u * (2.0 + u * (1.0 / 3.0 + u * (4.0 / 45.0 + u * (1.0 / 35.0 + u * (16.0 / 1575.0)))));
}

// sqrt(x) / arccos(1 - x) for 0 <= x <= 1, with a relative error of 3e-4.
float sqrtOverAngle(float x) { return 0.706948624 - x * (0.0564995318 + x * 0.0136869098); }
