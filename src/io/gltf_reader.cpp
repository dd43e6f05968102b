// glTF 2.0 (Khronos), as .glb or .gltf: the meshes of the default scene, placed by its nodes. The mesh of a node is a
// part with the name of the node, or else of the mesh. Vertices of a part at the same point become one, because glTF
// splits vertices where normals or texture coordinates differ. Positions may have any type of KHR_mesh_quantization.
// The data of a .gltf file may be in a file beside (pathBeside()). The reader ignores materials, textures, cameras and
// animations. Mesh::skipped lists other ignored content.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/text.h"
#include "io/assembled_mesh.h"
#include "io/corner_welder.h"
#include "io/formats.h"
#include "io/glb_writer.h"
#include "io/gltf_file.h"
#include "io/gltf_primitive.h"
#include "io/input_failure.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

/// A node on the path from the root of the scene to the current node.
struct GltfVisit {
  const GltfJson* children = nullptr;  ///< Null if the node has none.
  uint64_t nextChild = 0;
  Placement placement;
  bool isHidden = false;
};

class GltfReader {
 public:
  explicit GltfReader(const MeshSource& source) : source_(source), file_(source) {}

  Mesh read() {
    const uint64_t meshCount = file_.countOf("meshes");
    std::vector<uint64_t> useCounts(meshCount, 0);
    for (uint64_t mesh = 0; mesh < meshCount; ++mesh)
      meshHasWeights_.push_back(hasWeights(file_.item("meshes", mesh, "glTF")) ? 1 : 0);
    forEachInstance([&](uint64_t mesh, const GltfJson&, const Placement&) { ++useCounts[mesh]; });
    uint64_t vertexCount = 0, faceCount = 0;
    for (uint64_t mesh = 0; mesh < meshCount; ++mesh) {
      if (useCounts[mesh] == 0) continue;
      uint64_t vertices = 0, faces = 0;
      const uint64_t primitiveCount = forEachPrimitive(mesh, [&](const GltfPrimitive& primitive) {
        count(primitive, useCounts[mesh]);
        const uint64_t primitiveFaces = std::min(primitive.faceCount(), kSaturatedCount);
        faces = std::min(faces + primitiveFaces, kSaturatedCount);
        vertices = std::min(vertices + primitive.maxVertexCount(), 3 * kSaturatedCount);
      });
      withoutPrimitivesCount_ += primitiveCount == 0 ? useCounts[mesh] : 0;
      vertexCount = std::min(vertexCount + product(vertices, useCounts[mesh]), kSaturatedCount);
      faceCount = std::min(faceCount + product(faces, useCounts[mesh]), kSaturatedCount);
    }
    if (faceCount == 0) failWithoutFaces(meshCount);
    AssembledMesh assembled(vertexCount, faceCount, source_);
    std::vector<std::optional<PartMesh>> parts(meshCount);  // Parts that later nodes may use again.
    forEachInstance([&](uint64_t mesh, const GltfJson& node, const Placement& placement) {
      if (!parts[mesh]) parts[mesh] = partOf(mesh);
      const std::string_view name = nameOf(node);
      assembled.add(*parts[mesh], placement, name.empty() ? nameOf(file_.item("meshes", mesh, "glTF")) : name);
      if (--useCounts[mesh] == 0) parts[mesh].reset();
    });
    Mesh mesh = assembled.finish();
    mesh.unit = "m";
    mesh.skipped = skipped();
    return mesh;
  }

 private:
  static uint64_t product(uint64_t a, uint64_t b) {
    return b != 0 && a > kSaturatedCount / b ? kSaturatedCount : a * b;
  }

  [[noreturn]] void failWithoutFaces(uint64_t meshCount) const {
    std::string found = joined(skipped(), " and ");
    if (found.empty()) found = meshCount == 0 ? "no mesh" : "no mesh in its scene";
    failInput(fmt::format("has {} and no triangle: nothing to compute on", found));
  }

  /// Empty if the item has no name. Names have no effect on the geometry, so that a wrong type is no error.
  static std::string_view nameOf(const GltfJson& item) {
    const auto name = item.find("name");
    return name != item.end() && name->is_string() ? std::string_view(name->get_ref<const std::string&>())
                                                   : std::string_view();
  }

