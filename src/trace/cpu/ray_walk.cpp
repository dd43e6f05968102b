#include "trace/cpu/ray_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "bvh/wide_boxes.h"
#include "shared/cone_hit.h"

namespace asdfvk {
namespace {

using Ints8 = IntsOf<Float8>;
constexpr int32_t kSignBit = std::numeric_limits<int32_t>::min();
constexpr float kTinyDirection = 1e-20F;

// GCC accepts the builtins of AVX2 and FMA in an always-inlined template, even if the file is compiled without AVX2 and
// FMA. (GCC declares these builtins at the first function for the instruction set: runWithAvx2() in core/simd.h.) Clang
// does not accept them, so clang compiles the generic code below.
#if defined(__x86_64__) && !defined(__clang__)
template <typename Floats>
constexpr bool kHasShuffles = sizeof(Floats) >= sizeof(Float8);

/// For each mask an order of the lanes that begins with the lanes of the set bits, ascending.
struct CompactionTable {
  alignas(64) std::array<std::array<int32_t, kBvhLaneCount>, 1U << kBvhLaneCount> lanes{};

  constexpr CompactionTable() {
    for (uint32_t bits = 0; bits < lanes.size(); ++bits) {
      size_t count = 0;
      for (int32_t lane = 0; lane < static_cast<int32_t>(kBvhLaneCount); ++lane)
        if ((bits >> lane & 1) != 0) lanes[bits][count++] = lane;
    }
  }
};
constexpr CompactionTable kCompaction;
#endif

template <typename Floats>
ASDFVK_ALWAYS_INLINE inline uint32_t maskBits(const Ints8& mask) {
#if defined(__x86_64__) && !defined(__clang__)
  if constexpr (kHasShuffles<Floats>)
    return static_cast<uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Float8>(mask)));
#endif
  return bitsOf(mask);
}

/// a * b + c, rounded once or twice. Used only for boxes, because their margin covers the difference.
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline Float8 multiplyAdd(const Float8& a, const Float8& b, const Float8& c) {
#if defined(__x86_64__) && !defined(__clang__)
  if constexpr (kHasShuffles<Floats>) return __builtin_ia32_vfmaddps256(a, b, c);
#endif
  return a * b + c;
}

/// Data of each ray that the steps of the walk read, prepared so that each value is a single load.
struct RayRows {
  using Floats = RayGroup::Floats;
  using Indices = RayGroup::Indices;

  // The distance to a near plane is plane * inverse + near; to a far plane, plane * inverse + far. nears and fars
  // include the margin of the boxes.
  alignas(32) std::array<Floats, 3> inverses, nears, fars;
  // Shear along mainAxes, the axis of the longest component of the direction (Woop, Benthin and Wald 2013). The main
  // axis becomes z; x and y are the next two axes.
  alignas(32) Floats shearsX, shearsY, mainDirections;
  alignas(32) Floats originsX, originsY, originsZ;
  // Bit `axis` of a flip is set if the direction is positive along the axis. The ray enters slot j ^ flip before slot
  // i ^ flip if i < j.
  alignas(32) std::array<int32_t, RayGroup::kWidth> flips, mainAxes;
  // Positions of planes in a LaneNode, in bytes: near x, far x, near y, far y, near z, far z.
  alignas(32) std::array<Indices, 6> planeOffsets;
  alignas(32) std::array<float, kLaneCount<Float8>> zeros{};
  alignas(32) Floats limits;  // RayHitDistance::compared of the nearest hit.
};

ASDFVK_ALWAYS_INLINE inline Float8 absolute(const Float8& x) {
  return reinterpret_cast<Float8>(reinterpret_cast<Ints8>(x) & ~kSignBit);
}

/// Returns x, y or z: the component on the axis on which the direction of the ray is longest.
ASDFVK_ALWAYS_INLINE inline Float8 choose(const Ints8& isZ, const Ints8& isY, const Float8& z, const Float8& y,
                                          const Float8& x) {
  return isZ ? z : isY ? y : x;
}

