#pragma once

#include <cstdint>

#include "generate/capsule_union.h"
#include "generate/generated_shape.h"

namespace asdfvk {

// Smooth unions of capsules with the part and the local diameter of each face. Heights are about 2, z is up. With about
// 2000 faces or more the surfaces are topological spheres. With fewer faces neighbouring limbs may touch.

/// Parts: 0 torso, 1 neck, 2 head, 3 tail, 4 and 5 front legs, 6 and 7 hind legs (left, right), 8 and 9 ears.
[[nodiscard]] CapsuleUnion animalField();
/// Parts: 0 palm, 1 thumb, 2 to 5 fingers from the index on, 6 forearm.
[[nodiscard]] CapsuleUnion handField();
/// Parts: 0 torso, 1 neck, 2 head. Left and right: 3, 4 upper arm; 5, 6 forearm; 7, 8 hand; 9, 10 thigh; 11, 12 shin;
/// 13, 14 foot.
[[nodiscard]] CapsuleUnion figureField();
/// A tree of tubes: 31 branches in five levels. Each branch is a part. Parts are numbered depth-first from the root.
[[nodiscard]] CapsuleUnion treeField();

[[nodiscard]] GeneratedShape makeAnimal(uint64_t faceCount);
[[nodiscard]] GeneratedShape makeHand(uint64_t faceCount);
[[nodiscard]] GeneratedShape makeFigure(uint64_t faceCount);
[[nodiscard]] GeneratedShape makeTree(uint64_t faceCount);

}  // namespace asdfvk