  /// Calls work(mesh, node, placement) for each node with a mesh, depth first, with children in file order.
  template <typename Work>
  void forEachInstance(const Work& work) {
    std::vector<uint8_t> isVisited(file_.countOf("nodes"), 0);
    for (const uint64_t root : rootsOf()) {
      std::vector<GltfVisit> path;
      enter(path, root, GltfVisit{}, isVisited, work);
      while (!path.empty()) {
        GltfVisit& visit = path.back();
        if (visit.children == nullptr || visit.nextChild == visit.children->size()) {
          path.pop_back();
          continue;
        }
        const uint64_t child = indexIn(*visit.children, visit.nextChild++, "children");
        enter(path, child, visit, isVisited, work);
      }
    }
    isFirstPass_ = false;
  }

  template <typename Work>
  void enter(std::vector<GltfVisit>& path, uint64_t index, const GltfVisit& parent, std::vector<uint8_t>& isVisited,
             const Work& work) {
    const std::string where = fmt::format("node {}", index);
    const GltfJson& node = file_.item("nodes", index, "scene");
    if (isVisited[index]++ != 0) failInput(fmt::format("{} has two parents; nodes must form trees", where));
    GltfVisit visit{.children = gltfArray(node, "children", where),
                    .placement = parent.placement.after(placementOf(node, where)),
                    .isHidden = parent.isHidden};
    if (!visit.placement.isFinite()) failInput(fmt::format("{}: its transform overflows", where));
    if (const GltfJson* const visibility = gltfExtension(node, "KHR_node_visibility", where))
      visit.isHidden = visit.isHidden || !gltfFlag(*visibility, "visible", true, where);
    const bool hasMesh = gltfMember(node, "mesh", where) != nullptr;
    if (hasMesh && visit.isHidden) hiddenCount_ += isFirstPass_ ? 1 : 0;
    if (hasMesh && !visit.isHidden) {
      if (gltfExtension(node, "EXT_mesh_gpu_instancing", where) != nullptr)
        failInput(fmt::format("{} has instances by EXT_mesh_gpu_instancing, which is not supported; export without it",
                              where));
      const uint64_t mesh = gltfWhole(node, "mesh", std::nullopt, where);
      (void)file_.item("meshes", mesh, where);
      // The joints determine the place of a mesh with a skin; the node of the mesh has no effect.
      const bool hasSkin = gltfMember(node, "skin", where) != nullptr;
      skinCount_ += isFirstPass_ && hasSkin ? 1 : 0;
      morphCount_ += isFirstPass_ && (meshHasWeights_[mesh] != 0 || hasWeights(node)) ? 1 : 0;
      work(mesh, node, hasSkin ? Placement{} : visit.placement);
    }
    path.push_back(visit);
  }

  /// Whether morph targets change the shape.
  static bool hasWeights(const GltfJson& json) {
    const GltfJson* const weights = gltfArray(json, "weights", "weights");
    return weights != nullptr &&
           std::any_of(weights->begin(), weights->end(), [](const GltfJson& w) { return w != 0; });
  }

  static uint64_t indexIn(const GltfJson& array, uint64_t i, std::string_view where) {
    if (!array[i].is_number_unsigned()) failInput(fmt::format("{}: an entry is not an index", where));
    return array[i].get<uint64_t>();
  }

  /// The roots of the default scene; without scenes, the nodes that are not children.
  std::vector<uint64_t> rootsOf() const {
    std::vector<uint64_t> roots;
    if (file_.countOf("scenes") > 0) {
      const uint64_t scene = gltfWhole(file_.document(), "scene", 0, "glTF");
      const GltfJson* const nodes = gltfArray(file_.item("scenes", scene, "glTF"), "nodes", "scene");
      for (uint64_t i = 0; nodes != nullptr && i < nodes->size(); ++i) roots.push_back(indexIn(*nodes, i, "scene"));
      return roots;
    }
    std::vector<uint8_t> isChild(file_.countOf("nodes"), 0);
    for (uint64_t node = 0; node < isChild.size(); ++node) {
      const std::string where = fmt::format("node {}", node);
      const GltfJson* const children = gltfArray(file_.item("nodes", node, where), "children", where);
      for (uint64_t i = 0; children != nullptr && i < children->size(); ++i)
        if (const uint64_t child = indexIn(*children, i, where); child < isChild.size()) isChild[child] = 1;
    }
    for (uint64_t node = 0; node < isChild.size(); ++node)
      if (isChild[node] == 0) roots.push_back(node);
    if (roots.empty() && !isChild.empty()) failInput("every node is a child of another; nodes must form trees");
    return roots;
  }

