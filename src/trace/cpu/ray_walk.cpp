#include <bit>
#include <cmath>
#include <limits>

#include "shared/cone_hit.h"
#include "trace/cpu/ray_walk.h"

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

struct RayRows {
  using Floats = RayGroup::Floats;

  // The distance to a near plane is plane * inverse + near; to a far plane, plane * inverse + far. nears and fars
  // include the margin of the boxes.
  alignas(32) std::array<Floats, 3> inverses, nears, fars;
  // Shear along mainAxes, the axis of the longest component of the direction (Woop, Benthin and Wald 2013).
  alignas(32) Floats shearsX, shearsY, mainDirections;
  alignas(32) std::array<int32_t, RayGroup::kWidth> signs, mainAxes;  // Bit 0 of the signs: x is negative.
  alignas(32) Floats limits;                                          // RayHitDistance::compared of the nearest hit.
};

ASDFVK_ALWAYS_INLINE inline Float8 absolute(const Float8& x) {
  return reinterpret_cast<Float8>(reinterpret_cast<Ints8>(x) & ~kSignBit);
}

/// Returns x, y or z: the component on the axis on which the direction of the ray is longest.
ASDFVK_ALWAYS_INLINE inline Float8 choose(const Ints8& isZ, const Ints8& isY, const Float8& z, const Float8& y,
                                          const Float8& x) {
  return isZ ? z : isY ? y : x;
}

ASDFVK_ALWAYS_INLINE inline void prepare(const RayGroup& rays, RayRows& rows) {
  Float8 d[3];
  Ints8 signs{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const Float8 origin = load<Float8>(rays.origins[axis].data());
    d[axis] = load<Float8>(rays.directions[axis].data());
    const Ints8 sign = reinterpret_cast<Ints8>(d[axis]) & kSignBit;
    const Float8 tiny = reinterpret_cast<Float8>(sign | std::bit_cast<int32_t>(kTinyDirection));
    const Float8 inverse = 1.0F / (absolute(d[axis]) < kTinyDirection ? tiny : d[axis]);
    const Float8 lower = -(origin + kWideBoxMargin) * inverse, upper = -(origin - kWideBoxMargin) * inverse;
    store(rows.inverses[axis].data(), inverse);
    store(rows.nears[axis].data(), sign != 0 ? upper : lower);
    store(rows.fars[axis].data(), sign != 0 ? lower : upper);
    signs |= sign != 0 ? broadcast<Ints8>(1 << axis) : Ints8{};
  }
  const Ints8 isZ = absolute(d[2]) >= max(absolute(d[0]), absolute(d[1])), isY = absolute(d[1]) > absolute(d[0]);
  const Float8 main = choose(isZ, isY, d[2], d[1], d[0]);
  store(rows.shearsX.data(), choose(isZ, isY, d[0], d[2], d[1]) / main);
  store(rows.shearsY.data(), choose(isZ, isY, d[1], d[0], d[2]) / main);
  store(rows.mainDirections.data(), main);
  store(rows.signs.data(), signs);
  store(rows.mainAxes.data(), isZ ? broadcast<Ints8>(2) : isY ? broadcast<Ints8>(1) : Ints8{});
  rows.limits = rays.ends;
}

/// Writes the children that the ray enters, the farthest first, and returns their number. Needs room for kBvhLaneCount
/// entries. The order is approximate, by slot ^ signs (chooseSlots()).
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline uint32_t enterChildren(const LaneNode& node, const RayRows& rows, size_t ray,
                                                   float* distances, uint32_t* references) {
  const int32_t signs = rows.signs[ray];
  Float8 enter{}, leave = broadcast<Float8>(rows.limits[ray]);
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t isNegative = static_cast<size_t>(signs) >> axis & 1;
    const Float8 inverse = broadcast<Float8>(rows.inverses[axis][ray]);
    const Float8 near = multiplyAdd<Floats>(load<Float8>(node.planes[axis][isNegative].data()), inverse,
                                            broadcast<Float8>(rows.nears[axis][ray]));
    const Float8 far = multiplyAdd<Floats>(load<Float8>(node.planes[axis][1 - isNegative].data()), inverse,
                                           broadcast<Float8>(rows.fars[axis][ray]));
    enter = max(near, enter);
    leave = min(far, leave);
  }
  static_assert(kBvhLaneCount == kLaneCount<Float8>);
#if defined(__x86_64__) && !defined(__clang__)
  if constexpr (kHasShuffles<Floats>) {
    const Ints8 order = Ints8{7, 6, 5, 4, 3, 2, 1, 0} ^ signs;
    const Float8 ordered = __builtin_shuffle(enter, order);
    const uint32_t bits = maskBits<Floats>(ordered <= __builtin_shuffle(leave, order));
    const Ints8 compaction = load<Ints8>(kCompaction.lanes[bits].data());
    store(distances, __builtin_shuffle(ordered, compaction));
    store(references, __builtin_shuffle(__builtin_shuffle(load<Ints8>(node.children.data()), order), compaction));
    return static_cast<uint32_t>(std::popcount(bits));
  }
