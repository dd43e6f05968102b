#include "bvh/wide_bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/parallel.h"
#include "core/simd.h"

namespace asdfvk {
namespace {

// Subtrees whose level is less than this are separate tasks.
constexpr uint32_t kParallelSearchLevelCount = 10;

float halfAreaOf(const BvhNode& node) { return Box3f{node.min, node.max}.halfArea(); }

// Entry [i - 1]: the least cost of i children from both sides, and the number of these children from the left side.
struct Sharing {
  std::array<float, kWideChildCount> costs;
  std::array<int32_t, kWideChildCount> leftCounts;
};

// Vectorised over i; loops over the number k of children from the left side. Of equal costs, the least k counts. More
// than maxLeftCount children from the left side are never cheaper.
ASDFVK_ALWAYS_INLINE inline Sharing shareChildren(const std::array<float, kWideChildCount>& left, uint32_t maxLeftCount,
                                                  const std::array<float, kWideChildCount>& right) {
  const auto infinity = broadcast<Float8>(std::numeric_limits<float>::infinity());
  Float8 least = infinity, rightCosts = load<Float8>(right.data());
  IntsOf<Float8> leftCounts{};
  for (uint32_t k = 1; k <= maxLeftCount; ++k) {
    // Entry [i - 1] becomes that of i - k children; at least one child comes from the right side.
    rightCosts = __builtin_shufflevector(rightCosts, infinity, 8, 0, 1, 2, 3, 4, 5, 6);
    const Float8 costs = rightCosts + left[k - 1];
    const IntsOf<Float8> isLess = costs < least;
    least = isLess ? costs : least;
    leftCounts = isLess ? broadcast<IntsOf<Float8>>(static_cast<int32_t>(k)) : leftCounts;
  }
  Sharing sharing;
  store(sharing.costs.data(), least);
  store(sharing.leftCounts.data(), leftCounts);
  return sharing;
}

constexpr int kExponentBias = 127;
constexpr uint32_t kMaxByte = 255;

// Exponents of normal doubles, from their bits. Library calls would dominate the time of quantizeBoxes().
int exponentOf(double positive) { return static_cast<int>(std::bit_cast<uint64_t>(positive) >> 52) - 1023; }
double powerOfTwo(int e) { return std::bit_cast<double>(static_cast<uint64_t>(e + 1023) << 52); }

// The least e with extent <= 255 * 2^e.
int exponentFor(double extent) {
  int e = exponentOf(extent / kMaxByte) + 1;
  if (kMaxByte * powerOfTwo(e - 1) >= extent) --e;
  return std::max(e, 1 - kExponentBias);
}

ASDFVK_ALWAYS_INLINE inline Double4 widened(const Vec3f& v) {
  return __builtin_convertvector(Float4{v.x, v.y, v.z, 0}, Double4);
}

// quantizeBoxes() with the axes as lanes.
ASDFVK_ALWAYS_INLINE inline DeviceWideNode quantizeInLanes(std::span<const Box3f> children,
                                                           const std::array<uint32_t, kWideChildCount>& slots) {
  using Longs = IntsOf<Double4>;
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f origin = all.min - Vec3f{kWideBoxMargin, kWideBoxMargin, kWideBoxMargin};
  DeviceWideNode node{};
  node.origin = {origin.x, origin.y, origin.z};
  const double margin = kWideBoxMargin;
  const Double4 start = widened(origin), extents = widened(all.max) + margin - start;
  Double4 perUnit{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const int e = exponentFor(extents[axis]);
    node.exponents |= static_cast<uint32_t>(e + kExponentBias) << 8 * axis;
    perUnit[axis] = powerOfTwo(-e);
  }
  // At first each slot is empty: the lower corner of its box is above the upper corner.
  Longs lowers = broadcast<Longs>(-1), uppers{}, allUpperBytes{};
  for (size_t i = 0; i < children.size(); ++i) {
    const Double4 lower = max((widened(children[i].min) - margin - start) * perUnit, Double4{});
    const Double4 upper = (widened(children[i].max) + margin - start) * perUnit;
    // The numbers are not negative. Therefore conversion to integers rounds down.
    const auto lowerFloor = __builtin_convertvector(lower, IntsOf<Float4>);
    const auto upperFloor = __builtin_convertvector(upper, IntsOf<Float4>);
    const Longs lowerBytes = __builtin_convertvector(lowerFloor, Longs);
    // Rounds up: a comparison gives -1 where it is true.
    const Longs upperBytes =
        __builtin_convertvector(upperFloor, Longs) - (__builtin_convertvector(upperFloor, Double4) < upper);
    allUpperBytes |= upperBytes;
    lowers ^= (kMaxByte ^ lowerBytes) << 8 * slots[i];  // Changes the byte of the slot from kMaxByte to lowerBytes.
    uppers |= upperBytes << 8 * slots[i];
  }
  ASDFVK_CHECK_OP(static_cast<uint64_t>(allUpperBytes[0] | allUpperBytes[1] | allUpperBytes[2]), <=, kMaxByte);
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<uint64_t>(lowers[axis]), high = static_cast<uint64_t>(uppers[axis]);
    uvec4& planes = axis == 0 ? node.x : axis == 1 ? node.y : node.z;
    planes = {{static_cast<uint32_t>(low), static_cast<uint32_t>(low >> 32), static_cast<uint32_t>(high),
               static_cast<uint32_t>(high >> 32)}};
  }
  return node;
}

constexpr float kNone = -1e30f;

// Eight numbers in registers. In memory, the load of a vector would wait for the store of a single number.
struct EightNumbers {
  using Ints = IntsOf<Float4>;
  static constexpr Ints kLowIndices = {0, 1, 2, 3}, kHighIndices = {4, 5, 6, 7};

