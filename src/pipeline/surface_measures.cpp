#include "pipeline/surface_measures.h"

#include <string>
#include <utility>
#include <vector>

#include "describe/comparison_text.h"
#include "describe/fields.h"
#include "describe/thickness_text.h"
#include "pipeline/body_names.h"
#include "pipeline/comparison.h"
#include "pipeline/comparison_report.h"
#include "pipeline/thickness_report.h"

namespace asdfvk {
namespace {

// Progress after the thickness of the mesh and of the former version.
constexpr double kMeasured = 0.4, kFormerMeasured = 0.7;

/// The computation on the faces of a surface.
class SurfaceComputation {
 public:
  SurfaceComputation(const Computation& ofMesh, const JudgedSurface& surface, const InputFaceSet& region)
      : scene_(surface.scene().view()),
        domain_(wholeMesh(surface.scene().prepared)),
        computation_{ofMesh.options, surface.scene().prepared, domain_,      region,         scene_,
                     ofMesh.cone,    ofMesh.backend,           ofMesh.clock, ofMesh.warnings} {}
  SurfaceComputation(const SurfaceComputation&) = delete;
  SurfaceComputation& operator=(const SurfaceComputation&) = delete;

  [[nodiscard]] const Computation& get() const { return computation_; }

 private:
  TraceScene scene_;
  FaceDomain domain_;
  Computation computation_;
};

/// Adds the fields "thickness" and "least_thickness", or "gap" and "least_gap", and the report.
void addMeasured(Result& result, const Computation& computation, const JudgedSurface& surface, const BodyNames& names,
                 const FaceThickness& thickness) {
  const TriangleMesh& mesh = computation.prepared.mesh;
  const std::string name = surface.isSpace() ? "gap" : "thickness";
  result.fields.push_back(makeField(name, thicknessOfInputFaces(mesh, thickness.atBarycentre)));
  result.fields.push_back(makeField("least_" + name, thicknessOfInputFaces(mesh, thickness.least)));
  Report& report = result.report;
  const auto firstRegion = static_cast<uint32_t>(report.thickness ? report.thickness->regions.size() : 0);
  std::optional<ThicknessReport>& described = surface.isSpace() ? report.gap : report.thickness;
  described = describeThickness(computation, surface, thickness, names, firstRegion, result.thinSurface);
  described->sentence = verdictSentence(*described);
  if (described->thick) described->thick->sentence = thickSentence(*described);
}

void measureSurface(Result& result, const Computation& ofMesh, const JudgedSurface& surface, const BodyNames& names,
                    const RunControl& control) {
  const SurfaceComputation computation(ofMesh, surface, ofMesh.region);
  addMeasured(result, computation.get(), surface, names, measureThickness(computation.get(), surface, control));
}

/// Measures the surface of the material and a former version of it, and compares them.
void compareSurfaces(Result& result, const Computation& ofMesh, const JudgedSurface& surface, const BodyNames& names,
                     const JudgedSurface& former, const RunControl& control) {
  const SurfaceComputation computation(ofMesh, surface, ofMesh.region);
  FaceThickness thickness = measureThickness(computation.get(), surface, control.part(0, kMeasured));
  const InputFaceSet wholeFormer;
  const SurfaceComputation formerComputation(ofMesh, former, wholeFormer);
  FaceThickness formerThickness;
  if (surface.limitIn(ofMesh.options.thickness))
    formerThickness = findThinPlaces(formerComputation.get(), former, control.part(kMeasured, kFormerMeasured));
  const MeasuredVersion now{computation.get(), surface, thickness};
  const MeasuredVersion before{formerComputation.get(), former, formerThickness};
  const std::vector<double> values = compareVersions(now, before, control.part(kFormerMeasured, 1));
  addMeasured(result, computation.get(), surface, names, thickness);
  std::vector<double> change = thicknessChange(now, values);
  ThinSurface unused;
  ThicknessReport ofFormer;
  if (!formerThickness.isJudged.empty())
    ofFormer = describeThickness(formerComputation.get(), former, formerThickness, BodyNames(former), 0, unused);
  ComparisonReport& comparison = result.report.comparison.emplace();
  comparison = describeComparison(now, values, change, *result.report.thickness, before, ofFormer);
  comparison.sentence = comparisonSentence(result.report);
  result.fields.push_back(makeField("thickness_change", std::move(change)));
}

/// Voids and contacts of which the region has a face.
void describeSpace(Report& report, const InputFaceSet& region, const JudgedSurface& space, const BodyNames& names) {
  const PreparedMesh& prepared = space.scene().prepared;
  std::vector<Box3d> boxes(space.solids().isClosed.size());
  std::vector<uint32_t> firstFaces(boxes.size(), kNoFace);  // In the region.
  for (uint32_t face = 0; face < prepared.mesh.faceCount(); ++face) {
    const uint32_t part = space.solids().solidOf[face];
    for (const uint32_t vertex : prepared.mesh.faces[face]) boxes[part].add(prepared.mesh.vertices[vertex]);
    if (firstFaces[part] == kNoFace && region.contains(prepared.mesh.inputFaceOf(face))) firstFaces[part] = face;
  }
  std::vector<uint32_t> voidOf(boxes.size(), kNoFace), groupOf;
  for (uint32_t i = 0; i < space.voids().size(); ++i)
    for (const uint32_t part : space.voids()[i].looseParts) voidOf[part] = i;
  for (const uint32_t part : space.solids().solidOf) groupOf.push_back(voidOf[part]);
  std::vector<std::vector<std::string>> looseBodies = names.ofGroups(space, groupOf, space.voids().size());
  for (size_t i = 0; i < space.voids().size(); ++i) {
    const EnclosedSpace& each = space.voids()[i];
    uint32_t face = firstFaces[each.part];
    for (const uint32_t part : each.looseParts)
      if (face == kNoFace) face = firstFaces[part];
    if (face == kNoFace) continue;
    report.voids.push_back({.volume = each.volume,
                            .face = prepared.mesh.inputFaceOf(face),
                            .place = prepared.geometry.barycentres[face],
                            .size = boxes[each.part].size(),
                            .looseBodies = std::move(looseBodies[i]),
                            .isCertain = each.isCertain});
  }
  report.contacts = names.contacts(region);
}

}  // namespace

void measureSurfaces(Result& result, const Computation& computation, const PreparedScene& scene,
                     const JudgedSurface* former, const RunControl& control) {
  const auto scope = computation.clock.time(Stage::Thickness);
  const Options& options = computation.options;
  const JudgedSurface material(scene, options.orientation == Orientation::Flip, control.withoutProgress());
  const BodyNames names(material);
  const double gapsBegin = !options.measuresThickness() ? 0 : options.measuresGap() ? 0.5 : 1;
  const RunControl first = control.part(0, gapsBegin);
  if (options.measuresThickness() && former != nullptr)
    compareSurfaces(result, computation, material, names, *former, first);
  else if (options.measuresThickness())
    measureSurface(result, computation, material, names, first);
  if (!options.measuresGap()) return;
  const JudgedSurface space(material, JudgedSurface::Space{});
  measureSurface(result, computation, space, names, control.part(gapsBegin, 1));
  describeSpace(result.report, computation.region, space, names);
}

}  // namespace asdfvk
