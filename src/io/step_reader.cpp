// STEP (ISO 10303-21): solids, and shells and faces without a solid, which a module triangulates (io/step_module.h).
// Each placed body is a part with the name of the body or else of its product. Coordinates are in the unit of the file.
// Colours, layers and dimensions are ignored.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "asdf_vk/error.h"
#include "core/length_unit.h"
#include "core/text.h"
#include "io/assembled_mesh.h"
#include "io/corner_welder.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/object_names.h"
#include "io/step_library.h"

namespace asdfvk {
namespace {

constexpr std::string_view kStepStart = "ISO-10303-21;", kStepEnd = "END-ISO-10303-21";
constexpr double kMicrometresOfModule = 1000;         // The module has millimetres.
constexpr double kMaxAngleRadians = 0.349;            // 20 degrees
constexpr double kDefaultChordError = 1e-3;           // Share of the diagonal of the bounding box.
constexpr double kResolution = 0x1p-21;               // Share of its longest side (docs/thickness.md).
constexpr uint64_t kMaxPlacedBodyCount = 10'000'000;  // The nesting of assemblies multiplies bodies.

/// Returns the millimetre for unknown names, because the module converts all units.
const LengthUnitRow& stepUnitOf(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kNames{{{"micrometre", "um"},
                                                                                  {"micron", "um"},
                                                                                  {"millimetre", "mm"},
                                                                                  {"centimetre", "cm"},
                                                                                  {"metre", "m"},
                                                                                  {"inch", "in"},
                                                                                  {"inches", "in"},
                                                                                  {"in", "in"},
                                                                                  {"foot", "ft"},
                                                                                  {"feet", "ft"},
                                                                                  {"ft", "ft"},
                                                                                  {"mm", "mm"}}};
  const std::string lower = lowerCase(name);
  for (const auto& row : kNames)
    if (row.first == lower) return *findLengthUnit(row.second);
  return *findLengthUnit(LengthUnit::Millimetre);
}

struct PlacedBody {
  uint64_t body;
  Placement placement;
};

class StepReader {
 public:
  explicit StepReader(const MeshSource& source) : source_(source) {}

  Mesh read();

 private:
  void setChordError(std::string_view unit, const Vec3d& size, double& chordError);
  void expectTriangles(double count);
  void addBody(const char* name, const double* points, uint64_t pointCount, const uint32_t* corners,
               uint64_t triangleCount);
  void placeBody(uint64_t body, const double columns[12]);
  [[nodiscard]] std::vector<std::string> skippedOf(const StepModuleCall& call) const;

  /// Runs a step of a callback. An exception must not pass through the module: it is kept, and the module stops.
  template <typename Step>
  static bool guarded(void* context, const Step& step) {
    auto& reader = *static_cast<StepReader*>(context);
    try {
      step(reader);
      return true;
    } catch (...) {
      reader.failure_ = std::current_exception();
      return false;
    }
  }