  Float4 low, high;

  // The index replaces the last three bits of each number, for which no precision is required.
  [[nodiscard]] uint32_t indexOfMax() const {
    const auto tagged = [](const Float4& numbers, const Ints& indices) {
      return std::bit_cast<Float4>((std::bit_cast<Ints>(numbers) & ~7) | indices);
    };
    const Float4 greatest = max(tagged(low, kLowIndices), tagged(high, kHighIndices));
    return std::bit_cast<uint32_t>(std::max(std::max(float{greatest[0]}, float{greatest[1]}),
                                            std::max(float{greatest[2]}, float{greatest[3]}))) &
           7;
  }
  void set(uint32_t index, float number) {
    const auto at = broadcast<Ints>(static_cast<int32_t>(index));
    const auto all = broadcast<Float4>(number);
    low = kLowIndices == at ? all : low;
    high = kHighIndices == at ? all : high;
  }
};

constexpr uint32_t kParallelLevelCount = 4;

Box3f boxOf(const BvhNode& node) { return {node.min, node.max}; }

// Writes the wide nodes. A parent determines the indices of its children.
class WideEncoder {
 public:
  WideEncoder(std::span<const BvhNode> nodes, std::span<const uint32_t> primitiveFaces)
      : nodes_(nodes), primitiveFaces_(primitiveFaces), collapse_(nodes) {
    bvh_.nodes.resize(1 + collapse_.nodeCountBelow(0));
    bvh_.primitiveFaces.resize(primitiveFaces.size());
    bvh_.depth = encode(0, 0, 1, 0, 0);
  }
  WideBvh take() { return std::move(bvh_); }

