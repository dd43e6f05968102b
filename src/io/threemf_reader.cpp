// 3MF (core specification 1.3, production extension 1.1): reads the objects of the build items, with their components
// and transforms, in the unit of the file. Each build item and each component is a part. Colours, materials and
// metadata are ignored. Supports and beam lattices are left out; Mesh::skipped lists them. Only files within the
// archive are opened.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "asdf_vk/error.h"
#include "core/length_unit.h"
#include "core/text.h"
#include "io/assembled_mesh.h"
#include "io/corner_welder.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/xml_scanner.h"
#include "io/zip_archive.h"
#include "mesh/dual_graph.h"

namespace asdfvk {
namespace {

constexpr std::string_view kCoreNamespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view kModelRelationship = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr uint32_t kMaxNesting = 64;  // Levels of nested components.

struct UnitRow {
  std::string_view name;  // Name in the file.
  std::string_view unit;  // Name in kLengthUnits.
};
constexpr std::array<UnitRow, 6> kModelUnits{
    {{"millimeter", "mm"}, {"micron", "um"}, {"centimeter", "cm"}, {"meter", "m"}, {"inch", "in"}, {"foot", "ft"}}};
double micrometresOf(const UnitRow& row) { return findLengthUnit(row.unit)->micrometres; }

/// An object that is placed by a build item or is a component of another object.
struct ObjectUse {
  size_t model = 0;
  uint64_t object = 0;
  Placement placement;
};

struct ModelObject {
  PartMesh mesh;
  std::vector<ObjectUse> components;
  bool isSupport = false;
};

struct ModelFile {
  std::string path;
  const UnitRow* unit = kModelUnits.data();
  std::map<uint64_t, ModelObject> objects;
  std::vector<ObjectUse> items;
};

struct ObjectCounts {
  uint64_t vertices = 0, faces = 0;
  uint32_t height = 1;  ///< Levels of components, the object included.
};

class ModelReader;

class ThreeMfReader {
 public:
  explicit ThreeMfReader(std::span<const char> bytes) : archive_(bytes) {}

  Mesh read();

  /// Returns the index in models_ of the model at a path within the archive. Adds a new model without reading it.
  size_t modelAt(std::string_view path);
  [[nodiscard]] ModelFile& model(size_t index) { return models_[index]; }
  /// Adds `bytes` to the memory of the mesh. Throws Error{InputTooLarge} above the limit.
  void charge(uint64_t bytes);
  void countLattice() { ++latticeCount_; }

 private:
  std::string rootPath();
  void readModel(size_t index);
  [[nodiscard]] const ModelObject& objectOf(const ObjectUse& use) const;
  ObjectCounts countsOf(const ObjectUse& use, uint32_t depth);
  void place(const ObjectUse& use, const Placement& outer, double scale, AssembledMesh& assembled);
  [[nodiscard]] std::string nameOf(const ObjectUse& use) const {
    return fmt::format("object {} of {}", use.object, printable(models_[use.model].path));
  }

  ZipArchive archive_;
  std::vector<ModelFile> models_;
  std::map<std::string, size_t, std::less<>> modelOf_;  ///< Index in models_ by path.
  std::map<std::pair<size_t, uint64_t>, ObjectCounts> counts_;
  uint64_t chargedBytes_ = 0, latticeCount_ = 0, supportCount_ = 0;
};

class ModelReader {
 public:
  ModelReader(ThreeMfReader& archive, size_t index, XmlScanner& xml) : archive_(archive), index_(index), xml_(xml) {}

  void read() {
    if (xml_.next() != XmlScanner::Event::Start) xml_.fail("has no model");
    readNamespaces();
    if (!isCore("model")) xml_.fail(fmt::format("expected a model of 3MF, found {}", asdfvk::quoted(xml_.name())));
    readUnit();
    requireExtensions();
    forEachChild([&] {
      if (isCore("resources"))
        forEachChild([&] { isCore("object") ? readObject() : xml_.skipElement(); });
      else if (isCore("build"))
        forEachChild([&] { isCore("item") ? readItem() : xml_.skipElement(); });
      else
        xml_.skipElement();
    });
    if (xml_.next() != XmlScanner::Event::Finished) xml_.fail("continues after the model");
  }

 private:
  ModelFile& model() { return archive_.model(index_); }
  /// Whether the current element is `name` of the core specification. Several prefixes may stand for the core
  /// namespace.
  [[nodiscard]] bool isCore(std::string_view name) const {
    const std::string_view found = xml_.name();
    if (!found.ends_with(name)) return false;
    const std::string_view prefix = found.substr(0, found.size() - name.size());
    return std::find(corePrefixes_.begin(), corePrefixes_.end(), prefix) != corePrefixes_.end();
  }

