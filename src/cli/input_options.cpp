#include "cli/input_options.h"

#include "cli/program_values.h"

namespace asdfvk {
namespace {

constexpr const char* kInputGroup = "Input";
constexpr double kMaxFaceCount = 4294967295;

}  // namespace

OptionRows readingRows(ReadOptions& reading) {
  return withGroups({
      OptionRow{.name = "max-faces",
                .group = kInputGroup,
                .member = &reading.maxFaces,
                .range = fromTo(0, kMaxFaceCount),
                .text = "Refuse a file with more faces. A small file can describe many faces by instances",
                .placeholder = "N",
                .defaultText = "100 per byte of the file, and at least 100,000"},
      OptionRow{.name = "chord-error",
                .member = memberAs<ChordErrorCodec>(&reading),
                .range = above(0),
                .text =
                    "STEP: greatest distance between the triangles and the curved surfaces of the file, in the unit "
                    "of the file or with a unit, such as 0.02mm",
                .more = "The report states the value ([formats.md](formats.md#step)).",
                .placeholder = "LENGTH",
                .defaultText = "1/50 of the limit of {thinner-than}, or 1/1000 of the diagonal of the bounding box"},
  });
}

OptionRows otherMeshRows(OtherMeshes& others) {
  return withGroups({
      OptionRow{.name = "with",
                .group = kInputGroup,
                .member = memberAs<MeshNamesCodec>(&others.with),
                .text =
                    "Add the faces of another mesh to the scene as further bodies, for example the other parts of an "
                    "assembly, or an inner surface with {orient=auto}. Repeatable; for one mesh only",
                .more = "Values, thin places and gaps are those of the first mesh "
                        "([thickness.md](thickness.md#two-meshes)).",
                .placeholder = "FILE",
                .isRepeatable = true},
      OptionRow{.name = "compare",
                .member = memberAs<MeshNameCodec>(&others.former),
                .text =
                    "Compare the wall thickness with a former version of the mesh: FILE is the former version. With "
                    "{fail-if-thinner} only walls that are new or became thinner fail; implies {measure=thickness}; "
                    "for one mesh only",
                .more = "The result has the field `thickness_change` ([thickness.md](thickness.md#two-versions)).",
                .placeholder = "FILE"},
  });
}

}  // namespace asdfvk
