#include "describe/fields.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "asdf_vk/session.h"
#include "core/check.h"

namespace asdfvk {
namespace {

bool postprocesses(const Options& options) { return options.postprocesses(); }
bool segments(const Options& options) { return options.segmentation != Segmentation::None; }
bool measuresThickness(const Options& options) { return options.measuresThickness(); }
bool measuresGap(const Options& options) { return options.measuresGap(); }

void requestDiameter(Options& options) { options.measure = united(options.measure, Measure::ShapeDiameter); }

void requestCentres(Options& options) { options.computesCentres = true; }

constexpr std::array kFields{
    FieldRow{.name = "sdf",
             .label = "shape diameter",
             .unit = "length",
             .request = requestDiameter,
             .meaning = "the shape diameter"},
    FieldRow{.name = "seed",
             .label = "seeds",
             .type = FieldType::Flag,
             .request = requestDiameter,
             .meaning = "1 where the face cast rays"},
    FieldRow{.name = "error",
             .label = "expected error",
             .unit = "length",
             .request = requestDiameter,
             .meaning = "expected error; 0 at seeds that keep their value; only with an estimate of the error"},
    FieldRow{.name = "normalized",
             .label = "normalised diameter",
             .needs = "{postprocess=cgal}",
             .isComputed = postprocesses,
             .meaning = "post-processed value, from 0 to 1 ([segmentation.md](segmentation.md))"},
    FieldRow{.name = "segment",
             .label = "parts",
             .type = FieldType::Label,
             .needs = "{segment}",
             .isComputed = segments,
             .meaning = "number of the segment: segments are numbered from 0 by ascending mean value; 4294967295 for a "
                        "face with fewer than three corners"},
    FieldRow{.name = "thickness",
             .label = "wall thickness",
             .unit = "length",
             .needs = "{measure=thickness}",
             .isComputed = measuresThickness,
             .meaning = "wall thickness at the barycentre; for a polygon, the least value of its triangles "
                        "([thickness.md](thickness.md))"},
    FieldRow{.name = "least_thickness",
             .label = "least wall thickness",
             .unit = "length",
             .needs = "{measure=thickness}",
             .isComputed = measuresThickness,
             .meaning = "least wall thickness over all points of the face"},
    FieldRow{.name = "thickness_change",
             .label = "change of the wall thickness",
             .unit = "length",
             .needs = "{compare}",
             .meaning = "wall thickness minus that of the former version at the nearest point of its surface; no value "
                        "if the former version has no wall there ([thickness.md](thickness.md#two-versions))"},
    FieldRow{.name = "gap",
             .label = "gap",
             .unit = "length",
             .needs = "{measure=gap}",
             .isComputed = measuresGap,
             .meaning = "width of the space in front of the face, at the barycentre; no value if no other face is "
                        "opposite; for a polygon, the least value of its triangles ([thickness.md](thickness.md))"},
    FieldRow{.name = "least_gap",
             .label = "least gap",
             .unit = "length",
             .needs = "{measure=gap}",
             .isComputed = measuresGap,
             .meaning = "least width of the space over all points of the face"},
    FieldRow{.name = "centre",
             .label = "skeleton point",
             .unit = "length",
             .componentCount = 3,
             .needs = "{fields=centre}",
             .request = requestCentres,
             .meaning = "skeleton point: the barycentre of the face, moved inwards along its normal by half of the "
                        "shape diameter. For a polygon, barycentre and normal are area-weighted means over its "
                        "triangles. No value if the face has no shape diameter or no normal (zero area)"},
    FieldRow{.name = "component",
             .label = "components",
             .type = FieldType::Label,
             .needs = "{fields=component}",
             .request = requestCentres,
             .meaning = "number of the component (faces connected by edges): components are numbered from 0 by their "
                        "first faces; 4294967295 for a face with fewer than three corners"},
};

}  // namespace

std::span<const FieldRow> fieldRows() { return kFields; }

const FieldRow& fieldRow(std::string_view name) {
  const auto row = std::find_if(kFields.begin(), kFields.end(), [&](const FieldRow& r) { return r.name == name; });
  ASDFVK_CHECK(row != kFields.end());
  return *row;
}

Field makeField(std::string_view name, Field::Values values) {
  const FieldRow& row = fieldRow(name);
  ASDFVK_CHECK_OP(static_cast<size_t>(row.type), ==, values.index());
  return {.name = row.name,
          .label = row.label,
          .unit = row.unit,
          .componentCount = row.componentCount,
          .values = std::move(values)};
}

std::vector<std::string> resultFieldNames() {
  std::vector<std::string> names;
  for (const FieldRow& row : kFields) names.emplace_back(row.name);
  return names;
}

}  // namespace asdfvk
