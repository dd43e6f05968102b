// Writes skeleton points as binary PLY, or as trees in SWC, the text format of neurons (Cannon et al. 1998). The PLY
// has the element `vertex` with double x y z and float radius; with segments, also uint part.
#include "io/points_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "asdf_vk/version.h"
#include "core/atomic_file.h"
#include "core/bucket_sort.h"
#include "core/text.h"
#include "mesh/spanning_tree.h"

namespace asdfvk {
namespace {

struct SkeletonPoint {
  uint32_t face = 0;  ///< Input face.
  Vec3d place;
  float radius = 0;
};

std::vector<SkeletonPoint> skeletonPointsOf(const Field& centre, const Field& sdf) {
  std::vector<SkeletonPoint> points;
  for (uint32_t face = 0; face < sdf.size(); ++face) {
    const size_t first = 3 * size_t{face};
    const Vec3d place{centre.at(first), centre.at(first + 1), centre.at(first + 2)};
    if (std::isfinite(sdf.at(face)) && isFinite(place))
      points.push_back({face, place, static_cast<float>(sdf.at(face) / 2)});
  }
  return points;
}

void writePly(AtomicFile& file, std::span<const SkeletonPoint> points, const Field* segment) {
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment asdf-vk: skeleton points, radius is half of the shape diameter\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\nproperty float radius\n"
      "{}end_header\n",
      points.size(), segment != nullptr ? "property uint part\n" : ""));
  for (const SkeletonPoint& point : points) {
    file.put(point.place);
    file.put(point.radius);
    if (segment != nullptr) file.put(static_cast<uint32_t>(segment->at(point.face)));
  }
}

/// Each tree has one root: the point with the greatest radius, where a neuron has its body.
class SwcWriter {
 public:
  SwcWriter(AtomicFile& file, const RunControl& stopOnly) : file_(file), stopOnly_(stopOnly) {
    file_.write(
        fmt::format("# asdf-vk {}: skeleton points, joined by their minimum spanning trees, one per component\n"
                    "# radius: half of the shape diameter; unit: that of the mesh\n"
                    "# id type x y z radius parent\n",
                    ASDFVK_VERSION));
  }

  void write(std::span<const SkeletonPoint> points) {
    std::vector<Vec3d> places;
    for (const SkeletonPoint& point : points) places.push_back(point.place);
    const std::vector<std::array<uint32_t, 2>> edges = minimumSpanningTree(places, stopOnly_);
    const auto neighbours = sortIntoBuckets<uint32_t>(points.size(), edges.size(), [&](uint32_t edge, auto put) {
      put(edges[edge][0], edges[edge][1]);
      put(edges[edge][1], edges[edge][0]);
    });
    const auto root = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
      return a.radius != b.radius ? a.radius < b.radius : a.face > b.face;
    });
    struct Step {
      uint32_t point, from;
      int64_t parent;
    };
    std::vector<Step> stack{{static_cast<uint32_t>(root - points.begin()), kNoPoint, -1}};
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      writeLine(points[step.point], step.parent);
      for (const uint32_t next : neighbours[step.point])
        if (next != step.from) stack.push_back({next, step.point, id_});
    }
  }

 private:
  static constexpr uint32_t kNoPoint = 0xffffffff;
  static constexpr int64_t kLinesPerCheckpoint = 4096;

  void writeLine(const SkeletonPoint& point, int64_t parent) {
    if (id_ % kLinesPerCheckpoint == 0) stopOnly_.checkpoint(0);
    file_.putNumber(++id_);
    const auto append = [&](auto number) {
      file_.put(' ');
      file_.putNumber(number);
    };
    append(0);  // Type 0: undefined.
    append(point.place.x);
    append(point.place.y);
    append(point.place.z);
    append(point.radius);
    append(parent);
    file_.put('\n');
  }

  AtomicFile& file_;
  const RunControl& stopOnly_;
  int64_t id_ = 0;
};

/// A tree per component, in the order of the first points of the components. Omits points of radius 0, which occur
/// where walls touch.
void writeSwc(AtomicFile& file, std::vector<SkeletonPoint> points, const Field* component, const RunControl& stopOnly) {
  std::erase_if(points, [](const SkeletonPoint& point) { return !(point.radius > 0); });
  const auto componentOf = [&](const SkeletonPoint& point) {
    return component != nullptr ? static_cast<uint32_t>(component->at(point.face)) : 0;
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const auto& a, const auto& b) { return componentOf(a) < componentOf(b); });
  SwcWriter writer(file, stopOnly);
  for (auto begin = points.begin(); begin != points.end();) {
    const auto end = std::find_if(begin, points.end(), [&, first = componentOf(*begin)](const SkeletonPoint& point) {
      return componentOf(point) != first;
    });
    writer.write({begin, end});
    begin = end;
  }
}

}  // namespace

void writePoints(const std::filesystem::path& path, std::span<const Field> fields, const RunControl& control) {
  AtomicFiles files;
  writePoints(files, path, fields, control);
  files.commit();
}

void writePoints(AtomicFiles& files, const std::filesystem::path& path, std::span<const Field> fields,
                 const RunControl& control) {
  const Field &centre = requireField(fields, "centre"), &sdf = requireField(fields, "sdf");
  const auto optional = [&](const char* name) { return findField(fields, name, FieldLocation::PerFace); };
  const Field *const segment = optional("segment"), *const component = optional("component");
  const auto fits = [&](const Field* field, uint32_t componentCount = 1) {
    return field == nullptr ||
           (field->componentCount == componentCount && field->size() == sdf.size() * componentCount);
  };
  if (!fits(&sdf) || !fits(&centre, 3) || !fits(segment) || !fits(component))
    throw Error(ErrorCode::OptionConflict,
                "the sizes of the fields centre, sdf, segment and component do not fit each other");
  if (component != nullptr && component->reals() != nullptr)
    throw Error(ErrorCode::OptionConflict, "the field component has real numbers; give integers");
  if (sdf.reals() != nullptr) requireSingles(*sdf.reals(), "'sdf'");
  const std::vector<SkeletonPoint> points = skeletonPointsOf(centre, sdf);
  files.write(path, [&](AtomicFile& file) {
    if (lowerCase(path.extension().string()) == ".swc") {
      writeSwc(file, points, component, control.withoutProgress());
    } else {
      writePly(file, points, segment);
    }
  });
}

}  // namespace asdfvk
