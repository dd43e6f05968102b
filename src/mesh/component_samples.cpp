#include "mesh/component_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

using Triangle = std::array<Vec3d, 3>;

/// Distance of a sample from its face, in units of kContactDistance. Each point has one sample on each side of the
/// face. If the face touches another component, one of the two samples is outside of that component.
constexpr double kSampleDepth = 2;
/// Number of points of a component that are spread by area; further points are at its ends along the axes. The number
/// is kMaxPointCount. It is lower, but at least kMinPointCount, if all components together would have more than
/// kMaxTotalPointCount points.
constexpr size_t kMinPointCount = 4, kMaxPointCount = 64, kMaxTotalPointCount = size_t{1} << 18;
/// Position of a point at an end: this share of the way from the corner, which may be sharp, to the barycentre.
constexpr double kEndShare = 0.25;

/// Adds a sample on each side of a face at p.
void addSamples(const Triangle& triangle, const Vec3d& p, uint32_t component, std::vector<Sample>& samples) {
  const Vec3d normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double norm = length(normal);
  if (!(norm > double{std::numeric_limits<float>::min()})) return samples.push_back({component, p});
  const Vec3d step = kSampleDepth * kContactDistance / norm * normal;
  samples.push_back({component, p - step});
  samples.push_back({component, p + step});
}

/// Makes the samples of the components with isWanted[component] != 0.
class Sampler {
 public:
  Sampler(const ClosedComponents& closed, std::span<const uint8_t> isWanted)
      : closed_(closed), isWanted_(isWanted), states_(isWanted.size()) {
    const auto wantedCount = static_cast<size_t>(isWanted.size() - std::count(isWanted.begin(), isWanted.end(), 0));
    pointCount_ = std::clamp(kMaxTotalPointCount / std::max(wantedCount, size_t{1}), kMinPointCount, kMaxPointCount);
  }

  /// The samples, grouped by component, ascending.
  [[nodiscard]] std::vector<Sample> samples() {
    std::vector<Sample> samples;
    forEachFace([&](uint32_t face, State& state) { survey(face, state); });
    for (uint32_t component = 0; component < states_.size(); ++component)
      if (isWanted_[component] != 0) addEnds(component, samples);
    forEachFace([&](uint32_t face, State& state) { addByArea(face, state, samples); });
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.component < b.component; });
    return samples;
  }

 private:
  struct State {
    double area = 0, areaBefore = 0;
    size_t pointCount = 0;
    std::array<size_t, 6> ends{};  // The corners lowest and highest along x, y and z.
  };

  template <typename Visit>
  void forEachFace(const Visit& visit) {
    for (uint32_t face = 0; face < closed_.mesh.faceCount(); ++face) {
      const uint32_t component = closed_.components.componentOf[face];
      if (isWanted_[component] != 0) visit(face, states_[component]);
    }
  }

  [[nodiscard]] const Vec3d& cornerAt(size_t corner) const {
    return closed_.mesh.vertices[closed_.mesh.faces[corner / 3][corner % 3]];
  }

  void survey(uint32_t face, State& state) {
    if (closed_.components.components[closed_.components.componentOf[face]].firstFace == face)
      state.ends.fill(size_t{3} * face);
    state.area += triangleArea(closed_.triangle(face));
    for (size_t corner = size_t{3} * face; corner < size_t{3} * face + 3; ++corner) {
      for (size_t axis = 0; axis < 3; ++axis) {
        if (cornerAt(corner)[axis] < cornerAt(state.ends[2 * axis])[axis]) state.ends[2 * axis] = corner;
        if (cornerAt(corner)[axis] > cornerAt(state.ends[2 * axis + 1])[axis]) state.ends[2 * axis + 1] = corner;
      }
    }
  }

  void addEnds(uint32_t component, std::vector<Sample>& samples) {
    std::array<size_t, 6>& ends = states_[component].ends;
    std::sort(ends.begin(), ends.end());
    const auto last = std::unique(ends.begin(), ends.end());
    for (auto corner = ends.begin(); corner != last; ++corner) {
      const Triangle t = closed_.triangle(static_cast<uint32_t>(*corner / 3));
      const Vec3d& p = t[*corner % 3];
      addSamples(t, p + kEndShare * ((t[0] + t[1] + t[2]) / 3.0 - p), component, samples);
    }
  }

  void addByArea(uint32_t face, State& state, std::vector<Sample>& samples) {
    const Triangle t = closed_.triangle(face);
    state.areaBefore += triangleArea(t);
    const auto shareOf = [&](size_t i) { return (static_cast<double>(i) + 0.5) / static_cast<double>(pointCount_); };
    while (state.pointCount < pointCount_ && shareOf(state.pointCount) * state.area < state.areaBefore) {
      // M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018: points spread evenly over a square,
      // here folded onto the triangle.
      const double i = static_cast<double>(++state.pointCount);
      double u = std::fmod(0.5 + i * 0.7548776662466927, 1), v = std::fmod(0.5 + i * 0.5698402909980532, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      addSamples(t, t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]), closed_.components.componentOf[face], samples);
    }
  }

  const ClosedComponents& closed_;
  std::span<const uint8_t> isWanted_;
  std::vector<State> states_;
  size_t pointCount_ = 0;
};

}  // namespace

ClosedComponents::ClosedComponents(const TriangleMesh& mesh_, const Components& components_)
    : mesh(mesh_),
      components(components_),
      normalization(normalizationOf(boundsOfFiniteVertices(mesh_))),
      boxes(components_.components.size()) {
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t component = components.componentOf[face];
    if (!components.components[component].isClosed) continue;
    for (const Vec3d& p : triangle(face)) boxes[component].add(p);
  }
}

std::vector<Sample> samplesOf(const ClosedComponents& closed, std::span<const uint8_t> isWanted) {
  return Sampler(closed, isWanted).samples();
}

}  // namespace asdfvk