 private:
  // Writes descendants to nodes from `next` on, and triangles from `primitive` on. Returns the levels below the node.
  uint32_t encode(uint32_t binaryNode, uint32_t index, uint32_t next, uint32_t primitive, uint32_t level) {
    const WideChildren children = collapse_.childrenOf(binaryNode);
    std::array<Box3f, kWideChildCount> boxes;
    for (uint32_t i = 0; i < children.count; ++i) boxes[i] = boxOf(nodes_[children.items[i].node]);
    const std::span<const Box3f> used = std::span(boxes).first(children.count);
    const std::array<uint32_t, kWideChildCount> slots = chooseSlots(used);
    DeviceWideNode node = quantizeBoxes(used, slots);
    node.childBase = next;
    node.triangleBase = primitive;

    struct Inner {
      uint32_t binaryNode, index, next, primitive;
    };
    std::array<WideChild, kWideChildCount> inSlot{};
    std::array<bool, kWideChildCount> isUsed{};
    for (uint32_t i = 0; i < children.count; ++i) {
      inSlot[slots[i]] = children.items[i];
      isUsed[slots[i]] = true;
    }
    std::array<Inner, kWideChildCount> inner{};
    uint32_t innerCount = 0;
    for (uint32_t s = 0; s < kWideChildCount; ++s) {
      if (!isUsed[s]) continue;
      const WideCollapse::PrimitiveRange range = collapse_.primitivesOf(inSlot[s].node);
      if (inSlot[s].isLeaf) {
        node.childBits |= ((1u << range.count) - 1) << 4 * s;
        for (uint32_t i = 0; i < kMaxWideLeafTriangleCount; ++i)  // Faster than a call of memmove().
          if (i < range.count) bvh_.primitiveFaces[primitive + i] = primitiveFaces_[range.first + i];
        primitive += range.count;
      } else {
        node.childBits |= kWideInnerBits & 0xfu << 4 * s;
        inner[innerCount] = {inSlot[s].node, next + innerCount, 0, 0};
        ++innerCount;
      }
    }
    bvh_.nodes[index] = node;
    next += innerCount;
    for (Inner& child : std::span(inner).first(innerCount)) {
      child.next = next;
      child.primitive = primitive;
      next += collapse_.nodeCountBelow(child.binaryNode);
      primitive += collapse_.primitivesOf(child.binaryNode).count;
    }
    std::array<uint32_t, kWideChildCount> depths{};
    const auto descend = [&](uint32_t i) {
      depths[i] = 1 + encode(inner[i].binaryNode, inner[i].index, inner[i].next, inner[i].primitive, level + 1);
    };
    if (level < kParallelLevelCount)
      forEachTask(innerCount, [&](size_t i) { descend(static_cast<uint32_t>(i)); });
    else
      for (uint32_t i = 0; i < innerCount; ++i) descend(i);
    return *std::max_element(depths.begin(), depths.end());
  }

  std::span<const BvhNode> nodes_;
  std::span<const uint32_t> primitiveFaces_;
  WideCollapse collapse_;
  WideBvh bvh_;
};

}  // namespace

WideCollapse::WideCollapse(std::span<const BvhNode> nodes, const WideCosts& costs, InstructionSet instructionSet)
    : nodes_(nodes), costs_(costs), instructionSet_(instructionSet), choices_(nodes.size()) {
  ASDFVK_CHECK(!nodes.empty());
  Forests forests;
  chooseFrom(0, 0, forests);
}

void WideCollapse::chooseFrom(uint32_t node, uint32_t level, Forests& forests) {
  if (nodes_[node].isLeaf()) {
    ASDFVK_CHECK_OP(nodes_[node].triangleCount, <=, costs_.maxLeafTriangleCount);
    forests.costs.fill(halfAreaOf(nodes_[node]) * costs_.ofLeaf(nodes_[node].triangleCount));
    forests.nodeCounts.fill(0);
    return;
  }
  const uint32_t child = nodes_[node].first;
  Forests left, right;
  if (level < kParallelSearchLevelCount) {
    callBoth([&] { chooseFrom(child, level + 1, left); }, [&] { chooseFrom(child + 1, level + 1, right); });
  } else {
    chooseFrom(child, level + 1, left);
    chooseFrom(child + 1, level + 1, right);
  }
  choose(node, left, right, forests);
}

