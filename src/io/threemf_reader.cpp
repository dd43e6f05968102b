// 3MF (core specification 1.3, production extension 1.1): reads the objects of the build items, with their components
// and transforms, in the unit of the file. Each build item and each component is a part with the name of its object.
// Colours, materials and metadata are ignored. What is not material (io/threemf_roles.h), beam lattices, and items that
// are not to be printed are left out; Mesh::skipped lists them. Only files within the archive are opened.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "asdf_vk/error.h"
#include "core/length_unit.h"
#include "core/text.h"
#include "io/assembled_mesh.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/threemf_model.h"
#include "io/threemf_model_list.h"
#include "io/threemf_roles.h"
#include "io/xml_reader.h"
#include "io/zip_archive.h"

namespace asdfvk {
namespace {

constexpr std::string_view kModelRelationship = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr uint32_t kMaxNesting = 64;  // Levels of nested components.

double micrometresOf(const ModelUnit& row) { return findLengthUnit(row.unit)->micrometres; }

struct ObjectCounts {
  uint64_t vertices = 0, faces = 0;
  uint32_t height = 1;  ///< Levels of components, the object included.

  void add(const ObjectCounts& other) {
    vertices = std::min(vertices + other.vertices, kSaturatedCount);
    faces = std::min(faces + other.faces, kSaturatedCount);
  }
};

uint64_t memoryLimit(const MeshSource& source) {
  constexpr uint64_t kMaxBytesPerByte = 20;  // A growing array temporarily needs three times its size.
  return source.limit(kMaxInstanceBytes, kMaxBytesPerByte);
}

/// Markup rarely deflates to less than a tenth.
uint64_t inflatedLimit(const MeshSource& source) {
  constexpr uint64_t kMinLimit = uint64_t{256} << 20, kMaxInflatedBytesPerByte = 100;
  return source.limit(kMinLimit, kMaxInflatedBytesPerByte);
}

class ThreeMfReader {
 public:
  explicit ThreeMfReader(const MeshSource& source)
      : source_(source), archive_(source.bytes), models_(memoryLimit(source)) {}

  Mesh read();

 private:
  template <typename Work>
  void readPart(const ZipEntry& entry, const std::string& path, XmlReader::Prefixes prefixes, const Work& work);
  std::string rootPath();
  void readSettings();
  void readModelAt(size_t index);
  [[nodiscard]] const ModelObject& objectOf(const ObjectUse& use) const;
  ObjectCounts countsOf(const ObjectUse& use, uint32_t depth);
  void place(const ObjectUse& use, const Placement& outer, double scale, std::string_view outerName,
             AssembledMesh& assembled);
  [[nodiscard]] std::string nameOf(const ObjectUse& use) const {
    return fmt::format("object {} of {}", use.object, printable(models_.model(use.model).path));
  }

