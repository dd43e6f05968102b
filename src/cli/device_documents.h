#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "describe/report_json.h"
#include "diagnose/device_report.h"

/// JSON documents about devices.
namespace asdfvk {

/// A Vulkan device of this machine.
struct ListedDevice {
  size_t index;                    ///< Number of the device for `--device`.
  std::string name, driver, kind;  ///< Name of the device, its driver, and its kind, such as `integrated GPU`.
  bool usable;                     ///< Whether asdf-vk can compute on the device.
  std::string reason;              ///< `chosen` for the default device, else why the device is not chosen.
};
ASDFVK_JSON_KEYS(ListedDevice, index, name, driver, kind, usable, reason)

/// What `--list-devices --json` prints.
struct DeviceList {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  std::vector<ListedDevice> devices;       ///< Vulkan devices of this machine.
  std::string reason;                      ///< Why there is no device; empty if there are devices.
};
ASDFVK_JSON_KEYS(DeviceList, formatVersion, devices, reason)

ASDFVK_JSON_KEYS(TracerReport, backend, variant, isDefault, passed, refusal, failure, comparedCount, differingCount,
                 raysPerSecond, kernelRaysPerSecond)
ASDFVK_JSON_KEYS(SolverCheckReport, name, passed, refusal, failure, unknownCount, iterations, finishedOnCpu, difference,
                 seconds)

/// The tested device.
struct TestedDevice {
  std::string name, kind, driver;  ///< Name of the device, its kind, and its driver.
  std::string apiVersion;          ///< Version of Vulkan, such as `1.3.204`.
  uint32_t subgroupSize;           ///< Lanes of a subgroup.
};
ASDFVK_JSON_KEYS(TestedDevice, name, kind, driver, apiVersion, subgroupSize)

/// What the device computes with by default.
struct DeviceDefaults {
  TraceVariant variant;  ///< Variant of the kernels.
  std::string solver;    ///< Name of the solver.
};
ASDFVK_JSON_KEYS(DeviceDefaults, variant, solver)

/// The generated mesh of the test.
struct TestMesh {
  uint64_t faceCount;    ///< Faces of the mesh.
  uint32_t raysPerCone;  ///< Rays per face.
};
ASDFVK_JSON_KEYS(TestMesh, faceCount, raysPerCone)

/// What `--device-report` prints.
struct DeviceReportDocument {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  std::string version, commit;             ///< Version and commit of the program.
  bool passed;                             ///< Whether the self-test passed.
  std::string reason;                      ///< Why there is no Vulkan device, or what validation layers report.
  std::vector<std::string> devices;        ///< The chosen device and the reason, then each rejected device.
  std::optional<TestedDevice> device;      ///< Null without a Vulkan device.
  std::optional<DeviceDefaults> defaults;  ///< Null without a Vulkan device.
  TestMesh mesh;                           ///< The generated mesh of the test.
  std::optional<TracerReport> fastest;     ///< The fastest variant that passed; null if none passed.
  std::vector<TracerReport> tracers;       ///< Each backend and variant.
  std::vector<SolverCheckReport> solvers;  ///< Each solver on the device.
};
ASDFVK_JSON_KEYS(DeviceReportDocument, formatVersion, version, commit, passed, reason, devices, device, defaults, mesh,
                 fastest, tracers, solvers)

}  // namespace asdfvk
