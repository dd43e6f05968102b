#include "io/threemf_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/corner_welder.h"
#include "io/input_failure.h"
#include "mesh/dual_graph.h"

namespace asdfvk {
namespace {

constexpr std::string_view kCoreNamespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

constexpr std::array<ModelUnit, 6> kModelUnits{
    {{"millimeter", "mm"}, {"micron", "um"}, {"centimeter", "cm"}, {"meter", "m"}, {"inch", "in"}, {"foot", "ft"}}};

class ModelReader {
 public:
  ModelReader(ModelList& models, size_t index, XmlScanner& xml) : models_(models), index_(index), xml_(xml) {}

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
  ModelFile& model() { return models_.model(index_); }
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
        std::find_if(kModelUnits.begin(), kModelUnits.end(), [&](const ModelUnit& r) { return r.name == unit; });
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
      read.model = models_.indexAt(*decoded);
    }
    models_.charge(sizeof(ObjectUse));
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
    models_.charge(sizeof(ModelObject) + 64);
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
        if (xml_.name().ends_with("beamlattice")) models_.countLattice();
        xml_.skipElement();
      }
    });
  }

  void readVertex(PartMesh& mesh) {
    models_.charge(sizeof(Vec3d));
    Vec3d p;
    p.x = real(requiredAttribute("x"), "x");
    p.y = real(requiredAttribute("y"), "y");
    p.z = real(requiredAttribute("z"), "z");
    mesh.vertices.push_back(p);
    xml_.skipElement();
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
    xml_.skipElement();
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
  XmlScanner& xml_;
  std::vector<std::string> corePrefixes_;  ///< Each with its colon; "" for the default namespace.
  std::string pathAttribute_;
  std::map<std::string, std::string> namespaces_;
};

}  // namespace

void ModelList::charge(uint64_t bytes) {
  chargedBytes_ += bytes;
  if (chargedBytes_ > limitBytes_)
    throw Error(ErrorCode::InputTooLarge, fmt::format("its mesh needs more than {} MiB of memory", limitBytes_ >> 20));
}

size_t ModelList::indexAt(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  const auto [known, isNew] = indexOf_.emplace(path, models_.size());
  if (!isNew) return known->second;
  constexpr size_t kMaxModels = 4096;
  if (models_.size() == kMaxModels) failInput(fmt::format("more than {} model files", kMaxModels));
  charge(sizeof(ModelFile) + 128 + path.size());
  models_.push_back({.path = std::string(path), .unit = kModelUnits.data()});
  return models_.size() - 1;
}

void readModel(XmlScanner& xml, ModelList& models, size_t index) { ModelReader(models, index, xml).read(); }

}  // namespace asdfvk
