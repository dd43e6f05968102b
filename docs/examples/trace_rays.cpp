// Builds a bounding volume hierarchy over a box of 4 x 3 x 2, traces three rays from a point on the best Vulkan device,
// and reads the hits back. makeCpuTracer(scene, cone) traces the same rays on the CPU. Output:
//   (1, 0, 0): triangle 11, distance 3.00
//   (0, 1, 0): triangle 6, distance 2.00
//   (0, 0, -1): triangle 1, distance 1.00
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <vector>

#include "bvh/bvh.h"
#include "trace/vk/vulkan_tracer.h"
#include "vk/device.h"
#include "vk/instance.h"

using namespace asdfvk;

int main() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 2}, {4, 0, 2}, {4, 3, 2}, {0, 3, 2}};
  mesh.faces = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                {3, 7, 6}, {3, 6, 2}, {0, 4, 7}, {0, 7, 3}, {1, 2, 6}, {1, 6, 5}};
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  std::vector<uint32_t> representatives(mesh.faces.size());  // No triangle is a copy of another one.
  std::iota(representatives.begin(), representatives.end(), 0u);
  const Bvh bvh = buildBvh(mesh, geometry, representatives);
  const TraceScene scene{mesh, geometry, representatives, bvh};

  Cone cone = makeCone({.rayCount = 1});
  cone.directions = {{0, 0, 1}};  // The cone is a ray along the axis of its frame.
  const std::vector<Vec3d> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  std::vector<ConeStart> rays;
  for (const Vec3d& direction : directions)
    rays.push_back({bvh.normalization.toNormalized({1, 1, 1}), -direction, coneFrame(direction)});

  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const VulkanConeKernel kernel(*opened.device, {.rayCount = 1, .writesHits = true});
  std::vector<double> values(rays.size());
  std::vector<ConeHit> hits(rays.size());  // The face of a miss is kNoFace.
  makeVulkanTracer(kernel, scene, cone)->traceAt(rays, {values, hits}, {});
  for (size_t i = 0; i < rays.size(); ++i) {
    const double distance = bvh.normalization.toMeshLength(static_cast<double>(hits[i].distance));
    std::printf("(%g, %g, %g): triangle %u, distance %.2f\n", directions[i].x, directions[i].y, directions[i].z,
                hits[i].face, distance);
  }
}
