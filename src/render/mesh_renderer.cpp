#include "render/mesh_renderer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "core/point2.h"
#include "core/vec3.h"
#include "render/corner_normals.h"
#include "render/light_blocks.h"
#include "render/sample_rows.h"
#include "render/sky_light.h"

namespace asdfvk {
namespace {

constexpr int kSamples = 4;          ///< Samples per side of a pixel.
constexpr int kBandRows = 64;        ///< Rows of samples in a band, so few that they stay in the cache.
constexpr size_t kBandsAtOnce = 16;  ///< Bands between two checkpoints.
/// Share of the alarm colour in the colour of faces that hide alarming triangles.
constexpr double kThroughShare = 0.45;
static_assert(kBandRows % kSamples == 0);

class MeshRenderer {
 public:
  MeshRenderer(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Rgb> faceColours,
               Surface alarming, const RunControl& control)
      : image_(image),
        scene_(scene),
        grid_{camera, kSamples},
        faceColours_(faceColours),
        normals_(cornerNormals(scene.mesh, scene.geometry)),
        light_(scene, camera, std::max(image.width(), image.height()), control),
        faces_(scene, grid_),
        alarming_(projectSurface(scene, grid_, alarming)) {}

  void drawBand(size_t index) const {
    const int top = static_cast<int>(index) * kBandRows, bottom = std::min(rowCount(), top + kBandRows);
    const int width = kSamples * image_.width();
    SampleRows mesh(width, top, bottom, kSamples);
    faces_.drawOn(mesh);
    std::optional<SampleRows> alarming;
    if (!alarming_.empty()) drawSurface(alarming.emplace(width, top, bottom, kSamples), alarming_);
    LightBlocks lights(light_, image_.width(), bottom / kSamples - top / kSamples, grid_.camera.pixelSize);
    for (int y = top / kSamples; y < bottom / kSamples; ++y)
      for (int x = 0; x < image_.width(); ++x) {
        const int column = kSamples * x + kSamples / 2, row = kSamples * y + kSamples / 2;
        if (const uint32_t face = mesh.indexAt(column, row); face != kNoSample)
          lights.set(x, y - top / kSamples, pointAt(face, mesh.placeOf(column, row)));
      }
    lights.fill();
    for (int y = top / kSamples; y < bottom / kSamples; ++y)
      for (int x = 0; x < image_.width(); ++x) drawPixel(x, y, mesh, alarming, lights.at(x, y - top / kSamples));
  }
  [[nodiscard]] int rowCount() const { return kSamples * image_.height(); }

 private:
  /// lit: the point at a sample of the pixel; null if this sample has no face.
  void drawPixel(int x, int y, const SampleRows& mesh, const std::optional<SampleRows>& alarming,
                 const LitPoint* lit) const {
    if (drawWholePixel(x, y, mesh, alarming, lit)) return;
    const Vec3d behind = toLinear(image_.at(x, y)), alarm = toLinear(kAlarm);
    std::array<LitPoint, kSamples * kSamples + 1> points;
    size_t pointCount = 0;
    if (lit != nullptr) points[pointCount++] = *lit;
    bool isEmpty = true;
    Vec3d sum;
    for (int row = kSamples * y; row < kSamples * (y + 1); ++row)
      for (int column = kSamples * x; column < kSamples * (x + 1); ++column) {
        const uint32_t face = mesh.indexAt(column, row);
        if (face == kNoSample) {
          sum += behind;
          continue;
        }
        isEmpty = false;
        const bool isAlarming = alarming && alarming->indexAt(column, row) != kNoSample;
        const bool isVisible = isAlarming && isAtSurface(mesh, *alarming, column, row);
        const Vec3d colour = (isVisible ? alarm : toLinear(faceColours_[face])) *
                             lightOf(pointAt(face, mesh.placeOf(column, row)), points, pointCount);
        sum += isAlarming && !isVisible ? colour * (1 - kThroughShare) + alarm * kThroughShare : colour;
      }
    if (!isEmpty) image_.at(x, y) = toRgb(sum / double{kSamples * kSamples});
  }

  /// Draws a pixel that shows only one face, or none. Returns false for other pixels.
  bool drawWholePixel(int x, int y, const SampleRows& mesh, const std::optional<SampleRows>& alarming,
                      const LitPoint* lit) const {
    const uint32_t face = mesh.indexAt(kSamples * x, kSamples * y);
    for (int row = kSamples * y; row < kSamples * (y + 1); ++row)
      for (int column = kSamples * x; column < kSamples * (x + 1); ++column)
        if (mesh.indexAt(column, row) != face || (alarming && alarming->indexAt(column, row) != kNoSample))
          return false;
    if (face != kNoSample) image_.at(x, y) = toRgb(toLinear(faceColours_[face]) * lit->light);
    return true;
  }

  [[nodiscard]] LitPoint pointAt(uint32_t face, const Point2& place) const {
    const std::array<Projected, 3> corners = faces_.cornersOf(face);
    const std::array<double, 3> shares = cornerShares(corners, place);
    const Vec3d& toViewer = grid_.camera.toViewer;
    const Vec3d& outward = scene_.geometry.normals[face];
    Vec3d normal;
    double depth = 0;
    for (size_t k = 0; k < 3; ++k) {
      normal += normals_[face][k] * shares[k];
      depth += corners[k].depth * shares[k];
    }
    normal = unitVector(normal, outward) * (dot(outward, toViewer) < 0 ? -1.0 : 1.0);
    return {grid_.camera.pointAt(place.x / kSamples, place.y / kSamples) + toViewer * depth, normal};
  }

  /// The light at a sample. Samples that are near each other on a smooth surface share the light of the first of them.
  [[nodiscard]] double lightOf(LitPoint point, std::array<LitPoint, kSamples * kSamples + 1>& points,
                               size_t& pointCount) const {
    constexpr double kMinCosine = 0.995, kMaxDistance = 3;  // In pixels.
    for (size_t i = 0; i < pointCount; ++i)
      if (dot(points[i].normal, point.normal) > kMinCosine &&
          length(points[i].position - point.position) < kMaxDistance * grid_.camera.pixelSize)
        return points[i].light;
    point.light = light_.at(point.position, point.normal);
    points[pointCount++] = point;
    return point.light;
  }

  Image& image_;
  const TraceScene& scene_;
  SampleGrid grid_;
  std::span<const Rgb> faceColours_;
  std::vector<std::array<Vec3d, 3>> normals_;
  SkyLight light_;
  ProjectedFaces faces_;
  ProjectedSurface alarming_;
};

}  // namespace

void renderMesh(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Rgb> faceColours,
                Surface alarming, const RunControl& control) {
  if (!scene.bvh.nodes.empty()) {
    const MeshRenderer renderer(image, scene, camera, faceColours, alarming, control.part(0, 0.5));
    const auto bandCount = static_cast<size_t>((renderer.rowCount() + kBandRows - 1) / kBandRows);
    for (size_t begin = 0; begin < bandCount; begin += kBandsAtOnce) {
      control.checkpoint(0.5 + 0.5 * static_cast<double>(begin) / static_cast<double>(bandCount));
      forEachTask(std::min(kBandsAtOnce, bandCount - begin), [&](size_t i) { renderer.drawBand(begin + i); });
    }
  }
  control.checkpoint(1);
}

}  // namespace asdfvk