  /// Calls work() at the start of each child. work() reads the child to its end.
  template <typename Work>
  void forEachChild(const Work& work) {
    while (xml_.next() == XmlScanner::Event::Start) work();
  }

  void readNamespaces() {
    for (const auto& [name, value] : xml_.attributes()) {
      if (name == "xmlns" && value == kCoreNamespace) corePrefixes_.emplace_back();
      if (!name.starts_with("xmlns:")) continue;
      const std::string prefix(name.substr(6));
      namespaces_[prefix] = value;
      if (value == kCoreNamespace) corePrefixes_.push_back(prefix + ":");
      if (value.find("/production/") != std::string_view::npos) pathAttribute_ = prefix + ":path";
    }
    if (corePrefixes_.empty()) xml_.fail("is not a model of 3MF: it does not name the core namespace");
  }

  void readUnit() {
    const std::string_view unit = xml_.attribute("unit").value_or(kModelUnits[0].name);
    const auto row =
        std::find_if(kModelUnits.begin(), kModelUnits.end(), [&](const UnitRow& r) { return r.name == unit; });
    if (row == kModelUnits.end()) xml_.fail(fmt::format("{} is not a unit of 3MF", asdfvk::quoted(unit)));
    model().unit = &*row;
  }

  void requireExtensions() {
    for (const std::string& prefix : splitAt(xml_.attribute("requiredextensions").value_or(""), ' ')) {
      if (prefix.empty()) continue;
      const std::string& space = namespaces_[prefix];
      const auto is = [&](std::string_view part) { return space.find(part) != std::string::npos; };
      if (!is("/production/") && !is("/material/") && !is("/trianglesets/"))
        xml_.fail(fmt::format("requires the extension {} {}, which is not supported; export without it",
                              asdfvk::quoted(prefix), asdfvk::quoted(space)));
    }
  }

  std::string_view requiredAttribute(std::string_view name) {
    const auto value = xml_.attribute(name);
    if (!value) xml_.fail(fmt::format("{} has no {}", asdfvk::quoted(xml_.name()), name));
    return *value;
  }

  uint64_t whole(std::string_view name) {
    const std::string_view text = requiredAttribute(name);
    const std::optional<uint32_t> number = numberIn<uint32_t>(text);
    if (!number) xml_.fail(fmt::format("{} {} is not a whole number", name, asdfvk::quoted(text)));
    return *number;
  }

  double real(std::string_view text, std::string_view what) {
    const std::optional<double> number = numberIn<double>(text.substr(text.starts_with('+') ? 1 : 0));
    if (!number || !std::isfinite(*number)) xml_.fail(fmt::format("{} {} is not a number", what, asdfvk::quoted(text)));
    return *number;
  }

