#pragma once

#include <cstdint>
#include <vector>

#include "core/function_ref.h"
#include "pipeline/prepared_scene.h"
#include "trace/solids.h"

namespace asdfvk {

/// A part of the space without a way out.
struct EnclosedSpace {
  uint32_t part = 0;  ///< Its outer boundary: the value of SpaceParts::solids.solidOf.
  double volume = 0;  ///< In mesh units cubed, without the bodies inside.
  /// False if its boundary could not be divided into faces that lie on no other face. Then it may have a way out, and
  /// the volume is uncertain.
  bool isCertain = true;
  std::vector<uint32_t> looseParts = {};  ///< The boundaries of bodies inside.
};

/// The connected parts of a surface of the space around a material. At an edge of several faces, the two faces that
/// bound the same space are connected.
struct SpaceParts {
  Solids solids;  ///< Closed: the outer boundaries of sealed voids without bodies inside.
  std::vector<EnclosedSpace> voids;
};

/// scene: faces are oriented outwards, seen from the space. boundsMaterial(face): whether material is behind the face.
/// mayOverlap: faces of several bodies may lie on each other.
[[nodiscard]] SpaceParts findSpaceParts(const PreparedScene& scene, FunctionRef<bool(uint32_t)> boundsMaterial,
                                        bool mayOverlap);

}  // namespace asdfvk
