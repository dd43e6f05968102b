// Binary glTF 2.0. Each corner of each triangle has its own vertex, because the fields belong to faces and viewers show
// faces flat. Without parts there is one primitive, whose COLOR_0 shows the field. With the field "segment" each part
// is a primitive with a material, in the order of the part numbers. There is then no COLOR_0, because viewers multiply
// COLOR_0 with the colour of the material. Blender ignores the colours of materials if COLOR_0 exists. The fields are
// attributes _NAME in float32, 0 for no value. If triangles are not in the order of input faces, the attribute _FACE
// has the input face; this attribute is exact up to 16,777,216.
#include "io/glb_writer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/box3.h"
#include "core/json.h"
#include "core/length_unit.h"
#include "core/text.h"
#include "io/field_columns.h"
#include "io/formats.h"
#include "io/result_colours.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

constexpr uint32_t kFloatComponent = 5126, kShortComponent = 5123;

/// The triangles of a result, and their input faces.
class ResultTriangles {
 public:
  explicit ResultTriangles(const ResultView& result) {
    vertices_.reserve(result.vertexCount());
    for (uint64_t vertex = 0; vertex < result.vertexCount(); ++vertex) {
      const auto [x, y, z] = result.pointAt<double>(vertex);
      vertices_.push_back({x, y, z});
    }
    bool hasTriangles = false;
    for (uint64_t face = 0; face < result.faceCount(); ++face)
      hasTriangles = hasTriangles || result.cornersOf(face).size() >= 3;
    if (!hasTriangles) return;
    InputFaces faces;
    faces.reserve(result.faceCount());
    for (uint64_t face = 0; face < result.faceCount(); ++face) faces.add(result.cornersOf(face));
    faces.moveTo(vertices_, mesh_);
  }
  [[nodiscard]] TriangleMesh view() const {
    TriangleMesh mesh = mesh_;
    mesh.vertices = vertices_;
    return mesh;
  }

 private:
  std::vector<Vec3d> vertices_;
  Mesh mesh_;
};

struct GlbGroup {
  uint32_t part = 0;
  uint64_t begin = 0, end = 0;  ///< Range in GlbWriter::order_.
};

/// A vertex attribute: `components` numbers of a type, and a function that writes them for a corner.
struct GlbAttribute {
  std::string name;
  uint32_t componentType = kFloatComponent;
  uint32_t componentCount = 1;
  bool isNormalized = false;
  std::function<void(uint32_t triangle, uint32_t corner)> put;

  [[nodiscard]] uint64_t elementSize() const {
    return uint64_t{componentCount} * (componentType == kFloatComponent ? 4 : componentType == kShortComponent ? 2 : 1);
  }
};