  /// Reads twelve numbers: the images of the axes, then the translation.
  Placement placement() {
    Placement read;
    const auto text = xml_.attribute("transform");
    if (!text) return read;
    std::array<double, 12> numbers{};
    size_t count = 0;
    for (const std::string& number : splitAt(*text, ' ')) {
      if (number.empty()) continue;
      if (count == numbers.size()) xml_.fail("a transform has more than 12 numbers");
      numbers[count++] = real(number, "a number of a transform");
    }
    if (count != numbers.size()) xml_.fail(fmt::format("a transform has {} instead of 12", counted(count, "number")));
    for (size_t i = 0; i < 4; ++i)
      (i < 3 ? read.columns[i] : read.translation) = Vec3d{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return read;
  }

  ObjectUse use() {
    ObjectUse read{index_, whole("objectid"), placement()};
    if (const auto path = pathAttribute_.empty() ? std::nullopt : xml_.attribute(pathAttribute_)) {
      const std::optional<std::string> decoded = xmlDecoded(*path);
      if (!decoded) xml_.fail(fmt::format("path {} has an unknown entity", asdfvk::quoted(*path)));
      read.model = archive_.modelAt(*decoded);
    }
    archive_.charge(sizeof(ObjectUse));
    return read;
  }

  void readItem() {
    const ObjectUse item = use();
    model().items.push_back(item);
    xml_.skipElement();
  }

  void readObject() {
    const uint64_t id = whole("id");
    const std::string type(xml_.attribute("type").value_or("model"));
    ModelObject object;
    object.isSupport = type == "support" || type == "solidsupport";
    archive_.charge(sizeof(ModelObject) + 64);
    forEachChild([&] {
      if (isCore("mesh"))
        readMesh(object.mesh);
      else if (isCore("components"))
        forEachChild([&] {
          if (isCore("component")) object.components.push_back(use());
          xml_.skipElement();
        });
      else
        xml_.skipElement();
    });
    weldIfOpen(object.mesh);
    if (!model().objects.emplace(id, std::move(object)).second) xml_.fail(fmt::format("object {} occurs twice", id));
  }

  void readMesh(PartMesh& mesh) {
    if (!mesh.vertices.empty()) xml_.fail("an object has two meshes");
    forEachChild([&] {
      if (isCore("vertices")) {
        forEachChild([&] { isCore("vertex") ? readVertex(mesh) : xml_.skipElement(); });
      } else if (isCore("triangles")) {
        forEachChild([&] { isCore("triangle") ? readTriangle(mesh) : xml_.skipElement(); });
      } else {
        if (xml_.name().ends_with("beamlattice")) archive_.countLattice();
        xml_.skipElement();
      }
    });
  }

  void readVertex(PartMesh& mesh) {
    archive_.charge(sizeof(Vec3d));
    Vec3d p;
    p.x = real(requiredAttribute("x"), "x");
    p.y = real(requiredAttribute("y"), "y");
    p.z = real(requiredAttribute("z"), "z");
    mesh.vertices.push_back(p);
    xml_.skipElement();
  }

  void readTriangle(PartMesh& mesh) {
    constexpr uint64_t kSurveyBytes = 60;  // Memory that weldIfOpen() needs per face.
    archive_.charge(sizeof(Face) + kSurveyBytes);
    Face face;
    constexpr std::array<std::string_view, 3> kNames{"v1", "v2", "v3"};
    for (size_t c = 0; c < 3; ++c) {
      const uint64_t vertex = whole(kNames[c]);
      if (vertex >= mesh.vertices.size())
        xml_.fail(fmt::format("{} {} is out of range; the mesh has {}", kNames[c], vertex,
                              counted(mesh.vertices.size(), "vertex", "vertices")));
      face[c] = static_cast<uint32_t>(vertex);
    }
    mesh.faces.push_back(face);
    xml_.skipElement();
  }

  /// Joins equal vertices if the mesh is open. Some writers split vertices, which the specification forbids. Faces
  /// without common vertices would have no neighbours.
  static void weldIfOpen(PartMesh& mesh) {
    TriangleMesh view;
    view.vertices = mesh.vertices;
    view.faces = mesh.faces;
    if (mesh.faces.empty() || surveyEdges(view).isClosed) return;
    CornerWelder welder(mesh.vertices.size() / 3);
    for (Face& face : mesh.faces)
      for (uint32_t& corner : face) corner = welder.indexOf(mesh.vertices[corner]);
    mesh.vertices = std::move(welder.points());
  }

  ThreeMfReader& archive_;
  size_t index_;
  XmlScanner& xml_;
  std::vector<std::string> corePrefixes_;  ///< Each with its colon; "" for the default namespace.
  std::string pathAttribute_;
  std::map<std::string, std::string> namespaces_;
};

void ThreeMfReader::charge(uint64_t bytes) {
  chargedBytes_ += bytes;
  constexpr uint64_t kMaxBytesPerByte = 20;  // A growing array temporarily needs three times its size.
  const uint64_t limit = std::max(kMaxInstanceBytes, kMaxBytesPerByte * archive_.bytes().size());
  if (chargedBytes_ > limit)
    throw Error(ErrorCode::InputTooLarge, fmt::format("its mesh needs more than {} MiB of memory", limit >> 20));
}

size_t ThreeMfReader::modelAt(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  const auto [known, isNew] = modelOf_.emplace(path, models_.size());
  if (!isNew) return known->second;
  constexpr size_t kMaxModels = 4096;
  if (models_.size() == kMaxModels) failInput(fmt::format("more than {} model files", kMaxModels));
  charge(sizeof(ModelFile) + 128 + path.size());
  models_.push_back({.path = std::string(path)});
  return models_.size() - 1;
}

std::string ThreeMfReader::rootPath() {
  constexpr std::string_view kRelationships = "_rels/.rels";
  const ZipEntry* const entry = archive_.find(kRelationships);
  if (entry == nullptr) failInput("is a ZIP archive but not 3MF: it has no _rels/.rels");
  ZipStream stream(archive_, *entry);
  XmlScanner xml([&](char* to, size_t size) { return stream.read(to, size); }, std::string(kRelationships));
  std::optional<std::string> path;
  for (XmlScanner::Event event = xml.next(); event != XmlScanner::Event::Finished; event = xml.next()) {
    if (event != XmlScanner::Event::Start || xml.attribute("Type") != kModelRelationship) continue;
    if (path) xml.fail("names two models");
    path = xmlDecoded(xml.attribute("Target").value_or(""));
    if (!path) xml.fail("the target of a relationship has an unknown entity");
  }
  if (!path) failInput("is a ZIP archive but not 3MF: _rels/.rels names no model");
  return *path;
}

void ThreeMfReader::readModel(size_t index) {
  const std::string path = models_[index].path;
  const ZipEntry* const entry = archive_.find(path);
  if (entry == nullptr) failInput(fmt::format("the archive has no {}", asdfvk::quoted(path)));
  ZipStream stream(archive_, *entry);
  XmlScanner xml([&](char* to, size_t size) { return stream.read(to, size); }, path);
  ModelReader(*this, index, xml).read();
}

const ModelObject& ThreeMfReader::objectOf(const ObjectUse& use) const {
  const auto& objects = models_[use.model].objects;
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
  constexpr uint64_t kTooMany = uint64_t{1} << 50;
  const ModelObject& object = objectOf(use);
  ObjectCounts counts;
  if (object.isSupport) {
    ++supportCount_;
  } else {
    counts = {object.mesh.vertices.size(), object.mesh.faces.size()};
    for (const ObjectUse& component : object.components) {
      const ObjectCounts inner = countsOf(component, depth + 1);
      counts.vertices = std::min(counts.vertices + inner.vertices, kTooMany);
      counts.faces = std::min(counts.faces + inner.faces, kTooMany);
      counts.height = std::max(counts.height, inner.height + 1);
      requireNesting(counts.height);  // The counts of the components may be known from an earlier use.
    }
  }
  counts_[{use.model, use.object}] = counts;
  return counts;
}

void ThreeMfReader::place(const ObjectUse& use, const Placement& outer, double scale, AssembledMesh& assembled) {
  if (counts_[{use.model, use.object}].faces == 0) return;
  const ModelObject& object = objectOf(use);
  Placement placement = outer.after(use.placement);
  if (!placement.isFinite()) failInput(fmt::format("the transform of {} overflows", nameOf(use)));
  const double unit = micrometresOf(*models_[use.model].unit);
  if (unit != scale) {  // The object is in another file of the archive.
    for (Vec3d& column : placement.columns) column = column * (unit / scale);
    if (!placement.isFinite()) failInput(fmt::format("the transform of {} overflows", nameOf(use)));
  }
  assembled.add(object.mesh, placement);
  for (const ObjectUse& component : object.components) place(component, placement, unit, assembled);
}

Mesh ThreeMfReader::read() {
  const size_t root = modelAt(rootPath());
  for (size_t i = 0; i < models_.size(); ++i) readModel(i);  // Reading a model may add further models.
  ObjectCounts all;
  for (const ObjectUse& item : models_[root].items) {
    const ObjectCounts counts = countsOf(item, 0);
    all = {all.vertices + counts.vertices, all.faces + counts.faces};
  }
  std::vector<std::string> skipped;
  if (supportCount_ > 0) skipped.push_back(counted(supportCount_, "support"));
  if (latticeCount_ > 0) skipped.push_back(counted(latticeCount_, "beam lattice"));
  if (all.faces == 0)
    failInput(models_[root].items.empty() ? "builds nothing: it has no build item"
                                          : fmt::format("has {} and no triangle: nothing to compute on",
                                                        skipped.empty() ? "build items" : joined(skipped, " and ")));
  AssembledMesh assembled(all.vertices, all.faces, archive_.bytes().size());
  for (const ObjectUse& item : models_[root].items) place(item, {}, micrometresOf(*models_[root].unit), assembled);
  Mesh mesh = assembled.finish();
  mesh.unit = models_[root].unit->unit;
  mesh.skipped = std::move(skipped);
  return mesh;
}

Match detect3mf(std::span<const char> bytes) {
  return std::string_view(bytes.data(), bytes.size()).starts_with("PK\x03\x04") ? Match::Possible : Match::None;
}

Mesh parse3mf(std::span<const char> bytes) { return ThreeMfReader(bytes).read(); }

}  // namespace

extern const FileFormat k3mfFormat{.name = "3mf", .extensions = {"3mf"}, .detect = detect3mf, .parseMesh = parse3mf};

}  // namespace asdfvk
