#pragma once

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

  /// Throws the errors of prepareMesh().
  /// bvhOptions: see bvhOptionsFor().
  PreparedScene(const MeshView& mesh, Orientation orientation, StageClock& clock, const RunControl& control,
                const BvhOptions& bvhOptions = {})
      : prepared(prepareMesh(mesh, orientation, clock, control)) {
    control.checkpoint(0);
    {
      const auto scope = clock.time(Stage::Bvh);
      bvh = buildBvh(prepared.mesh, prepared.geometry, prepared.representatives, bvhOptions);
    }
    control.checkpoint(0);
  }
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  [[nodiscard]] TraceScene view() const { return {prepared.mesh, prepared.geometry, prepared.representatives, bvh}; }
};

}  // namespace asdfvk
