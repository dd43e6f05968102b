#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"

namespace asdfvk {

/// The backend that traces the rays. Backends and kernel variants are names, listed by backendNames().
struct SessionOptions {
  /// "auto": a Vulkan device (GPUs first, CPU devices such as lavapipe included), else "cpu".
  /// If the device of "auto" is lost, computes wrong values or is out of memory, the next backend computes the mesh.
  /// Unless memory was short, it also computes all later meshes. Each has WarningCode::BackendReplaced.
  /// "vulkan", "cpu" (float32 in lanes) and "reference" (double precision) fail with Error{Device} where they are not
  /// available.
  std::string backend = "auto";
  std::string device;       ///< Vulkan device: an index in listDevices() or a part of a name; empty: the highest rank.
  bool requireGpu = false;  ///< Reject CPU devices, "cpu" and "reference".
  TraceVariant variant;     ///< Empty members: the default of the device. Other values require Vulkan.
};

/// The entry of the field "segment" for an input face without a triangle.
inline constexpr uint32_t kNoSegment = 0xffffffff;

/// The thin parts of the surface as triangles, in the unit of the mesh: thin faces, or parts of large ones.
struct ThinSurface {
  std::vector<std::array<Vec3d, 3>> triangles;
  std::vector<uint32_t> regions;  ///< One per triangle: index in ThicknessReport::regions.
};

/// Result of a computation. Fields: unless only the thickness is measured (Options::measuresDiameter()), "sdf" (the
/// shape diameter in the unit of the mesh) and "seed" (1 where rays were cast); with an estimate "error" (expected
/// error in the unit of the mesh; 0 at seeds that keep their value); with Options::postprocess "normalized" (0 to 1);
/// with Options::segmentation "segment" (ascending by the mean value); with Options::measuresThickness() "thickness"
/// (at the barycentre, in the unit of the mesh) and "least_thickness" (over all points of the face), of an input face
/// that is a polygon the least of its triangles; with Options::computesCentres "centre" (x, y, z: the barycentre, moved
/// inwards along the normal by half of the shape diameter) and "component" (faces connected by edges). With
/// PerElement::Vertices fields per vertex with the same names follow those per face.
struct Result {
  std::vector<Field> fields;
  Report report;
  std::vector<uint64_t> reversedFaces;  ///< Input faces that Options::orientation reversed, ascending.
  ThinSurface thinSurface;              ///< Empty without ThicknessOptions::thinnerThan.
  /// Geometry and hierarchy of the mesh, opaque; set with Options::keepsScene.
  std::shared_ptr<const struct SceneData> scene;

  /// #I, NaN = no value. Throws Error{UnknownField} without Options::measuresDiameter().
  [[nodiscard]] const std::vector<double>& sdf() const {
    return std::get<std::vector<double>>(requireField(fields, "sdf").values);
  }
  /// #I, 1 where rays were cast. Throws as sdf() does.
  [[nodiscard]] const std::vector<uint8_t>& seed() const {
    return std::get<std::vector<uint8_t>>(requireField(fields, "seed").values);
  }
  /// The field per face. Null where the result has no such field.
  [[nodiscard]] const Field* field(std::string_view name) const { return findField(fields, name); }
};

/// Names of all fields that a result may have.
[[nodiscard]] ASDFVK_API std::vector<std::string> resultFieldNames();

struct DeviceInfo {
  std::string name, driver, kind;
  bool usable = false;
  std::string reason;  ///< "chosen" by default, or the reason why it is ranked lower or rejected.
};
/// Every Vulkan device of this machine. If the list is empty for lack of a Vulkan loader, `reason` is set. requireGpu:
/// CPU devices are not usable, as with SessionOptions::requireGpu.
[[nodiscard]] ASDFVK_API std::vector<DeviceInfo> listDevices(std::string* reason = nullptr, bool requireGpu = false);

[[nodiscard]] ASDFVK_API std::vector<std::string> backendNames();

/// A device with its pipelines, for any number of meshes one after another. Not thread-safe.
class ASDFVK_API Session {
 public:
  /// Throws Error{Device} with a reason where the requested backend or device is not available.
  explicit Session(const SessionOptions& options = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// First line: the chosen device and the reason. Then one line per device that was not chosen.
  [[nodiscard]] const std::vector<std::string>& deviceLines() const;
  /// "vulkan", "cpu" or "reference"; changes where "auto" replaces a backend, as deviceLines() and runsOnCpu().
  [[nodiscard]] const std::string& backend() const;
  /// Whether the CPU traces: "cpu", "reference", or a CPU device of Vulkan.
  [[nodiscard]] bool runsOnCpu() const;

  /// For several computations on one mesh see Scene. Does not change the mesh. Throws Error of kind Input (no face,
  /// index out of range), Usage, Device or Cancelled.
  [[nodiscard]] Result compute(const MeshView& mesh, const Options& options = {}, const RunControl& control = {});

 private:
  friend class Scene;
  std::unique_ptr<class SessionState> state_;
};

}  // namespace asdfvk
