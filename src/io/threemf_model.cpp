#include "io/threemf_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/corner_welder.h"
#include "io/input_failure.h"
#include "io/object_names.h"
#include "io/text_scanner.h"
#include "mesh/dual_graph.h"

namespace asdfvk {
namespace {

/// The core namespaces: of the specification, and of the drafts before it.
bool isCoreSpace(std::string_view space) {
  return space == "http://schemas.microsoft.com/3dmanufacturing/core/2015/02" ||
         space == "http://schemas.microsoft.com/3dmanufacturing/2013/01";
}

/// Whether a namespace has a path element, for example "/material/". Its date differs between versions.
bool spaceHas(std::string_view space, std::string_view part) { return space.find(part) != std::string_view::npos; }

/// Takes the next word from the text; returns "" at its end.
std::string_view takeWord(std::string_view& text) {
  text = withoutBlanks(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  text.remove_prefix(word.size());
  return word;
}

class ModelReader {
 public:
  ModelReader(ModelList& models, size_t index, XmlReader& xml) : models_(models), index_(index), xml_(xml) {}

  void read() {
    if (xml_.next() != XmlReader::Event::Start) xml_.fail("has no model");
    if (xml_.name() != "model")
      xml_.fail(fmt::format("expected a model of 3MF, found {}", asdfvk::quoted(xml_.name())));
    if (!isCore("model"))
      xml_.fail(fmt::format("is not a model of 3MF: it has the namespace {}", asdfvk::quoted(xml_.space())));
    readUnit();
    requireExtensions();
    forEachChild([&] {
      if (isCore("resources"))
        forEachChild([&] { isCore("object") ? readObject() : skipResource(); });
      else if (isCore("build"))
        forEachChild([&] { isCore("item") ? readItem() : skipUnknown(); });
      else if (isCore("metadata") || !isCoreSpace(xml_.space()))
        xml_.skipElement();
      else
        skipResource();
    });
    if (xml_.next() != XmlReader::Event::Finished) xml_.fail("continues after the model");
  }

 private:
  ModelFile& model() { return models_.model(index_); }
  [[nodiscard]] bool isCore(std::string_view name) const { return xml_.name() == name && isCoreSpace(xml_.space()); }

  /// Calls work() at the start of each child. work() reads the child to its end.
  template <typename Work>
  void forEachChild(const Work& work) {
    for (;;) {
      const XmlReader::Event event = xml_.next();
      if (!xml_.text().empty()) xml_.fail(fmt::format("text {} between elements", asdfvk::quoted(xml_.text())));
      if (event != XmlReader::Event::Start) return;
      work();
    }
  }

  /// Skips an element of an extension. The core specification has no further elements here, so that an unknown one may
  /// be a damaged triangle.
  void skipUnknown() {
    if (isCoreSpace(xml_.space())) xml_.fail(fmt::format("unexpected element {}", asdfvk::quoted(xml_.name())));
    skipResource();
  }

  void skipResource() {
    const bool isKnown =
        isCore("basematerials") || spaceHas(xml_.space(), "/material/") || spaceHas(xml_.space(), "/trianglesets/");
    if (!isKnown) models_.countSkipped(xml_.name());
    xml_.skipElement();
  }

  void readUnit() {
    const std::string_view unit = withoutBlanks(xml_.attribute("unit").value_or(kModelUnits[0].name));
    const auto row =
        std::find_if(kModelUnits.begin(), kModelUnits.end(), [&](const ModelUnit& r) { return r.name == unit; });
    if (row == kModelUnits.end()) xml_.fail(fmt::format("{} is not a unit of 3MF", asdfvk::quoted(unit)));
    model().unit = &*row;
  }

  void requireExtensions() {
    std::string_view required = xml_.attribute("requiredextensions").value_or("");
    for (std::string_view prefix = takeWord(required); !prefix.empty(); prefix = takeWord(required)) {
      const std::string space = xml_.namespaceOf(std::string(prefix));
      if (!spaceHas(space, "/production/") && !spaceHas(space, "/material/") && !spaceHas(space, "/trianglesets/"))
        xml_.fail(fmt::format("requires the extension {} {}, which is not supported; export without it",
                              asdfvk::quoted(prefix), asdfvk::quoted(space)));
    }
  }

  std::string_view requiredAttribute(std::string_view name) {
    const auto value = xml_.attribute(name);
    if (!value) xml_.fail(fmt::format("{} has no {}", asdfvk::quoted(xml_.name()), name));
    return withoutBlanks(*value);
  }

  uint64_t whole(std::string_view name) {
    const std::string_view text = requiredAttribute(name);
    const std::optional<uint32_t> number = numberIn<uint32_t>(text);
    if (!number) xml_.fail(fmt::format("{} {} is not a whole number", name, asdfvk::quoted(text)));
    return *number;
  }

  double real(std::string_view text, std::string_view what) {
    const std::optional<double> number = numberIn<double>(text.substr(text.starts_with('+') ? 1 : 0));
    if (!number || !std::isfinite(*number))
      xml_.fail(fmt::format("{} {} is not a number{}", what, asdfvk::quoted(text), remedyOfNumber(text)));
    return *number;
  }

  /// Reads twelve numbers: the images of the axes, then the translation.
  Placement placement() {
    Placement read;
    const auto transform = xml_.attribute("transform");
    if (!transform) return read;
    std::string_view text = *transform;
    std::array<double, 12> numbers{};
    size_t count = 0;
    for (std::string_view number = takeWord(text); !number.empty(); number = takeWord(text)) {
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
    for (const XmlReader::Attribute& attribute : xml_.attributes())
      if (attribute.name == "path" && spaceHas(attribute.space, "/production/"))
        read.model = models_.indexAt(withoutBlanks(attribute.value));
    models_.charge(sizeof(ObjectUse));
    return read;
  }

  void readItem() {
    const std::string_view printable = withoutBlanks(xml_.attribute("printable").value_or("1"));
    const ObjectUse item = use();  // May move model().
    if (printable == "0" || printable == "false")
      ++model().unprintedCount;
    else
      model().items.push_back(item);
    forEachChild([&] { isCore("metadatagroup") ? xml_.skipElement() : skipUnknown(); });
  }

  void readObject() {
    const uint64_t id = whole("id");
    const std::string_view type = withoutBlanks(xml_.attribute("type").value_or("model"));
    const std::optional<PartRole> role = roleOfObjectType(type);
    if (!role) xml_.fail(fmt::format("{} is not a type of object", asdfvk::quoted(type)));
    ModelObject object;
    object.role = *role;
    object.name = objectName(xml_.attribute("name").value_or(""));
    models_.charge(sizeof(ModelObject) + object.name.size() + 64);
    std::vector<PartSetting> ranges;
    forEachChild([&] {
      if (isCore("mesh"))
        readMesh(object.mesh, ranges);
      else if (isCore("components"))
        forEachChild([&] {
          if (!isCore("component")) return skipUnknown();
          object.components.push_back(use());
          forEachChild([&] { skipUnknown(); });
        });
      else if (isCore("metadatagroup"))
        forEachChild([&] { readMetadata(object); });
      else
        skipUnknown();
    });
    if (!object.components.empty()) {
      if (!object.mesh.faces.empty()) xml_.fail(fmt::format("object {} has a mesh and components", id));
      object.role = PartRole::Material;  // The types of the components decide.
    }
    if (index_ == 0) applySettings(id, object, ranges);
    applyRanges(std::move(ranges), object.mesh, object.leftOut);
    weldIfOpen(object.mesh);
    if (!model().objects.emplace(id, std::move(object)).second) xml_.fail(fmt::format("object {} occurs twice", id));
  }

  void readMetadata(ModelObject& object) {
    const std::string name(xml_.attribute("name").value_or(""));
    while (xml_.next() == XmlReader::Event::Start) xml_.skipElement();
    if (const PartRole role = roleOfCuraMetadata(name, withoutBlanks(xml_.text())); role != PartRole::Material)
      object.role = role;
  }

  /// Applies what a slicer says about the parts of an object of the root model.
  void applySettings(uint64_t id, ModelObject& object, std::vector<PartSetting>& ranges) {
    const auto found = models_.settings().find(id);
    if (found == models_.settings().end()) return;
    std::vector<PartSetting> parts;
    for (const PartSetting& setting : found->second.parts) (setting.isRange ? ranges : parts).push_back(setting);
    if (object.name.empty()) object.name = found->second.title;
    models_.settings().erase(found);
    std::map<uint64_t, size_t> firstOf;  // By the id of the part.
    for (size_t i = 0; i < parts.size(); ++i)
      if (parts[i].id) firstOf.emplace(*parts[i].id, i);
    std::vector<bool> isFound(parts.size());
    // Bambu Studio lists the parts in the order of the components, and several may be the same object.
    const auto settingOf = [&](uint64_t part, size_t position) -> const PartSetting* {
      const auto first = firstOf.find(part);
      if (first == firstOf.end()) return nullptr;
      const size_t i = position < parts.size() && parts[position].id == part ? position : first->second;
      isFound[i] = true;
      return &parts[i];
    };
    for (size_t c = 0; c < object.components.size(); ++c)
      if (const PartSetting* const setting = settingOf(object.components[c].object, c)) {
        object.components[c].role = setting->role;
        object.components[c].name = setting->title;
        models_.charge(setting->title.size());
      }
    if (object.components.empty())
      if (const PartSetting* const setting = settingOf(id, 0)) {
        if (setting->role != PartRole::Material) object.role = setting->role;
        if (!setting->title.empty()) object.name = setting->title;
      }
    for (size_t i = 0; i < parts.size(); ++i)
      if (parts[i].role != PartRole::Material && !isFound[i])
        xml_.fail(fmt::format("{} is not a part of object {}", parts[i].name(), id));
  }

  void readMesh(PartMesh& mesh, std::vector<PartSetting>& ranges) {
    if (!mesh.vertices.empty()) xml_.fail("an object has two meshes");
    forEachChild([&] {
      if (isCore("vertices"))
        forEachChild([&] { isCore("vertex") ? readVertex(mesh) : skipUnknown(); });
      else if (isCore("triangles"))
        forEachChild([&] { isCore("triangle") ? readTriangle(mesh) : skipUnknown(); });
      else if (xml_.name() == "volumes" && spaceHas(xml_.space(), "slic3r"))
        readVolumes(ranges);
      else
        skipUnknown();
    });
  }

  void readVolumes(std::vector<PartSetting>& ranges) {
    while (xml_.next() == XmlReader::Event::Start) {
      if (xml_.name() == "volume") ranges.push_back(slic3rVolume(xml_));
      models_.charge(sizeof(PartSetting));
      xml_.skipElement();
    }
  }

  void readVertex(PartMesh& mesh) {
    models_.charge(sizeof(Vec3d));
    Vec3d p;
    p.x = real(requiredAttribute("x"), "x");
    p.y = real(requiredAttribute("y"), "y");
    p.z = real(requiredAttribute("z"), "z");
    mesh.vertices.push_back(p);
    forEachChild([&] { skipUnknown(); });
  }

  void readTriangle(PartMesh& mesh) {
    constexpr uint64_t kSurveyBytes = 60;  // Memory that weldIfOpen() needs per face.
    models_.charge(sizeof(Face) + kSurveyBytes);
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
    forEachChild([&] { skipUnknown(); });
  }

  /// Joins equal vertices if the mesh is open. Some writers split vertices, which the specification forbids. Faces
  /// without common vertices would have no neighbours.
  static void weldIfOpen(PartMesh& mesh) {
    TriangleMesh view;
    view.vertices = mesh.vertices;
    view.faces = mesh.faces;
    if (mesh.faces.empty() || surveyEdges(view).isManifold) return;
    CornerWelder welder(mesh.vertices.size() / 3);
    for (Face& face : mesh.faces)
      for (uint32_t& corner : face) corner = welder.indexOf(mesh.vertices[corner]);
    mesh.vertices = std::move(welder.points());
  }

  ModelList& models_;
  size_t index_;
  XmlReader& xml_;
};

}  // namespace

void readModel(XmlReader& xml, ModelList& models, size_t index) { ModelReader(models, index, xml).read(); }

}  // namespace asdfvk