void WideCollapse::choose(uint32_t node, const Forests& left, const Forests& right, Forests& forests) {
  Choice& choice = choices_[node];
  const PrimitiveRange leftPrimitives = primitivesOf(nodes_[node].first),
                       rightPrimitives = primitivesOf(nodes_[node].first + 1);
  choice.primitives = {leftPrimitives.first, leftPrimitives.count + rightPrimitives.count};
  const uint32_t maxLeftCount =
      nodes_[nodes_[node].first].isLeaf() ? 1 : std::min(leftPrimitives.count, kWideChildCount - 1);
  const Sharing sharing = dispatch<Float8>(instructionSet_, [&]<typename>() ASDFVK_ALWAYS_INLINE {
    return shareChildren(left.costs, maxLeftCount, right.costs);
  });
  const auto nodeCount = [&](uint32_t childCount) {
    const auto k = static_cast<uint32_t>(sharing.leftCounts[childCount - 1]);
    return left.nodeCounts[k - 1] + right.nodeCounts[childCount - k - 1];
  };
  const float area = halfAreaOf(nodes_[node]), leafCost = area * costs_.ofLeaf(choice.primitives.count);
  choice.nodeCountBelow = nodeCount(kWideChildCount);
  choice.leftCounts = static_cast<uint32_t>(sharing.leftCounts.back()) << 4 * (kWideChildCount - 1);
  forests.costs[0] = sharing.costs.back() + area * costs_.node;
  forests.nodeCounts[0] = 1 + choice.nodeCountBelow;
  if (choice.primitives.count <= costs_.maxLeafTriangleCount && leafCost <= forests.costs[0]) {
    choice.leftCounts |= 1;
    forests.costs[0] = leafCost;
    forests.nodeCounts[0] = 0;
  }
  for (uint32_t i = 2; i < kWideChildCount; ++i) {
    const bool isCheaper = sharing.costs[i - 1] < forests.costs[i - 2];
    forests.costs[i - 1] = isCheaper ? sharing.costs[i - 1] : forests.costs[i - 2];
    forests.nodeCounts[i - 1] = isCheaper ? nodeCount(i) : forests.nodeCounts[i - 2];
    if (isCheaper) choice.leftCounts |= static_cast<uint32_t>(sharing.leftCounts[i - 1]) << 4 * (i - 1);
  }
}

void WideCollapse::addRoots(uint32_t node, uint32_t rootCount, WideChildren& children) const {
  if (nodes_[node].isLeaf()) return children.add({node, true});
  const Choice& choice = choices_[node];
  while (rootCount > 1 && choice.leftCount(rootCount) == 0) --rootCount;
  if (rootCount == 1) return children.add({node, (choice.leftCounts & 1) != 0});
  addRoots(nodes_[node].first, choice.leftCount(rootCount), children);
  addRoots(nodes_[node].first + 1, rootCount - choice.leftCount(rootCount), children);
}

WideChildren WideCollapse::childrenOf(uint32_t node) const {
  WideChildren children;
  if (nodes_[node].isLeaf()) {
    children.add({node, true});
    return children;
  }
  const uint32_t leftCount = choices_[node].leftCount(kWideChildCount);
  addRoots(nodes_[node].first, leftCount, children);
  addRoots(nodes_[node].first + 1, kWideChildCount - leftCount, children);
  return children;
}

std::array<uint32_t, kWideChildCount> chooseSlots(std::span<const Box3f> children) {
  Box3f all;
  for (const Box3f& child : children) all.add(child);
  const Vec3f centre = all.centre();
  std::array<Vec3f, kWideChildCount> offsets;
  std::array<float, kWideChildCount> offsetLengths;
  offsetLengths.fill(kNone);
  for (size_t child = 0; child < children.size(); ++child) {
    const Vec3f& offset = offsets[child] = children[child].centre() - centre;
    offsetLengths[child] = std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z);
  }
  const Float4 xSigns = {-1, 1, -1, 1}, ySigns = {-1, -1, 1, 1};
  std::array<uint32_t, kWideChildCount> slots{};
  EightNumbers distances{load<Float4>(&offsetLengths[0]), load<Float4>(&offsetLengths[4])};
  EightNumbers penalties{};  // kNone for assigned slots.
  for (size_t i = 0; i < children.size(); ++i) {
    const uint32_t child = distances.indexOfMax();
    distances.set(child, kNone);
    const auto [x, y, z] = offsets[child];
    const Float4 along = x * xSigns + y * ySigns;
    slots[child] = EightNumbers{along - z + penalties.low, along + z + penalties.high}.indexOfMax();
    penalties.set(slots[child], kNone);
  }
  return slots;
}

DeviceWideNode quantizeBoxes(std::span<const Box3f> children, const std::array<uint32_t, kWideChildCount>& slots,
                             InstructionSet instructionSet) {
  return dispatch<Float8>(instructionSet,
                          [&]<typename>() ASDFVK_ALWAYS_INLINE { return quantizeInLanes(children, slots); });
}

WideBvh encodeWideBvh(const Bvh& bvh) {
  if (bvh.nodes.empty()) return {};
  WideBvh wide = WideEncoder(bvh.nodes, bvh.primitiveFaces).take();
  ASDFVK_CHECK_OP(wide.depth, <=, kMaxBvhDepth);
  return wide;
}

}  // namespace asdfvk