  const MeshSource& source_;
  ZipArchive archive_;
  ModelList models_;
  std::map<std::pair<size_t, uint64_t>, ObjectCounts> counts_;
  RoleCounts roleCounts_{};
  uint64_t inflatedBytes_ = 0;
};

/// Calls work(xml) for a file of the archive.
template <typename Work>
void ThreeMfReader::readPart(const ZipEntry& entry, const std::string& path, XmlReader::Prefixes prefixes,
                             const Work& work) {
  ZipStream stream(archive_, entry);
  const auto read = [&](char* to, size_t size) {
    const size_t count = stream.read(to, size);
    inflatedBytes_ += count;
    if (const uint64_t limit = inflatedLimit(source_); inflatedBytes_ > limit)
      throw Error(ErrorCode::InputTooLarge, fmt::format("its files have more than {} MiB", limit >> 20));
    return count;
  };
  XmlReader xml(read, path, prefixes);
  work(xml);
}

std::string ThreeMfReader::rootPath() {
  constexpr std::string_view kRelationships = "_rels/.rels";
  const ZipEntry* const entry = archive_.find(kRelationships);
  if (entry == nullptr) failInput("is a ZIP archive but not 3MF: it has no _rels/.rels; if it has a mesh, unpack it");
  std::optional<std::string> path;
  readPart(*entry, std::string(kRelationships), XmlReader::Prefixes::Resolved, [&](XmlReader& xml) {
    for (XmlReader::Event event = xml.next(); event != XmlReader::Event::Finished; event = xml.next()) {
      if (event != XmlReader::Event::Start || xml.attribute("Type") != kModelRelationship) continue;
      if (path) xml.fail("names two models");
      path = xml.attribute("Target").value_or("");
    }
  });
  if (!path) failInput("is a ZIP archive but not 3MF: _rels/.rels names no model");
  return *path;
}

void ThreeMfReader::readSettings() {
  for (const std::string_view file : kSettingsFiles)
    if (const ZipEntry* const entry = archive_.find(file))
      readPart(*entry, std::string(file), XmlReader::Prefixes::PartOfName, [&](XmlReader& xml) {
        readPartSettings(
            xml, file, [&](uint64_t bytes) { models_.charge(bytes); }, models_.settings());
      });
}

void ThreeMfReader::readModelAt(size_t index) {
  const std::string path = models_.model(index).path;
  const ZipEntry* const entry = archive_.find(path);
  if (entry == nullptr) failInput(fmt::format("the archive has no {}", asdfvk::quoted(path)));
  readPart(*entry, path, XmlReader::Prefixes::Resolved, [&](XmlReader& xml) { readModel(xml, models_, index); });
  if (index > 0) return;
  for (const auto& [object, settings] : models_.settings())
    for (const PartSetting& part : settings.parts)
      if (part.role != PartRole::Material)
        failInput(fmt::format("{}: the model has no object {}", part.name(), object));
}

const ModelObject& ThreeMfReader::objectOf(const ObjectUse& use) const {
  const auto& objects = models_.model(use.model).objects;
  const auto found = objects.find(use.object);
  if (found == objects.end()) failInput(fmt::format("there is no {}", nameOf(use)));
  return found->second;
}

ObjectCounts ThreeMfReader::countsOf(const ObjectUse& use, uint32_t depth) {
  const auto requireNesting = [&](uint32_t levels) {
    if (levels > kMaxNesting)
      failInput(fmt::format("{} is nested more than {} levels deep, or in itself", nameOf(use), kMaxNesting));
  };
  requireNesting(depth + 1);
  if (const auto known = counts_.find({use.model, use.object}); known != counts_.end()) return known->second;
  const ModelObject& object = objectOf(use);
  for (size_t role = 0; role < kPartRoleCount; ++role) roleCounts_[role] += object.leftOut[role];
  ObjectCounts counts;
  if (object.role == PartRole::Material)
    counts = {object.mesh.vertices.size(), object.mesh.faces.size()};
  else
    ++roleCounts_[static_cast<size_t>(object.role)];
  for (const ObjectUse& component : object.components) {
    if (component.role != PartRole::Material) {
      ++roleCounts_[static_cast<size_t>(component.role)];
      continue;
    }
    const ObjectCounts inner = countsOf(component, depth + 1);
    counts.add(inner);
    counts.height = std::max(counts.height, inner.height + 1);
    requireNesting(counts.height);  // The counts of the components may be known from an earlier use.
  }
  counts_[{use.model, use.object}] = counts;
  return counts;
}

void ThreeMfReader::place(const ObjectUse& use, const Placement& outer, double scale, std::string_view outerName,
                          AssembledMesh& assembled) {
  if (use.role != PartRole::Material || counts_[{use.model, use.object}].faces == 0) return;
  const ModelObject& object = objectOf(use);
  Placement placement = outer.after(use.placement);
  if (!placement.isFinite()) failInput(fmt::format("the transform of {} overflows", nameOf(use)));
  const double unit = micrometresOf(*models_.model(use.model).unit);
  if (unit != scale) {  // The object is in another file of the archive.
    for (Vec3d& column : placement.columns) column = column * (unit / scale);
    if (!placement.isFinite()) failInput(fmt::format("the transform of {} overflows", nameOf(use)));
  }
  const std::string_view name = !use.name.empty() ? use.name : !object.name.empty() ? object.name : outerName;
  if (object.role == PartRole::Material) assembled.add(object.mesh, placement, name);
  for (const ObjectUse& component : object.components) place(component, placement, unit, name, assembled);
}

Mesh ThreeMfReader::read() {
  const size_t root = models_.indexAt(rootPath());
  readSettings();
  for (size_t i = 0; i < models_.size(); ++i) readModelAt(i);  // Models name further models.
  const ModelFile& model = models_.model(root);
  ObjectCounts all;
  for (const ObjectUse& item : model.items) all.add(countsOf(item, 0));
  std::vector<std::string> skipped = describeRoles(roleCounts_);
  for (std::string& phrase : models_.describeSkipped()) skipped.push_back(std::move(phrase));
  if (model.unprintedCount > 0)
    skipped.push_back(counted(model.unprintedCount, "build item that is not to be printed",
                              "build items that are not to be printed"));
  if (const uint64_t count = archive_.trailingByteCount(); count > 0)
    skipped.push_back(counted(count, "byte") + " after the end of the archive");
  if (all.faces == 0)
    failInput(skipped.empty() && model.items.empty()
                  ? "builds nothing: it has no build item"
                  : fmt::format("has {} and no triangle: nothing to compute on",
                                skipped.empty() ? "build items" : enumeration(skipped)));
  AssembledMesh assembled(all.vertices, all.faces, source_);
  for (const ObjectUse& item : model.items) place(item, {}, micrometresOf(*model.unit), {}, assembled);
  Mesh mesh = assembled.finish();
  mesh.unit = model.unit->unit;
  mesh.skipped = std::move(skipped);
  const auto countOf = [this](PartRole role) { return roleCounts_[static_cast<size_t>(role)]; };
  mesh.negativeVolumeCount =
      static_cast<uint32_t>(countOf(PartRole::NegativeVolume) + countOf(PartRole::Unknown));  // It may be negative.
  return mesh;
}

Match detect3mf(std::span<const char> bytes) {
  return std::string_view(bytes.data(), bytes.size()).starts_with("PK\x03\x04") ? Match::Possible : Match::None;
}

Mesh parse3mf(const MeshSource& source) { return ThreeMfReader(source).read(); }

}  // namespace

extern const FileFormat k3mfFormat{.name = "3mf", .extensions = {"3mf"}, .detect = detect3mf, .parseMesh = parse3mf};

}  // namespace asdfvk
