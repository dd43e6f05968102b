#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/finding.h"
#include "batch/mesh_record.h"
#include "core/json.h"
#include "core/vec3.h"

namespace asdfvk {

/// A finding that was accepted in an earlier run.
struct KnownPlace {
  std::string kind;                            ///< Kind of the finding, such as `thinWall`.
  std::optional<double> value, limit;          ///< Value and limit of the finding.
  std::optional<std::array<double, 3>> place;  ///< Place of the finding.
  std::vector<std::string> bodies;             ///< Names of the bodies at the place.
};

/// The known places of each mesh (--baseline). Paths of meshes are relative to the folder of the file.
struct Baseline {
  std::string folder;
  std::map<std::string, std::vector<KnownPlace>> places;

  /// Turns known failures into notes. A finding is known if a known place has the same kind and the same bodies, if it
  /// is at most the limit away from the finding or from its opposite point, and if the finding is not worse by more
  /// than 5 %.
  void mark(const std::string& mesh, std::vector<Finding>& findings) const;
};

ASDFVK_JSON(KnownPlace, kind, value, limit, place, bodies)
ASDFVK_JSON(Baseline, folder, places)

/// A file of known places.
struct BaselineDocument {
  int formatVersion = kJsonFormatVersion;                ///< Version of the format of JSON documents.
  std::map<std::string, std::vector<KnownPlace>> known;  ///< Known places of each mesh, by its path below the folder.
};
ASDFVK_JSON(BaselineDocument, formatVersion, known)

/// Throws Error{UnreadableInput}.
[[nodiscard]] Baseline readBaseline(const std::string& path);

/// Writes the failures of the records as known places. The places of other meshes stay, and so do those of meshes that
/// were skipped or have no result. Throws Error{OutputNotWritable} and the errors of readBaseline().
void updateBaseline(const std::string& path, std::span<const MeshRecord> records);

/// The path of a mesh relative to a folder; "-" stays.
[[nodiscard]] std::string pathBelow(const std::string& folder, const std::string& mesh);

/// Reads a JSON object. use: for messages, such as "the baseline". Throws Error{UnreadableInput}.
[[nodiscard]] Json readObject(const std::string& path, const std::string& use);

}  // namespace asdfvk