/// Sets the rows, except `limits`, for the eight rays from `first` on.
ASDFVK_ALWAYS_INLINE inline void prepare(const RayGroup& rays, size_t first, RayRows& rows) {
  Float8 d[3], o[3];
  Ints8 flips{};
  for (size_t axis = 0; axis < 3; ++axis) {
    o[axis] = load<Float8>(&rays.origins[axis][first]);
    d[axis] = load<Float8>(&rays.directions[axis][first]);
    const Ints8 sign = reinterpret_cast<Ints8>(d[axis]) & kSignBit;
    const Float8 tiny = reinterpret_cast<Float8>(sign | std::bit_cast<int32_t>(kTinyDirection));
    const Float8 inverse = 1.0F / (absolute(d[axis]) < kTinyDirection ? tiny : d[axis]);
    const Float8 lower = -(o[axis] + kWideBoxMargin) * inverse, upper = -(o[axis] - kWideBoxMargin) * inverse;
    store(&rows.inverses[axis][first], inverse);
    store(&rows.nears[axis][first], sign != 0 ? upper : lower);
    store(&rows.fars[axis][first], sign != 0 ? lower : upper);
    constexpr int32_t kRowSize = sizeof(LaneNode::planes[0][0]);
    const auto lowerOffset = static_cast<int32_t>(offsetof(LaneNode, planes) + 2 * axis * kRowSize);
    const Ints8 change = Ints8{sign != 0} & kRowSize;
    store(&rows.planeOffsets[2 * axis][first], lowerOffset + change);
    store(&rows.planeOffsets[2 * axis + 1][first], lowerOffset + kRowSize - change);
    flips |= sign != 0 ? Ints8{} : broadcast<Ints8>(1 << axis);
  }
  const Ints8 isZ = absolute(d[2]) >= max(absolute(d[0]), absolute(d[1])), isY = absolute(d[1]) > absolute(d[0]);
  const Float8 main = choose(isZ, isY, d[2], d[1], d[0]);
  store(&rows.shearsX[first], choose(isZ, isY, d[0], d[2], d[1]) / main);
  store(&rows.shearsY[first], choose(isZ, isY, d[1], d[0], d[2]) / main);
  store(&rows.mainDirections[first], main);
  store(&rows.flips[first], flips);
  store(&rows.mainAxes[first], isZ ? broadcast<Ints8>(2) : isY ? broadcast<Ints8>(1) : Ints8{});
  store(&rows.originsX[first], choose(isZ, isY, o[0], o[2], o[1]));
  store(&rows.originsY[first], choose(isZ, isY, o[1], o[0], o[2]));
  store(&rows.originsZ[first], choose(isZ, isY, o[2], o[1], o[0]));
}

/// Writes the children that the ray enters, the farthest first, and returns their number. Needs room for kBvhLaneCount
/// entries. The order is approximate (chooseSlots()).
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline uint32_t enterChildren(const LaneNode& node, const RayRows& rows, size_t ray,
                                                   float* distances, uint32_t* references) {
  // `number - Float8{}` has the number in all lanes and is one instruction of AVX; broadcast() is three. The maximum
  // with a constant 0 is three, too; with zeros from memory it is one.
  Float8 enter = load<Float8>(rows.zeros.data()), leave = rows.limits[ray] - Float8{};
  const auto planes = [&](size_t row) ASDFVK_ALWAYS_INLINE {
    return load<Float8>(
        reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(&node) + rows.planeOffsets[row][ray]));
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    const Float8 inverse = rows.inverses[axis][ray] - Float8{};
    const Float8 near = multiplyAdd<Floats>(planes(2 * axis), inverse, rows.nears[axis][ray] - Float8{});
    const Float8 far = multiplyAdd<Floats>(planes(2 * axis + 1), inverse, rows.fars[axis][ray] - Float8{});
    enter = max(near, enter);
    leave = min(far, leave);
  }
  static_assert(kBvhLaneCount == kLaneCount<Float8>);
#if defined(__x86_64__) && !defined(__clang__)
  if constexpr (kHasShuffles<Floats>) {
    const Ints8 flip = rows.flips[ray] - Ints8{};
    const uint32_t bits = maskBits<Floats>(__builtin_shuffle(enter <= leave, Ints8{0, 1, 2, 3, 4, 5, 6, 7} ^ flip));
    const Ints8 slots = load<Ints8>(kCompaction.lanes[bits].data()) ^ flip;
    store(distances, __builtin_shuffle(enter, slots));
    store(references, __builtin_shuffle(load<Ints8>(node.children.data()), slots));
    return static_cast<uint32_t>(std::popcount(bits));
  }
#endif
  const uint32_t bits = maskBits<Floats>(enter <= leave);
  std::array<float, kBvhLaneCount> enters;
  store(enters.data(), enter);
  uint32_t count = 0;
  for (uint32_t i = 0; i < kBvhLaneCount; ++i) {
    const uint32_t slot = i ^ static_cast<uint32_t>(rows.flips[ray]);
    if ((bits >> slot & 1) == 0) continue;
    distances[count] = enters[slot];
    references[count++] = node.children[slot];
  }
  return count;
}