#endif
  const uint32_t bits = maskBits<Floats>(enter <= leave);
  std::array<float, kBvhLaneCount> enters;
  store(enters.data(), enter);
  uint32_t count = 0;
  for (uint32_t i = kBvhLaneCount; i-- > 0;) {
    const uint32_t slot = i ^ static_cast<uint32_t>(signs);
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
RayHitDistance distanceToPlane(const TrianglePlane& plane, const RayGroup& rays, size_t ray,
                               const RayHitDistance& fromCorners) {
  constexpr double kPlaneTolerance = 0x1p-14;
  const Vec3d origin{rays.origins[0][ray], rays.origins[1][ray], rays.origins[2][ray]},
      direction{rays.directions[0][ray], rays.directions[1][ray], rays.directions[2][ray]};
  const double slope = dot(plane.normal, direction), distance = (plane.offset - dot(plane.normal, origin)) / slope;
  if (!(std::abs(distance - fromCorners.distance) <= kPlaneTolerance)) return fromCorners;
  return {static_cast<float>(distance), static_cast<float>(slope < 0 ? distance + rays.outerSideAddition : distance)};
}

/// Returns whether the hit of the ray changed.
template <typename Floats>
ASDFVK_ALWAYS_INLINE inline bool testBlock(const LaneBlock& block, std::span<const TrianglePlane> planes, RayRows& rows,
                                           size_t ray, RayGroup& rays) {
  const auto z = static_cast<size_t>(rows.mainAxes[ray]), x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
  const float originX = rays.origins[x][ray], originY = rays.origins[y][ray], originZ = rays.origins[z][ray];
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
      planes.empty() ? 0 : maskBits<Floats>(widest * widest > kNarrowTriangle * absolute(det)) & bits;
  bits &= maskBits<Floats>((distance >= rays.begins[ray]) & (compared <= rows.limits[ray])) | narrow;
  std::array<float, kBvhLaneCount> distances, comparedOnes;
  store(distances.data(), distance);
  store(comparedOnes.data(), compared);
  bool isChanged = false;
  for (; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(bits));
    const uint32_t primitive = block.firstPrimitive + lane;
    RayHitDistance hit{distances[lane], comparedOnes[lane]};
    if ((narrow >> lane & 1) != 0) hit = distanceToPlane(planes[primitive], rays, ray, hit);
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

template <typename Floats, bool kEndsAtAnyHit>
ASDFVK_ALWAYS_INLINE inline void walk(const LaneBvh& bvh, std::span<const TrianglePlane> planes, RayGroup& rays,
                                      std::array<RayWalk::Stack, RayGroup::kWidth>& stacks) {
  RayRows rows;
  prepare(rays, rows);
  std::array<uint32_t, RayGroup::kWidth> running, sizes;
  size_t runningCount = 0;
  for (uint32_t bits = rays.active; bits != 0; bits &= bits - 1) {
    const auto ray = static_cast<uint32_t>(std::countr_zero(bits));
    running[runningCount++] = ray;
    sizes[ray] = 1;
    stacks[ray].distances[0] = 0;
    stacks[ray].references[0] = 0;
  }
  while (runningCount > 0)
    for (size_t i = 0; i < runningCount;) {
      const uint32_t ray = running[i];
      RayWalk::Stack& stack = stacks[ray];
      uint32_t size = sizes[ray];
      do --size;
      while (stack.distances[size] > rows.limits[ray] && size > 0);
      if (stack.distances[size] <= rows.limits[ray]) {
        const uint32_t reference = stack.references[size];
        if ((reference & kLaneBlockBit) == 0)
          size +=
              enterChildren<Floats>(bvh.nodes[reference], rows, ray, &stack.distances[size], &stack.references[size]);
        else if (testBlock<Floats>(bvh.blocks[reference & ~kLaneBlockBit], planes, rows, ray, rays) && kEndsAtAnyHit)
          size = 0;
      }
      sizes[ray] = size;
      if (size > 0)
        ++i;
      else
        running[i] = running[--runningCount];
    }
}

}  // namespace

template <bool kEndsAtAnyHit>
void RayWalk::trace(RayGroup& rays) {
  rays.distances.fill(std::numeric_limits<float>::infinity());
  rays.primitives.fill(kNoFace);
  if (bvh_.nodes.empty()) return;
  dispatch<Float8>(instructionSet_, [&]<typename Floats>() ASDFVK_ALWAYS_INLINE {
    walk<Floats, kEndsAtAnyHit>(bvh_, planes_, rays, stacks_);
  });
}

void RayWalk::findNearest(RayGroup& rays) { trace<false>(rays); }

void RayWalk::findAny(RayGroup& rays) { trace<true>(rays); }

}  // namespace asdfvk
