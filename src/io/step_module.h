#pragma once

// The border between the library and the module that reads STEP by Open CASCADE: plain C data. The module is a shared
// library of its own, so that a program that reads no STEP file does not load Open CASCADE.

#include <cstdint>

namespace asdfvk {

/// Changes with every change of this file.
inline constexpr uint32_t kStepModuleVersion = 2;

/// Lengths are in millimetres. A callback returns false to stop the call; it throws nothing.
struct StepModuleCall {
  uint32_t version;   ///< kStepModuleVersion of the caller.
  const char* bytes;  ///< The content of the file.
  uint64_t size;
  double maxAngleRadians;  ///< Greatest angle between consecutive chords of a curve.
  void* context;           ///< Argument of the callbacks.
  /// Receives the name of the unit of length (empty if the file has several units or none) and the bounding box of all
  /// bodies, and sets the chord error, above 0. Called once, before the other callbacks.
  bool (*setChordError)(void* context, const char* unit, const double min[3], const double max[3], double* chordError);
  /// Receives the estimated number of triangles of the next body, for a body of many triangles.
  bool (*expectTriangles)(void* context, double triangleCount);
  /// Receives the name (empty if it has none) and the triangles of a body. points: 3 pointCount coordinates; the points
  /// of the faces are separate, but equal where faces meet. corners: 3 triangleCount indices, counter-clockwise seen
  /// from outside.
  bool (*addBody)(void* context, const char* name, const double* points, uint64_t pointCount, const uint32_t* corners,
                  uint64_t triangleCount);
  /// Places the body with this index, in the order of addBody(). columns: three columns of a linear map, and a
  /// translation.
  bool (*placeBody)(void* context, uint64_t body, const double columns[12]);
  double foundChordError;  ///< The greatest distance that was found between a surface and its triangles.
  // What was left out.
  uint64_t curveCount;       ///< Curves that bound no face.
  uint64_t pointCount;       ///< Points that bound no curve.
  uint64_t failedFaceCount;  ///< Faces that Open CASCADE cannot convert or triangulate.
  uint64_t
      tessellatedCount;  ///< Faces that the file has as triangles, which this version of Open CASCADE does not read.
  char error[200];       ///< Set if the call fails.
};

enum class StepModuleStatus : int32_t { Done, Stopped, Failed, OutOfMemory, OtherVersion };

/// The exported function of the module.
using StepModuleFunction = StepModuleStatus (*)(StepModuleCall* call);
inline constexpr const char* kStepModuleFunction = "asdfvk_read_step";

}  // namespace asdfvk