/// A triangle is narrow if width^2 / (2 area) is above this number; width and area are those seen along the ray.
constexpr float kNarrowTriangle = 32;

struct RayHitDistance {
  float distance, compared;
};

/// The distance to the plane or, if the plane is not near the hit, `fromCorners`.
RayHitDistance distanceToPlane(const TraceScene& scene, uint32_t primitive, const RayGroup& rays, size_t ray,
                               const RayHitDistance& fromCorners) {
  const uint32_t face = scene.bvh.primitiveFaces[primitive];
  const Vec3d& normal = scene.geometry.normals[face];
  const Vec3d origin{rays.origins[0][ray], rays.origins[1][ray], rays.origins[2][ray]},
      direction{rays.directions[0][ray], rays.directions[1][ray], rays.directions[2][ray]};
  const double slope = dot(normal, direction),
               distance = (dot(normal, scene.originOf(face)) - dot(normal, origin)) / slope;
  if (!(std::abs(distance - fromCorners.distance) <= kPlaneTolerance)) return fromCorners;
  return {static_cast<float>(distance), static_cast<float>(slope < 0 ? distance + rays.outerSideAddition : distance)};
}

/// Returns whether the hit of the ray changed.
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline bool testBlock(const LaneBlock& block, const TraceScene* scene, RayRows& rows, size_t ray,
                                           RayGroup& rays) {
  static constexpr std::array<uint8_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};
  const auto z = static_cast<size_t>(rows.mainAxes[ray]), x = size_t{kNext[z]}, y = size_t{kPrevious[z]};
  const float originX = rows.originsX[ray], originY = rows.originsY[ray], originZ = rows.originsZ[ray];
  const float shearX = rows.shearsX[ray], shearY = rows.shearsY[ray];
  struct Corner {
    Float8 x, y, z;  // x, y: across the ray. z: along the main axis.
  };
  // The result depends only on the corner and the ray.
  const auto corner = [&](size_t k) ASDFVK_ALWAYS_INLINE {
    const Float8 along = load<Float8>(block.corners[k][z].data()) - originZ;
    return Corner{(load<Float8>(block.corners[k][x].data()) - originX) - shearX * along,
                  (load<Float8>(block.corners[k][y].data()) - originY) - shearY * along, along};
  };
  const Corner a = corner(0), b = corner(1), c = corner(2);
  // Edge functions. Rounding can change an edge function to zero, which counts as inside, but not invert its sign.
  const Float8 edgeA = c.x * b.y - c.y * b.x, edgeB = a.x * c.y - a.y * c.x, edgeC = b.x * a.y - b.y * a.x;
  const Float8 det = edgeA + edgeB + edgeC;
  const Ints8 sign = reinterpret_cast<Ints8>(det) & kSignBit;
  const auto turned = [&](const Float8& edge) ASDFVK_ALWAYS_INLINE {
    return reinterpret_cast<Float8>(reinterpret_cast<Ints8>(edge) ^ sign);
  };
  const Float8 least = min(min(turned(edgeA), turned(edgeB)), turned(edgeC));
  uint32_t bits = maskBits<Floats>((least >= 0) & (det != 0));
  if (bits == 0) return false;
  const float mainDirection = rows.mainDirections[ray];
  const Float8 distance = (edgeA * a.z + edgeB * b.z + edgeC * c.z) / (det * mainDirection);
  const Ints8 isOuterSide = (sign ^ std::bit_cast<int32_t>(mainDirection)) >= 0;
  const Float8 compared = isOuterSide ? distance + rays.outerSideAddition : distance;
  const auto extent = [&](const Corner& p) ASDFVK_ALWAYS_INLINE { return max(absolute(p.x), absolute(p.y)); };
  const Float8 widest = max(max(extent(a), extent(b)), extent(c));
  const uint32_t narrow =
      scene == nullptr ? 0 : maskBits<Floats>(widest * widest > kNarrowTriangle * absolute(det)) & bits;
  bits &= maskBits<Floats>((distance >= rays.begins[ray]) & (compared <= rows.limits[ray])) | narrow;
  std::array<float, kBvhLaneCount> distances, comparedOnes;
  store(distances.data(), distance);
  store(comparedOnes.data(), compared);
  bool isChanged = false;
  for (; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(bits));
    const uint32_t primitive = block.firstPrimitive + lane;
    RayHitDistance hit{distances[lane], comparedOnes[lane]};
    if ((narrow >> lane & 1) != 0) hit = distanceToPlane(*scene, primitive, rays, ray, hit);
    const float limit = rows.limits[ray];
    if (primitive == rays.skipped[ray] || hit.distance < rays.begins[ray] || hit.compared > limit ||
        (hit.compared == limit && primitive > rays.primitives[ray]))
      continue;
    rows.limits[ray] = hit.compared;
    rays.distances[ray] = hit.distance;
    rays.primitives[ray] = primitive;
    isChanged = true;
  }
  return isChanged;
}

