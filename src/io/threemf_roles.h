#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/assembled_mesh.h"
#include "io/xml_reader.h"

/// Parts of a 3MF file that are not material: the types of the core specification, and the types that slicers write
/// beside the model. Slicers also write the names of parts there.
namespace asdfvk {

enum class PartRole : uint8_t {
  Material,
  Support,
  Surface,  ///< A surface without volume.
  Other,    ///< Not to be built.
  NegativeVolume,
  Modifier,
  SupportBlocker,
  SupportEnforcer,
  Unknown
};
inline constexpr size_t kPartRoleCount = 9;
using RoleCounts = std::array<uint64_t, kPartRoleCount>;

/// The parts that are not material, as noun phrases, for example "2 modifiers".
[[nodiscard]] std::vector<std::string> describeRoles(const RoleCounts& counts);

/// The role by the attribute `type` of an object. Empty if the core specification does not have this type.
[[nodiscard]] std::optional<PartRole> roleOfObjectType(std::string_view type);

/// The role by an object's metadata that Cura writes, for example "cura:infill_mesh" with the value "True".
[[nodiscard]] PartRole roleOfCuraMetadata(std::string_view name, std::string_view value);

/// The role and the name that a slicer gives to a part of an object.
struct PartSetting {
  std::string_view source;     ///< File or element, for messages.
  std::optional<uint64_t> id;  ///< The object that is the part: a component, or the object itself.
  bool isRange = false;        ///< The part has the triangles from `first` to `last` of the object.
  uint64_t first = 0, last = 0;
  PartRole role = PartRole::Material;
  std::string title = {};  ///< Name in the form of objectName(); empty if the part has none.

  /// For messages, for example "Metadata/model_settings.config: part 7".
  [[nodiscard]] std::string name() const;
};

struct ObjectSettings {
  std::string title = {};  ///< Name of the object, in the form of PartSetting::title.
  std::vector<PartSetting> parts;
};

/// Settings by the object of the root model.
using PartSettings = std::map<uint64_t, ObjectSettings>;

/// Files of settings: ranges of triangles (PrusaSlicer, SuperSlicer), components (Bambu Studio, OrcaSlicer).
inline constexpr std::array<std::string_view, 2> kSettingsFiles{"Metadata/Slic3r_PE_model.config",
                                                                "Metadata/model_settings.config"};

/// Reads one of kSettingsFiles. charge(bytes): receives the memory of each setting. Throws Error as XmlReader does.
void readPartSettings(XmlReader& xml, std::string_view file, const std::function<void(uint64_t)>& charge,
                      PartSettings& settings);

/// Reads the attributes of an element slic3r:volume of Slic3r.
[[nodiscard]] PartSetting slic3rVolume(const XmlReader& xml);

/// Names the triangles of the ranges that are material. Removes the triangles of the other ranges, and the vertices
/// that no other triangle has. Adds the other ranges to the counts. If there are other ranges, throws
/// Error{UnreadableInput} if any range is not within the mesh or overlaps another one; otherwise such a range has no
/// effect.
void applyRanges(std::vector<PartSetting> ranges, PartMesh& mesh, RoleCounts& counts);

}  // namespace asdfvk
