// The options of the meshes that are read.
#include <array>

#include "asdf_vk/error.h"
#include "cli/options.h"
#include "describe/option_values.h"

namespace asdfvk {
namespace {

constexpr const char* kInputGroup = "Input";
constexpr double kMaxFaceCount = 4294967295;

bool readChordError(void* target, const OptionValue& value) {
  auto& reading = *static_cast<ReadOptions*>(target);
  std::optional<LengthLimit> length;
  if (!readLength(value, length)) return false;
  reading.chordError = length->value;
  reading.chordErrorUnit = length->unit;
  return true;
}

OptionValue chordErrorValue(const void* target) {
  const auto& reading = *static_cast<const ReadOptions*>(target);
  if (!(reading.chordError > 0)) return {};
  return lengthValue(LengthLimit(reading.chordError, reading.chordErrorUnit));
}

/// Whether the value is a name of a file other than standard input.
bool isFileName(const OptionValue& value) {
  const std::string& name = std::get<std::string>(value);
  return !name.empty() && name != "-";
}

bool readWith(void* target, const OptionValue& value) {
  if (!isFileName(value)) return false;
  static_cast<OtherMeshes*>(target)->with.push_back(std::get<std::string>(value));
  return true;
}

bool readFormer(void* target, const OptionValue& value) {
  if (!isFileName(value)) return false;
  static_cast<OtherMeshes*>(target)->former = std::get<std::string>(value);
  return true;
}

const std::array kReadingRows{
    OptionRow{.name = "max-faces",
              .group = kInputGroup,
              .access = ASDFVK_MEMBER(ReadOptions, maxFaces),
              .range = fromTo(0, kMaxFaceCount),
              .text = "Refuse a file with more faces. A small file can describe many faces by instances",
              .placeholder = "N",
              .defaultText = "100 per byte of the file, and at least 100,000"},
    OptionRow{.name = "chord-error",
              .group = kInputGroup,
              .range = above(0),
              .text = "STEP: greatest distance between the triangles and the curved surfaces of the file, in the unit "
                      "of the file or with a unit, such as 0.02mm",
              .more = "The report states the value ([formats.md](formats.md#step)).",
              .placeholder = "LENGTH",
              .defaultText = "1/50 of the limit of --thinner-than, or 1/1000 of the diagonal of the bounding box",
              .wanted = kLengthWanted,
              .read = readChordError,
              .write = chordErrorValue},
};

const std::array kOtherMeshRows{
    OptionRow{.name = "with",
              .group = kInputGroup,
              .text = "Add the faces of another mesh to the scene as further bodies, for example the other parts of an "
                      "assembly, or an inner surface with --orient auto. Repeatable; for one mesh only",
              .more = "Values, thin places and gaps are those of the first mesh "
                      "([thickness.md](thickness.md#two-meshes)).",
              .placeholder = "FILE",
              .wanted = "the name of a file",
              .isRepeatable = true,
              .read = readWith,
              .write = noValue},
    OptionRow{.name = "compare",
              .group = kInputGroup,
              .text = "Compare the wall thickness with a former version of the mesh: FILE is the former version. With "
                      "--fail-if-thinner only walls that are new or became thinner fail; implies --measure thickness; "
                      "for one mesh only",
              .more = "The result has the field `thickness_change` ([thickness.md](thickness.md#two-versions)).",
              .placeholder = "FILE",
              .wanted = "the name of a file",
              .read = readFormer,
              .write = noValue},
};

}  // namespace

OptionRows readingRows() { return kReadingRows; }
OptionRows otherMeshRows() { return kOtherMeshRows; }

}  // namespace asdfvk