/// The entry at the bottom of a stack. Its distance is below every limit, so that no limit removes the entry.
constexpr float kEndDistance = -std::numeric_limits<float>::infinity();
constexpr uint32_t kEnd = ~0U;
static_assert((kEnd & kLaneBlockBit) != 0);

/// Prefetches the referenced block, which the next step of the ray probably tests. If the reference is a node, block 0
/// is prefetched instead, so that the function needs no branch: the kind of a reference is unpredictable. The address
/// for kEnd is invalid; prefetching it has no effect.
ASDFVK_ALWAYS_INLINE inline void prefetchBlock(const LaneBvh& bvh, uint32_t reference) {
  const auto index = static_cast<uintptr_t>(std::max(static_cast<int32_t>(reference ^ kLaneBlockBit), 0));
  const uintptr_t block = reinterpret_cast<uintptr_t>(bvh.blocks.data()) + index * sizeof(LaneBlock);
  for (size_t offset = 0; offset < sizeof(LaneBlock); offset += alignof(LaneBlock))
    __builtin_prefetch(reinterpret_cast<const void*>(block + offset));
}

template <typename Floats, bool kEndsAtAnyHit>
ASDFVK_ALWAYS_INLINE inline void walk(const LaneBvh& bvh, const TraceScene* scene, RayGroup& rays,
                                      std::array<RayWalk::Stack, RayGroup::kWidth>& stacks) {
  RayRows rows;
  for (size_t first = 0; first < RayGroup::kWidth; first += kLaneCount<Float8>) prepare(rays, first, rows);
  rows.limits = rays.ends;
  std::array<uint32_t, RayGroup::kWidth> running;
  std::array<float*, RayGroup::kWidth> tops;  // Distances of the entries on the top.
  size_t runningCount = 0;
  for (uint32_t bits = rays.active; bits != 0; bits &= bits - 1) {
    const auto ray = static_cast<uint32_t>(std::countr_zero(bits));
    running[runningCount++] = ray;
    stacks[ray].distances[0] = kEndDistance;
    stacks[ray].references[0] = kEnd;
    stacks[ray].distances[1] = 0;
    stacks[ray].references[1] = 0;
    tops[ray] = &stacks[ray].distances[1];
  }
  while (runningCount > 0)
    for (size_t i = 0; i < runningCount;) {
      const uint32_t ray = running[i];
      float* top = tops[ray];
      const float limit = rows.limits[ray];
      while (*top > limit) --top;
      uint32_t* const references = stacks[ray].referenceOf(top);
      const uint32_t reference = *references;
      if ((reference & kLaneBlockBit) == 0) {
        top += enterChildren<Floats>(bvh.nodes[reference], rows, ray, top, references);
        --top;
      } else if (reference != kEnd) {
        const bool isHit = testBlock<Floats>(bvh.blocks[reference & ~kLaneBlockBit], scene, rows, ray, rays);
        --top;
        if (isHit && kEndsAtAnyHit) top = &stacks[ray].distances[0];
      } else {
        running[i] = running[--runningCount];
        continue;
      }
      prefetchBlock(bvh, *stacks[ray].referenceOf(top));
      tops[ray] = top;
      ++i;
    }
}

}  // namespace

template <bool kEndsAtAnyHit>
void RayWalk::trace(RayGroup& rays) {
  rays.distances.fill(std::numeric_limits<float>::infinity());
  rays.primitives.fill(kNoFace);
  if (bvh_.nodes.empty()) return;
  dispatch<Float8>(instructionSet_, [&]<typename Floats>() ASDFVK_ALWAYS_INLINE {
    walk<Floats, kEndsAtAnyHit>(bvh_, scene_, rays, stacks_);
  });
}

void RayWalk::findNearest(RayGroup& rays) { trace<false>(rays); }

void RayWalk::findAny(RayGroup& rays) { trace<true>(rays); }

}  // namespace asdfvk