  const MeshSource& source_;
  const LengthUnitRow* unit_ = nullptr;
  double chordError_ = 0;  ///< In the unit of the file.
  std::vector<PartMesh> bodies_;
  std::vector<std::string> names_;  ///< Names of the bodies.
  uint64_t triangleCount_ = 0;      ///< Number of triangles of the bodies.
  std::vector<PlacedBody> placed_;
  uint64_t vertexCount_ = 0, faceCount_ = 0;  ///< Numbers of all placed bodies.
  std::exception_ptr failure_;
};

void StepReader::setChordError(std::string_view unit, const Vec3d& size, double& chordError) {
  unit_ = &stepUnitOf(unit);
  const LengthUnitRow* const given = findLengthUnit(source_.options.chordErrorUnit);
  const double scale = (given == nullptr ? unit_ : given)->micrometres / kMicrometresOfModule;
  const double wanted =
      source_.options.chordError > 0 ? source_.options.chordError * scale : kDefaultChordError * length(size);
  chordError = std::max({wanted, kResolution * std::max({size.x, size.y, size.z}), 1e-9});
  chordError_ = chordError * kMicrometresOfModule / unit_->micrometres;
}

void StepReader::expectTriangles(double count) {
  constexpr double kMostFaces = 1e15;
  requireFaceCount(triangleCount_ + static_cast<uint64_t>(std::min(count, kMostFaces)), source_);
}

void StepReader::addBody(const char* name, const double* points, uint64_t pointCount, const uint32_t* corners,
                         uint64_t triangleCount) {
  triangleCount_ += triangleCount;
  requireFaceCount(triangleCount_, source_);
  CornerWelder welder(pointCount);
  std::vector<uint32_t> vertexOf(pointCount);
  const double perUnit = unit_->micrometres / kMicrometresOfModule;
  for (uint64_t i = 0; i < pointCount; ++i)
    vertexOf[i] = welder.indexOf(Vec3d{points[3 * i], points[3 * i + 1], points[3 * i + 2]} / perUnit);
  PartMesh body;
  body.faces.reserve(triangleCount);
  for (uint64_t i = 0; i < triangleCount; ++i) {
    const Face face{vertexOf[corners[3 * i]], vertexOf[corners[3 * i + 1]], vertexOf[corners[3 * i + 2]]};
    // At the pole of a sphere, an edge of the domain of its parameters is one point.
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) body.faces.push_back(face);
  }
  body.vertices = std::move(welder.points());
  bodies_.push_back(std::move(body));
  names_.push_back(objectName(name));
}

void StepReader::placeBody(uint64_t body, const double columns[12]) {
  Placement placement;
  const auto columnAt = [&](int i) { return Vec3d{columns[3 * i], columns[3 * i + 1], columns[3 * i + 2]}; };
  for (int i = 0; i < 3; ++i) placement.columns[i] = columnAt(i);
  placement.translation = columnAt(3) * (kMicrometresOfModule / unit_->micrometres);
  vertexCount_ += bodies_.at(body).vertices.size();
  faceCount_ += bodies_.at(body).faces.size();
  requireFaceCount(faceCount_, source_);
  if (placed_.size() == kMaxPlacedBodyCount)
    failInput(fmt::format("places more than {} bodies", groupDigits(kMaxPlacedBodyCount)));
  placed_.push_back({body, placement});
}

std::vector<std::string> StepReader::skippedOf(const StepModuleCall& call) const {
  std::vector<std::string> skipped;
  const auto add = [&](uint64_t count, const char* name, const char* what) {
    if (count > 0) skipped.push_back(counted(count, name) + what);
  };
  add(call.curveCount, "curve", "");
  add(call.pointCount, "point", "");
  add(call.failedFaceCount, "face", " that Open CASCADE cannot convert");
  add(call.tessellatedCount, "face", " of triangles, which this version of Open CASCADE does not read");
  return skipped;
}

Mesh StepReader::read() {
  const std::string_view text(source_.bytes.data(), source_.bytes.size());
  if (text.find(kStepEnd) == text.npos)
    failInput(fmt::format("has no {}; the file is truncated; copy or export it again", kStepEnd));
  const StepModuleFunction readStep = stepModule();
  StepModuleCall call{.version = kStepModuleVersion,
                      .bytes = source_.bytes.data(),
                      .size = source_.bytes.size(),
                      .maxAngleRadians = kMaxAngleRadians,
                      .context = this};
  call.setChordError = [](void* context, const char* unit, const double min[3], const double max[3],
                          double* chordError) {
    return guarded(context, [&](StepReader& reader) {
      reader.setChordError(unit, {max[0] - min[0], max[1] - min[1], max[2] - min[2]}, *chordError);
    });
  };
  call.expectTriangles = [](void* context, double count) {
    return guarded(context, [&](StepReader& reader) { reader.expectTriangles(count); });
  };
  call.addBody = [](void* context, const char* name, const double* points, uint64_t pointCount, const uint32_t* corners,
                    uint64_t triangleCount) {
    return guarded(context,
                   [&](StepReader& reader) { reader.addBody(name, points, pointCount, corners, triangleCount); });
  };
  call.placeBody = [](void* context, uint64_t body, const double columns[12]) {
    return guarded(context, [&](StepReader& reader) { reader.placeBody(body, columns); });
  };
  switch (readStep(&call)) {
    case StepModuleStatus::Done:
      break;
    case StepModuleStatus::Stopped:
      std::rethrow_exception(failure_);
    case StepModuleStatus::Failed:
      failInput(fmt::format("cannot be read as STEP: {}", printable(call.error)));
    case StepModuleStatus::OutOfMemory:
      throw std::bad_alloc();
    case StepModuleStatus::OtherVersion:
      failInput("is STEP, and the installed module that reads STEP is of another version of asdf-vk; update both");
  }
  std::vector<std::string> skipped = skippedOf(call);
  if (faceCount_ == 0)
    failInput(skipped.empty() ? "has no body" : fmt::format("has no body, only {}", joined(skipped, " and ")));
  AssembledMesh assembled(vertexCount_, faceCount_, source_);
  for (const PlacedBody& placed : placed_) assembled.add(bodies_[placed.body], placed.placement, names_[placed.body]);
  Mesh mesh = assembled.finish();
  mesh.unit = unit_->name;
  mesh.chordError = std::max(chordError_, call.foundChordError * kMicrometresOfModule / unit_->micrometres);
  mesh.skipped = std::move(skipped);
  return mesh;
}

Match detectStep(std::span<const char> bytes) {
  return std::string_view(bytes.data(), bytes.size()).starts_with(kStepStart) ? Match::Certain : Match::None;
}

Mesh parseStep(const MeshSource& source) { return StepReader(source).read(); }

}  // namespace

extern const FileFormat kStepFormat{
    .name = "step", .extensions = {"step", "stp", "p21"}, .detect = detectStep, .parseMesh = parseStep};

}  // namespace asdfvk
