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

/// What traces the rays. Only Automatic tries several backends; the others throw Error of kind Device if they are not
/// available.
enum class BackendChoice {
  /// A Vulkan device (GPUs first, then CPU devices such as lavapipe), else Cpu. Cpu also computes meshes with too few
  /// rays for a GPU (Report::leastRaysForGpu). If the device fails, the next backend computes the mesh, and the result
  /// has WarningCode::BackendReplaced. Later meshes also use the next backend, except after a lack of device memory.
  Automatic,
  Vulkan,
  Cpu,        ///< The cores of the CPU, in float32.
  Reference,  ///< The cores of the CPU, in double precision.
};

[[nodiscard]] constexpr bool mayUseDevice(BackendChoice choice) {
  return choice == BackendChoice::Automatic || choice == BackendChoice::Vulkan;
}

struct SessionOptions {
  BackendChoice backend = BackendChoice::Automatic;
  /// Vulkan device: an index in listDevices() or a part of a name. Empty: the device of the highest rank.
  std::string device;
  bool requireGpu = false;  ///< Rejects CPU devices, BackendChoice::Cpu and BackendChoice::Reference.
  TraceVariant variant;     ///< Unset members: the default of the device. Set members require Vulkan.
};

/// Label of an input face without a triangle, for example in the field "segment".
inline constexpr uint32_t kNoSegment = 0xffffffff;

/// The parts of the surface that are thinner than the limit, as triangles: whole faces, or parts of large faces.
/// Coordinates are in the unit of the mesh.
struct ThinSurface {
  std::vector<std::array<Vec3d, 3>> triangles;
  std::vector<uint32_t> regions;  ///< For each triangle, an index in ThicknessReport::regions.
};

/// Result of a computation. `fields` has face fields with the following names:
/// - "sdf" and "seed", with Options::measuresDiameter(): the shape diameter in the unit of the mesh; a flag, which is 1
/// for faces that cast rays.
/// - "error", with an error estimate: the expected error in the unit of the mesh; 0 at seeds that keep their value.
/// - "normalized", with Options::postprocesses(): 0 to 1.
/// - "segment", with Options::segmentation: labels, ascending by the mean value of the segment.
/// - "boundary_stability", with Segmentation::Parts: the least PartBoundary::stability of the boundaries at the face;
/// NaN for a face that is at no boundary.
/// - "thickness" and "least_thickness", with Options::measuresThickness(): the wall thickness at the barycentre, and
///   the least one over all points of the face, in the unit of the mesh. A polygon has the least value of its
///   triangles.
/// - "thickness_change", of Scene::compare(): the thickness minus that of the former version.
/// - "gap" and "least_gap", with Options::measuresGap(): the width of the space in front of the face.
/// - "centre" and "component", with Options::computesCentres: the skeleton point (the barycentre, moved inwards along
/// the normal by half of the shape diameter); the number of the component. Edges connect the faces of a component.
/// With PerElement::Vertices, fields per vertex with the same names follow.
struct Result {
  std::vector<Field> fields;
  Report report;
  std::vector<uint64_t> reversedFaces;  ///< Input faces that Options::orientation reversed, ascending.
  ThinSurface thinSurface;              ///< Empty without ThicknessOptions::thinnerThan.
  /// Geometry and hierarchy of the mesh (opaque); null without Options::keepsScene.
  std::shared_ptr<const struct SceneData> scene;

  /// The shape diameter of each input face; NaN: no value. Throws Error{UnknownField} without
  /// Options::measuresDiameter().
  [[nodiscard]] const std::vector<double>& sdf() const {
    return std::get<std::vector<double>>(requireField(fields, "sdf").values);
  }
  /// A flag for each input face: 1 if the face cast rays. Throws as sdf() does.
  [[nodiscard]] const std::vector<uint8_t>& seed() const {
    return std::get<std::vector<uint8_t>>(requireField(fields, "seed").values);
  }
  [[nodiscard]] const Field* field(std::string_view name) const { return findField(fields, name); }
};

[[nodiscard]] ASDFVK_API std::vector<std::string> resultFieldNames();

struct DeviceInfo {
  std::string name, driver, kind;
  bool usable = false;
  /// "chosen" for the default device, else the reason why the device has a lower rank or is rejected.
  std::string reason;
};
/// Lists all Vulkan devices of this machine. reason: if not null, receives the reason for an empty list. requireGpu:
/// marks CPU devices as not usable, as SessionOptions::requireGpu does.
[[nodiscard]] ASDFVK_API std::vector<DeviceInfo> listDevices(std::string* reason = nullptr, bool requireGpu = false);

enum class SessionOpening {
  Now,
  /// If a Vulkan device may be used, a thread opens it while the first computation prepares its mesh. Then the
  /// functions that need the device wait, and throw the errors that the constructor throws otherwise. The destructor
  /// waits, too. With BackendChoice::Automatic, a GPU is opened only for a mesh with enough rays for it.
  InThread,
};

/// A device with its pipelines, for any number of meshes, one after another. Not thread-safe.
class ASDFVK_API Session {
 public:
  /// Throws Error of kind Device, with the reason, if the requested backend or device is not available.
  explicit Session(const SessionOptions& options = {}, SessionOpening opening = SessionOpening::Now);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Whether the backend is open.
  [[nodiscard]] bool isOpen() const;
  /// If the opening has begun, waits for its end. Throws the errors of the constructor. The following three functions
  /// begin the opening, wait and throw, too.
  void finishOpening() const;
  /// First line: the chosen device and the reason. Each further line: a device that was not chosen.
  [[nodiscard]] const std::vector<std::string>& deviceLines() const;
  /// "vulkan", "cpu" or "reference". If BackendChoice::Automatic replaces a backend, backend(), deviceLines() and
  /// runsOnCpu() change.
  [[nodiscard]] const std::string& backend() const;
  /// Whether the CPU traces: the backend is "cpu" or "reference", or Vulkan uses a CPU device.
  [[nodiscard]] bool runsOnCpu() const;

  /// Computes one result for a mesh, which is not changed. For several computations on one mesh, use Scene. Throws
  /// Error of kind Input (no face, index out of range), Usage, Device or Cancelled.
  [[nodiscard]] Result compute(const MeshView& mesh, const Options& options = {}, const RunControl& control = {});
  [[nodiscard]] Result compute(const MeshView& mesh, const CheckedOptions& options, const RunControl& control = {});

 private:
  friend class Scene;
  std::unique_ptr<class SessionState> state_;
};

}  // namespace asdfvk
