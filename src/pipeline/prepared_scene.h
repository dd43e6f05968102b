#pragma once

#include <utility>

#include "asdf_vk/run_control.h"
#include "bvh/bvh.h"
#include "pipeline/prepared_mesh.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A mesh with everything that computations on it need, except a tracer. It has a fixed address, because tracers refer
/// to it.
struct PreparedScene {
  PreparedMesh prepared;
  Bvh bvh;

  /// Without a hierarchy, see requireHierarchy().
  explicit PreparedScene(PreparedMesh mesh) : prepared(std::move(mesh)) {}
  /// With a hierarchy. Throws the errors of prepareMesh().
  PreparedScene(const MeshView& mesh, Orientation orientation, StageClock& clock, const RunControl& control,
                const BvhOptions& bvhOptions = {})
      : PreparedScene(prepareMesh(mesh, orientation, clock, control)) {
    requireHierarchy(bvhOptions, clock, control);
  }
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  /// Builds the hierarchy, unless it has nodes. options: see Backend::bvhOptions(). Precondition: no tracer refers to a
  /// hierarchy without nodes, and no other thread reads the hierarchy.
  void requireHierarchy(const BvhOptions& options, StageClock& clock, const RunControl& control) {
    if (!bvh.nodes.empty()) return;
    control.checkpoint(0);
    {
      const auto scope = clock.time(Stage::Bvh);
      bvh = buildBvh(prepared.mesh, prepared.geometry, prepared.representatives, options);
    }
    control.checkpoint(0);
  }

  [[nodiscard]] TraceScene view() const { return {prepared.mesh, prepared.geometry, prepared.representatives, bvh}; }
};

}  // namespace asdfvk