  static Placement placementOf(const GltfJson& node, std::string_view where) {
    Placement placement;
    std::array<double, 16> matrix{};
    if (gltfNumbers(node, "matrix", matrix, where)) {
      for (size_t column = 0; column < 3; ++column)
        placement.columns[column] = {matrix[4 * column], matrix[4 * column + 1], matrix[4 * column + 2]};
      placement.translation = {matrix[12], matrix[13], matrix[14]};
      if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1)
        failInput(fmt::format("{}: the last row of its matrix is not 0 0 0 1", where));
      return placement;
    }
    std::array<double, 3> translation{}, scale{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};
    (void)gltfNumbers(node, "translation", translation, where);
    (void)gltfNumbers(node, "scale", scale, where);
    (void)gltfNumbers(node, "rotation", q, where);
    const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(norm > 0) || !std::isfinite(norm))
      failInput(fmt::format("{}: its rotation is not a valid quaternion", where));
    const auto [x, y, z, w] = q;
    const double s = 2 / norm;
    placement.columns = {Vec3d{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)} * scale[0],
                         Vec3d{s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)} * scale[1],
                         Vec3d{s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)} * scale[2]};
    placement.translation = {translation[0], translation[1], translation[2]};
    return placement;
  }

  /// Returns the number of primitives.
  template <typename Work>
  uint64_t forEachPrimitive(uint64_t mesh, const Work& work) {
    const std::string where = fmt::format("mesh {}", mesh);
    const GltfJson* const primitives = gltfArray(file_.item("meshes", mesh, where), "primitives", where);
    const uint64_t primitiveCount = primitives == nullptr ? 0 : primitives->size();
    for (uint64_t i = 0; i < primitiveCount; ++i)
      work(GltfPrimitive(file_, (*primitives)[i], fmt::format("{}, primitive {}", where, i)));
    return primitiveCount;
  }

  void count(const GltfPrimitive& primitive, uint64_t uses) {
    const uint64_t corners = primitive.cornerCount(), mode = primitive.mode();
    if (!primitive.hasPositions()) {
      withoutPositionsCount_ += uses;
    } else if (primitive.isEmpty()) {
      emptyCount_ += uses;
    } else {
      if (mode == kGltfPoints) pointCount_ += product(corners, uses);
      if (mode == kGltfLines) lineCount_ += product(corners / 2, uses);
      if (mode > kGltfLines && mode <= kGltfLineStrip) lineCount_ += product(corners, uses);
    }
  }

  PartMesh partOf(uint64_t mesh) {
    PartMesh part;
    CornerWelder welder(0);
    forEachPrimitive(
        mesh, [&](const GltfPrimitive& primitive) { lackingCount_ += primitive.addTo(part.faces, welder, source_); });
    part.vertices = std::move(welder.points());
    return part;
  }

  std::vector<std::string> skipped() const {
    std::vector<std::string> texts;
    const auto add = [&](uint64_t count, std::string_view one, std::string_view many) {
      if (count > 0) texts.push_back(counted(count, one, many));
    };
    add(file_.unusedByteCount(), "byte after the end of a buffer", "bytes after the end of a buffer");
    add(file_.trailingByteCount(), "byte after the end", "bytes after the end");
    add(pointCount_, "point", "points");
    add(lineCount_, "line", "lines");
    add(withoutPositionsCount_, "primitive without positions", "primitives without positions");
    add(emptyCount_, "primitive without vertices", "primitives without vertices");
    add(withoutPrimitivesCount_, "mesh without primitives", "meshes without primitives");
    add(lackingCount_, "triangle that its Draco data lacks", "triangles that their Draco data lacks");
    add(hiddenCount_, "hidden node", "hidden nodes");
    add(skinCount_, "pose of a skin", "poses of skins");
    add(morphCount_, "blend of morph targets", "blends of morph targets");
    const uint64_t scenes = file_.countOf("scenes");
    add(scenes > 1 ? scenes - 1 : 0, "further scene", "further scenes");
    return texts;
  }

  const MeshSource& source_;
  GltfFile file_;
  bool isFirstPass_ = true;
  std::vector<uint8_t> meshHasWeights_;
  uint64_t pointCount_ = 0, lineCount_ = 0, withoutPositionsCount_ = 0, emptyCount_ = 0, withoutPrimitivesCount_ = 0;
  uint64_t lackingCount_ = 0, hiddenCount_ = 0, skinCount_ = 0, morphCount_ = 0;
};

Match detectGltf(std::span<const char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  if (text.starts_with("glTF")) return Match::Certain;
  return firstWord(bytes).starts_with('{') ? Match::Possible : Match::None;
}

Mesh parseGltf(const MeshSource& source) { return GltfReader(source).read(); }

}  // namespace

extern const FileFormat kGlbFormat{
    .name = "glb", .extensions = {"glb", "gltf"}, .detect = detectGltf, .parseMesh = parseGltf, .write = writeGlb};

}  // namespace asdfvk
