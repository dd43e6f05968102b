#include "io/threemf_roles.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/input_failure.h"
#include "io/object_names.h"

namespace asdfvk {
namespace {

struct RoleNames {
  PartRole role;
  std::string_view noun, plural;
};
constexpr std::array<RoleNames, kPartRoleCount - 1> kRoleNames{
    {{PartRole::Support, "support", ""},
     {PartRole::Surface, "surface without volume", "surfaces without volume"},
     {PartRole::Other, "object of type other", "objects of type other"},
     {PartRole::NegativeVolume, "negative volume", ""},
     {PartRole::Modifier, "modifier", ""},
     {PartRole::SupportBlocker, "support blocker", ""},
     {PartRole::SupportEnforcer, "support enforcer", ""},
     {PartRole::Unknown, "part of an unknown type", "parts of unknown types"}}};

/// PrusaSlicer and SuperSlicer write the first names, Bambu Studio and OrcaSlicer the second ones.
PartRole roleOfSlicer(std::string_view name) {
  if (name.empty() || name == "ModelPart" || name == "normal_part") return PartRole::Material;
  if (name == "NegativeVolume" || name == "negative_part") return PartRole::NegativeVolume;
  if (name == "ParameterModifier" || name == "modifier_part") return PartRole::Modifier;
  if (name == "SupportBlocker" || name == "support_blocker") return PartRole::SupportBlocker;
  if (name == "SupportEnforcer" || name == "support_enforcer") return PartRole::SupportEnforcer;
  return PartRole::Unknown;
}

uint64_t settingNumber(const XmlReader& xml, std::string_view attribute) {
  const std::string_view text = withoutBlanks(xml.attribute(attribute).value_or(""));
  const std::optional<uint32_t> number = numberIn<uint32_t>(text);
  if (!number)
    xml.fail(
        fmt::format("{} {} of {} is not a whole number", attribute, asdfvk::quoted(text), asdfvk::quoted(xml.name())));
  return *number;
}

/// The name of an object or a part, if the element is metadata with a name.
std::optional<std::string> titleIn(const XmlReader& xml) {
  if (xml.name() != "metadata" || xml.attribute("key") != "name") return std::nullopt;
  return objectName(xml.attribute("value").value_or(""));
}

/// Reads an element `part` or `volume` to its end.
PartSetting readPart(XmlReader& xml, std::string_view file) {
  PartSetting part{.source = file};
  if (xml.attribute("id")) part.id = settingNumber(xml, "id");
  // Early versions of Bambu Studio wrote ranges, as PrusaSlicer does.
  part.isRange = xml.attribute("firstid") || xml.attribute("lastid");
  if (part.isRange) {
    part.first = settingNumber(xml, "firstid");
    part.last = settingNumber(xml, "lastid");
  }
  part.role = roleOfSlicer(withoutBlanks(xml.attribute("subtype").value_or("")));
  bool hasType = false;
  while (xml.next() == XmlReader::Event::Start) {
    const std::string_view key = xml.attribute("key").value_or("");
    const std::string_view value = withoutBlanks(xml.attribute("value").value_or(""));
    if (const std::optional<std::string> title = titleIn(xml)) part.title = *title;
    if (xml.name() == "metadata" && (key == "volume_type" || key == "part_type")) {
      part.role = roleOfSlicer(value);
      hasType = true;
    } else if (xml.name() == "metadata" && key == "modifier" && value == "1" && !hasType) {
      part.role = PartRole::Modifier;  // Written before there were types.
    }
    xml.skipElement();
  }
  if (part.role != PartRole::Material && !part.isRange && !part.id) xml.fail("a part has no id and no triangles");
  return part;
}

bool isMaterial(const PartSetting& part) { return part.role == PartRole::Material; }

/// The names of the triangles that are left without the ranges that are not material. ranges: in ascending order.
std::vector<NamedFaces> titlesOf(const std::vector<PartSetting>& ranges, uint64_t faceCount) {
  ObjectNames names;
  uint64_t end = 0, removedCount = 0;
  for (const PartSetting& range : ranges) {
    if (range.first < end || range.last < range.first || range.last >= faceCount) continue;
    names.begin(end - removedCount, {});
    end = range.last + 1;
    if (isMaterial(range))
      names.begin(range.first - removedCount, range.title);
    else
      removedCount += end - range.first;
  }
  names.begin(end - removedCount, {});
  return names.finish(faceCount - removedCount);
}

}  // namespace

std::string PartSetting::name() const {
  if (isRange) return fmt::format("{}: triangles {} to {}", source, first, last);
  return fmt::format("{}: part {}", source, id.value_or(0));
}

std::vector<std::string> describeRoles(const RoleCounts& counts) {
  std::vector<std::string> phrases;
  for (const RoleNames& names : kRoleNames)
    if (const uint64_t count = counts[static_cast<size_t>(names.role)]; count > 0)
      phrases.push_back(counted(count, names.noun, names.plural));
  return phrases;
}

std::optional<PartRole> roleOfObjectType(std::string_view type) {
  if (type == "model") return PartRole::Material;
  if (type == "support" || type == "solidsupport") return PartRole::Support;
  if (type == "surface") return PartRole::Surface;
  if (type == "other") return PartRole::Other;
  return std::nullopt;
}

PartRole roleOfCuraMetadata(std::string_view name, std::string_view value) {
  if (lowerCase(value) != "true") return PartRole::Material;
  if (name == "cura:infill_mesh" || name == "cura:cutting_mesh") return PartRole::Modifier;
  if (name == "cura:anti_overhang_mesh") return PartRole::SupportBlocker;
  if (name == "cura:support_mesh") return PartRole::Support;
  return PartRole::Material;
}

void readPartSettings(XmlReader& xml, std::string_view file, const std::function<void(uint64_t)>& charge,
                      PartSettings& settings) {
  constexpr uint64_t kNodeBytes = 128;
  if (xml.next() != XmlReader::Event::Start || xml.name() != "config") xml.fail("expected settings of a slicer");
  while (xml.next() == XmlReader::Event::Start) {
    if (xml.name() != "object") {
      xml.skipElement();
      continue;
    }
    ObjectSettings& object = settings[settingNumber(xml, "id")];
    charge(kNodeBytes + kMaxObjectNameSize);
    while (xml.next() == XmlReader::Event::Start) {
      if (xml.name() != "part" && xml.name() != "volume") {
        if (const std::optional<std::string> title = titleIn(xml)) object.title = *title;
        xml.skipElement();
        continue;
      }
      object.parts.push_back(readPart(xml, file));
      charge(2 * (sizeof(PartSetting) + object.parts.back().title.size()));
    }
  }
  if (xml.next() != XmlReader::Event::Finished) xml.fail("continues after the settings");
}

PartSetting slic3rVolume(const XmlReader& xml) {
  PartSetting part{.source = "slic3r:volumes", .isRange = true};
  part.first = settingNumber(xml, "ts");
  part.last = settingNumber(xml, "te");
  if (withoutBlanks(xml.attribute("modifier").value_or("")) == "1") part.role = PartRole::Modifier;
  return part;
}

void applyRanges(std::vector<PartSetting> ranges, PartMesh& mesh, RoleCounts& counts) {
  std::stable_sort(ranges.begin(), ranges.end(),
                   [](const PartSetting& a, const PartSetting& b) { return a.first < b.first; });
  mesh.objects = titlesOf(ranges, mesh.faces.size());
  if (std::all_of(ranges.begin(), ranges.end(), isMaterial)) return;
  std::vector<bool> removesFace(mesh.faces.size()), removesVertex(mesh.vertices.size());
  uint64_t end = 0;
  for (const PartSetting& range : ranges) {
    if (range.last < range.first || range.last >= mesh.faces.size())
      failInput(fmt::format("{}: the object has {}", range.name(), counted(mesh.faces.size(), "triangle")));
    if (range.first < end) failInput(fmt::format("{}: overlap another range", range.name()));
    end = range.last + 1;
    if (isMaterial(range)) continue;
    ++counts[static_cast<size_t>(range.role)];
    std::fill(removesFace.begin() + static_cast<ptrdiff_t>(range.first),
              removesFace.begin() + static_cast<ptrdiff_t>(end), true);
  }
  for (const bool isRemoved : {true, false})  // A vertex stays if another face has it, or if no face has it.
    for (size_t f = 0; f < mesh.faces.size(); ++f)
      if (removesFace[f] == isRemoved)
        for (const uint32_t corner : mesh.faces[f]) removesVertex[corner] = isRemoved;

  std::vector<uint32_t> newIndex(mesh.vertices.size());
  uint32_t vertexCount = 0;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    newIndex[v] = vertexCount;
    if (!removesVertex[v]) mesh.vertices[vertexCount++] = mesh.vertices[v];
  }
  mesh.vertices.resize(vertexCount);
  size_t faceCount = 0;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    if (removesFace[f]) continue;
    const Face& face = mesh.faces[f];
    mesh.faces[faceCount++] = {newIndex[face[0]], newIndex[face[1]], newIndex[face[2]]};
  }
  mesh.faces.resize(faceCount);
}

}  // namespace asdfvk