std::string upperCase(std::string_view text) {
  std::string upper;
  for (const char c : text) upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

class GlbWriter {
 public:
  GlbWriter(AtomicFile& file, const ResultView& result)
      : file_(file), result_(result), triangles_(result), mesh_(triangles_.view()) {
    if (mesh_.faces.empty()) return;  // glTF has no empty mesh, so the file has an empty scene.
    groupByPart();
    placeAtOrigin();
    addAttributes();
  }

  void write() {
    const uint64_t cornerCount = uint64_t{3} * mesh_.faceCount();
    uint64_t binarySize = 0;
    for (const GlbAttribute& attribute : attributes_) binarySize += cornerCount * attribute.elementSize();
    std::string json = document(binarySize).dump();
    json.append((4 - json.size() % 4) % 4, ' ');
    const uint64_t size = 12 + 8 + json.size() + (binarySize > 0 ? 8 + binarySize : 0);
    if (size > std::numeric_limits<uint32_t>::max())
      throw Error(ErrorCode::OutputNotWritable,
                  fmt::format("the result needs {} MiB, but a GLB file has at most 4096; write .ply, or fewer fields",
                              size >> 20));
    file_.write("glTF");
    file_.put(uint32_t{2});
    file_.put(static_cast<uint32_t>(size));
    file_.put(static_cast<uint32_t>(json.size()));
    file_.write("JSON");
    file_.write(json);
    if (binarySize == 0) return;
    file_.put(static_cast<uint32_t>(binarySize));
    file_.write(std::string_view("BIN\0", 4));
    for (const GlbAttribute& attribute : attributes_)
      for (const uint32_t triangle : order_)
        for (uint32_t corner = 0; corner < 3; ++corner) attribute.put(triangle, corner);
  }

 private:
  void groupByPart() {
    order_.resize(mesh_.faceCount());
    std::iota(order_.begin(), order_.end(), 0u);
    parts_ = result_.parts();
    if (parts_ == nullptr) {
      groups_.push_back({0, 0, order_.size()});
      return;
    }
    const auto partOf = [&](uint32_t triangle) { return (*parts_)[mesh_.inputFaceOf(triangle)]; };
    std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return partOf(a) < partOf(b); });
    for (uint64_t i = 0; i < order_.size(); ++i) {
      if (i == 0 || partOf(order_[i]) != groups_.back().part) groups_.push_back({partOf(order_[i]), i, i});
      groups_.back().end = i + 1;
    }
  }

  /// Makes coordinates relative to the middle of the mesh if float32 does not represent them exactly.
  void placeAtOrigin() {
    Box3d box;
    for (const Vec3d& p : mesh_.vertices)
      if (isFinite(p)) box.add(p);
    middle_ = box.centre();
    if (!result_.hasFloatVertices()) origin_ = middle_;
  }

  /// A triangle with a non-finite corner, which glTF does not allow, collapses to a point.
  [[nodiscard]] Vec3f pointOf(uint32_t triangle, uint32_t corner) const {
    const bool isWhole = mesh_.hasFiniteCorners(triangle);
    return static_cast<Vec3f>((isWhole ? mesh_.vertices[mesh_.faces[triangle][corner]] : middle_) - origin_);
  }

  void addColours(const char* name, const Field& field) {
    std::vector<std::array<uint16_t, 3>> linear;
    for (const Rgba& colour : coloursOf(field)) {
      std::array<uint16_t, 3>& to = linear.emplace_back();
      const std::array<double, 3> shares = linearColour(colour);
      for (size_t channel = 0; channel < 3; ++channel)
        to[channel] = static_cast<uint16_t>(std::lround(65535 * shares[channel]));
    }
    attributes_.push_back({name, kShortComponent, 4, true, [this, &field, colours = std::move(linear)](auto t, auto c) {
                             for (const uint16_t channel : colours[itemOf(field, t, c)]) file_.put(channel);
                             file_.put(std::numeric_limits<uint16_t>::max());
                           }});
  }

  [[nodiscard]] uint64_t itemOf(const Field& field, uint32_t triangle, uint32_t corner) const {
    return field.location == FieldLocation::PerVertex ? mesh_.faces[triangle][corner] : mesh_.inputFaceOf(triangle);
  }

  void addAttributes() {
    attributes_.push_back({"POSITION", kFloatComponent, 3, false, [this](uint32_t triangle, uint32_t corner) {
                             const Vec3f p = pointOf(triangle, corner);
                             for (size_t axis = 0; axis < 3; ++axis) file_.put(p[axis]);
                           }});
    const Field* const shown = result_.shownField();
    materialsShowParts_ = parts_ != nullptr && shown != nullptr && shown->name == "segment";
    if (shown != nullptr && !materialsShowParts_) addColours("COLOR_0", *shown);
    for (const Field& field : result_.fields()) {
      const bool isSecond = field.location == FieldLocation::PerVertex &&
                            std::any_of(result_.fields().begin(), result_.fields().end(), [&](const Field& other) {
                              return other.name == field.name && other.location == FieldLocation::PerFace;
                            });
      attributes_.push_back({(isSecond ? "_VERTEX_" : "_") + upperCase(field.name), kFloatComponent,
                             field.componentCount, false, [this, &field](uint32_t triangle, uint32_t corner) {
                               const uint64_t item = itemOf(field, triangle, corner);
                               for (uint32_t i = 0; i < field.componentCount; ++i)
                                 file_.put(withoutNan(field.at(item * field.componentCount + i)));
                             }});
    }
    if (parts_ != nullptr || !mesh_.polygons.isEmpty())
      attributes_.push_back({"_FACE", kFloatComponent, 1, false, [this](uint32_t triangle, uint32_t) {
                               file_.put(static_cast<float>(mesh_.inputFaceOf(triangle)));
                             }});
  }

  /// The bounding box of a group, in the coordinates of the file.
  [[nodiscard]] Box3f boxOf(const GlbGroup& group) const {
    Box3f box;
    for (uint64_t i = group.begin; i < group.end; ++i)
      for (uint32_t corner = 0; corner < 3; ++corner) box.add(pointOf(order_[i], corner));
    return box;
  }

  [[nodiscard]] Json materialOf(const GlbGroup& group, const Field* shown) const {
    Json factor = {1, 1, 1, 1};
    if (materialsShowParts_) {
      const std::array<double, 3> colour = linearColour(colourOfPart(group.part));
      for (size_t channel = 0; channel < 3; ++channel) factor[channel] = colour[channel];
    }
    const std::string name = parts_ != nullptr ? nameOfPart(group.part) : shown != nullptr ? shown->name : "mesh";
    return {{"name", name},
            {"doubleSided", true},
            {"pbrMetallicRoughness", {{"baseColorFactor", factor}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
  }

  [[nodiscard]] Json nodeOf() const {
    Json node = {{"name", "asdf-vk"}, {"mesh", 0}};
    const Mesh* const source = result_.mesh().mesh();
    const LengthUnitRow* const unit = source == nullptr ? nullptr : findLengthUnit(source->unit);
    const double scale = unit == nullptr ? 1 : unit->micrometres / 1e6;  // The unit of glTF is the metre.
    if (origin_ != Vec3d{}) node["translation"] = {origin_.x * scale, origin_.y * scale, origin_.z * scale};
    if (scale != 1) node["scale"] = {scale, scale, scale};
    return node;
  }

  [[nodiscard]] Json document(uint64_t binarySize) const {
    if (mesh_.faces.empty()) return {{"asset", {{"version", "2.0"}, {"generator", "asdf-vk"}}}};
    Json views = Json::array(), accessors = Json::array(), primitives = Json::array(), materials = Json::array();
    uint64_t offset = 0;
    for (const GlbAttribute& attribute : attributes_) {
      const uint64_t size = uint64_t{3} * mesh_.faceCount() * attribute.elementSize();
      views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", 34962}});
      offset += size;
    }
    for (const GlbGroup& group : groups_) {
      Json attributes = Json::object();
      for (size_t i = 0; i < attributes_.size(); ++i) {
        const GlbAttribute& attribute = attributes_[i];
        attributes[attribute.name] = accessors.size();
        Json accessor = {{"bufferView", i},
                         {"byteOffset", 3 * group.begin * attribute.elementSize()},
                         {"componentType", attribute.componentType},
                         {"count", 3 * (group.end - group.begin)},
                         {"type", attribute.componentCount == 1   ? "SCALAR"
                                  : attribute.componentCount == 3 ? "VEC3"
                                                                  : "VEC4"}};
        if (attribute.isNormalized) accessor["normalized"] = true;
        if (i == 0) {
          const Box3f box = boxOf(group);
          accessor["min"] = arrayOf(static_cast<Vec3d>(box.min));
          accessor["max"] = arrayOf(static_cast<Vec3d>(box.max));
        }
        accessors.push_back(std::move(accessor));
      }
      primitives.push_back({{"attributes", std::move(attributes)}, {"material", materials.size()}});
      materials.push_back(materialOf(group, result_.shownField()));
    }
    return {{"asset", {{"version", "2.0"}, {"generator", "asdf-vk"}}},
            {"scene", 0},
            {"scenes", Json::array({{{"nodes", {0}}}})},
            {"nodes", Json::array({nodeOf()})},
            {"meshes", Json::array({{{"name", "asdf-vk"}, {"primitives", std::move(primitives)}}})},
            {"materials", std::move(materials)},
            {"accessors", std::move(accessors)},
            {"bufferViews", std::move(views)},
            {"buffers", Json::array({{{"byteLength", binarySize}}})}};
  }

  AtomicFile& file_;
  const ResultView& result_;
  ResultTriangles triangles_;
  TriangleMesh mesh_;
  const std::vector<uint32_t>* parts_ = nullptr;
  bool materialsShowParts_ = false;
  std::vector<uint32_t> order_;  ///< The triangles in the order of the file.
  std::vector<GlbGroup> groups_;
  std::vector<GlbAttribute> attributes_;
  Vec3d middle_, origin_;
};

}  // namespace

void writeGlb(AtomicFile& file, const ResultView& result) { GlbWriter(file, result).write(); }

}  // namespace asdfvk
