#include "warps/ray_lane.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bvh/device_bvh.h"
#include "core/check.h"
#include "shared/cone_rules.h"

namespace asdfvk::bench {
namespace {

constexpr float kFarAway = 1e30f;

Vec3f vectorOf(const glsl::vec3& v) { return {v.x, v.y, v.z}; }

float inverseOf(float x) {
  constexpr float kTiny = 1e-20f;
  return 1 / (std::abs(x) < kTiny ? std::copysign(kTiny, x) : x);
}

Vec3f octahedralDirection(float u, float v) {
  const float z = 1 - std::abs(u) - std::abs(v), fold = std::max(-z, 0.0f);
  return {u - (u < 0 ? -fold : fold), v - (v < 0 ? -fold : fold), z};
}

uint32_t lowestBit(uint32_t bits) { return bits & (~bits + 1); }

}  // namespace

DeviceScene deviceSceneOf(const TraceScene& scene, const Cone& cone) {
  DeviceScene device{encodeWideBvh(scene.bvh), {}, static_cast<float>(cone.contactDistance)};
  device.triangles.resize(device.bvh.primitiveFaces.size());
  encodeTriangles(scene.bvh, scene.mesh, scene.geometry, device.bvh.primitiveFaces, device.triangles);
  return device;
}

void RayLane::start(const LaneRay& ray) {
  ray_ = ray;
  const Vec3f& d = ray.direction;
  inverse_ = {inverseOf(d.x), inverseOf(d.y), inverseOf(d.z)};
  octant_ = (d.x < 0 ? 1u : 0u) | (d.y < 0 ? 2u : 0u) | (d.z < 0 ? 4u : 0u);
  const float s = d.z < 0 ? -1.0f : 1.0f, a = -1 / (s + d.z), b = d.x * d.y * a;
  u_ = {1 + s * d.x * d.x * a, s * b, -s * d.x};
  w_ = {b, s + d.y * d.y * a, -d.y};
  group_ = {0, 8};
  stackSize_ = 0;
  queue_ = {};
  distance_ = kFarAway;
  primitive_ = kNoPrimitive;
  nodeCount_ = triangleCount_ = greatestStackSize_ = 0;
}

uint32_t RayLane::permute(uint32_t bits) const {
  if (octant_ & 1) bits = (bits & 0x0f0f0f0f) << 4 | (bits >> 4 & 0x0f0f0f0f);
  if (octant_ & 2) bits = (bits & 0x00ff00ff) << 8 | (bits >> 8 & 0x00ff00ff);
  if (octant_ & 4) bits = std::rotl(bits, 16);
  return bits;
}

uint32_t RayLane::takeNearest() {
  const uint32_t nearest = lowestBit((group_.bits & kWideInnerBits) >> 3);
  const uint32_t below = (1u << (static_cast<uint32_t>(std::countr_zero(nearest)) ^ octant_ << 2)) - 1;
  group_.bits ^= nearest << 3;
  return group_.base + static_cast<uint32_t>(std::popcount(group_.bits >> 2 & 0x11111111 & below));
}

uint32_t RayLane::enterChildren(const DeviceWideNode& node) const {
  const std::array<const glsl::uvec4*, 3> planes{&node.x, &node.y, &node.z};
  const Vec3f origin = vectorOf(node.origin);
  uint32_t entered = 0;
  std::array<float, kWideChildCount> enter, leave;
  enter.fill(-kFarAway);
  leave.fill(distance_);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const float step = std::bit_cast<float>((node.exponents >> 8 * axis & 0xff) << 23) * inverse_[axis];
    const float start = (origin[axis] - ray_.origin[axis]) * inverse_[axis];
    const uint32_t near = octant_ >> axis & 1 ? 2 : 0;
    for (uint32_t slot = 0; slot < kWideChildCount; ++slot) {
      const auto distance = [&](uint32_t first) {
        return static_cast<float>(planes[axis]->words[first + slot / 4] >> 8 * (slot % 4) & 0xff) * step + start;
      };
      enter[slot] = std::max(enter[slot], distance(near));
      leave[slot] = std::min(leave[slot], distance(2 - near));
    }
  }
  for (uint32_t slot = 0; slot < kWideChildCount; ++slot)
    if (leave[slot] >= 0 && enter[slot] <= leave[slot]) entered |= 0xfu << 4 * slot;
  return entered & node.childBits;
}

void RayLane::visitNode(const DeviceScene& scene) {
  const DeviceWideNode& node = scene.bvh.nodes[takeNearest()];
  if (group_.bits & kWideInnerBits) {
    stack_[stackSize_++] = group_;
    greatestStackSize_ = std::max(greatestStackSize_, stackSize_);
  }
  const uint32_t children = enterChildren(node);
  const uint32_t rest = permute(children & kWideInnerBits);
  group_ = {node.childBase, rest == 0 ? 0 : rest | (node.childBits & kWideInnerBits) >> 1};
  if (group_.bits == 0 && stackSize_ > 0) group_ = stack_[--stackSize_];
  const Leaves leaves{node.triangleBase, children & ~kWideInnerBits, node.childBits & ~kWideInnerBits};
  if (leaves.bits != 0) *std::ranges::find(queue_, 0u, &Leaves::bits) = leaves;
  ++nodeCount_;
}

void RayLane::testTriangles(const DeviceScene& scene, uint32_t count) {
  for (uint32_t i = 0; i < count && hasTriangles(); ++i) {
    Leaves& first = queue_[0];
    const uint32_t lowest = lowestBit(first.bits);
    const uint32_t primitive = first.base + static_cast<uint32_t>(std::popcount(first.all & (lowest - 1)));
    first.bits ^= lowest;
    if (first.bits == 0) queue_ = {queue_[1], queue_[2], Leaves{}};
    test(scene.triangles[primitive], primitive, scene.contactDistance);
  }
}

void RayLane::test(const DeviceTriangle& triangle, uint32_t primitive, float contactDistance) {
  ++triangleCount_;
  const Vec3f v0 = vectorOf(triangle.v0) - ray_.origin, v1 = vectorOf(triangle.v1) - ray_.origin,
              v2 = vectorOf(triangle.v2) - ray_.origin;
  const auto edge = [&](const Vec3f& a, const Vec3f& b) { return dot(u_, a) * dot(w_, b) - dot(w_, a) * dot(u_, b); };
  const float a = edge(v2, v1), b = edge(v0, v2), c = edge(v1, v0);
  const float det = a + b + c;
  const bool isInside = det > 0 ? std::min({a, b, c}) >= 0 : det < 0 && std::max({a, b, c}) <= 0;
  const Vec3f normal = octahedralDirection(triangle.normalU, triangle.normalV);
  const float slope = dot(normal, ray_.direction), t = dot(normal, v0) / slope;
  if (!isInside || !(t >= contactDistance) || triangle.faceIndex == ray_.excludedFace) return;
  const float distance = t + (slope < 0 ? kOuterSideFactor * contactDistance : 0);
  if (distance >= distance_) return;
  distance_ = distance;
  primitive_ = primitive;
}

}  // namespace asdfvk::bench
