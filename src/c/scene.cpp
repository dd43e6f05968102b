#include "asdf_vk/files.h"
#include "asdf_vk/version.h"
#include "c/call_guard.h"
#include "c/handle_types.h"
#include "c/handles.h"
#include "c/options.h"
#include "core/length_unit.h"
#include "core/text.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk::c {
namespace {

/// Exclusive use of a session, with the thread limit of the session.
class SessionUse {
 public:
  explicit SessionUse(asdf_vk_session& session)
      : session_(session), lock_(lockFor(session)), limit_(session.settings.threadCount) {
    session.isBusy = true;
    ++useCount_;
  }
  ~SessionUse() {
    --useCount_;
    session_.isBusy = false;
    std::list<Scene> released;
    const std::scoped_lock lock(session_.releasedMutex);
    released.swap(session_.released);
  }
  SessionUse(const SessionUse&) = delete;
  SessionUse& operator=(const SessionUse&) = delete;

 private:
  /// A thread that uses a session does not wait for another one, because two such threads could wait for each other.
  static std::unique_lock<std::recursive_mutex> lockFor(asdf_vk_session& session) {
    if (useCount_ == 0) return std::unique_lock(session.mutex);
    std::unique_lock lock(session.mutex, std::try_to_lock);
    if (!lock || session.isBusy)
      throw Error(ErrorCode::InvalidArgument,
                  "a progress function must not compute on a session in use; give it a session of its own");
    return lock;
  }

  static thread_local uint32_t useCount_;  ///< Sessions that this thread uses, in progress functions within each other.
  asdf_vk_session& session_;
  std::unique_lock<std::recursive_mutex> lock_;
  ThreadLimit limit_;
};

thread_local uint32_t SessionUse::useCount_ = 0;

/// Prepares the scene if necessary and returns it. isNew: set to true if the scene was prepared. Precondition: this
/// thread has a SessionUse of the scene's session.
Scene& preparedScene(asdf_vk_scene& scene, Orientation orientation, const RunControl& control, bool* isNew = nullptr) {
  if (scene.prepared.empty() || scene.orientation != orientation) {
    if (isNew != nullptr) *isNew = true;
    scene.prepared.clear();
    scene.prepared.emplace_back(*scene.session->session, *scene.mesh, orientation, control);
    scene.orientation = orientation;
  }
  return scene.prepared.front();
}

template <typename T>
std::span<const T> spanOf(const void* numbers, uint64_t count, const char* name) {
  if (count > 0) requireArgument(numbers, name);
  return {static_cast<const T*>(numbers), count};
}

MeshView viewOf(const void* vertices, int vertexType, uint64_t vertexCount, std::span<const uint32_t> corners,
                std::span<const uint64_t> firstCorner) {
  requireAtMost(kMaxIndexCount, vertexCount, "vertices");
  if (vertexType == ASDF_VK_FLOAT32)
    return {spanOf<float>(vertices, 3 * vertexCount, "the vertices"), corners, firstCorner};
  if (vertexType == ASDF_VK_FLOAT64)
    return {spanOf<double>(vertices, 3 * vertexCount, "the vertices"), corners, firstCorner};
  throw Error(ErrorCode::ArrayType, "the type of the vertices is neither FLOAT64 nor FLOAT32");
}

Mesh meshOf(const MeshView& view, const char* unit) {
  Mesh mesh;
  const TriangleMesh triangles = trianglesOf(view, mesh);
  if (mesh.vertices.empty()) mesh.vertices.assign(triangles.vertices.begin(), triangles.vertices.end());
  if (mesh.faces.empty()) mesh.faces.assign(triangles.faces.begin(), triangles.faces.end());
  if (unit != nullptr) mesh.unit = unit;
  if (!mesh.unit.empty() && findLengthUnit(mesh.unit) == nullptr)
    throw Error(ErrorCode::UnknownName, "'" + mesh.unit + "' is not a unit; give um, mm, cm, m, in or ft");
  return mesh;
}

void requireIndexType(int type) {
  if (type != ASDF_VK_UINT32 && type != ASDF_VK_INT32)
    throw Error(ErrorCode::ArrayType, "the type of the corners is neither UINT32 nor INT32");
}

void addScene(std::shared_ptr<asdf_vk_session> session, Mesh mesh, asdf_vk_scene** scene) {
  *scene = handles<asdf_vk_scene>().add(std::make_shared<asdf_vk_scene>(std::move(session), std::move(mesh)));
}

/// former: the former version for a comparison, or null.
void computeScene(const std::shared_ptr<asdf_vk_scene>& scene, asdf_vk_scene* former, const asdf_vk_options* options,
                  const RunControl& control, asdf_vk_result** result) {
  requireArgument(result, "the output");
  auto object = std::make_shared<asdf_vk_result>();
  object->mesh = scene->mesh;
  object->computation = computationSettings(options, former != nullptr);
  object->session = scene->session->settings;
  const CheckedOptions computed = object->computation.checked();
  const SessionUse use(*scene->session);
  StageSeconds preparation;
  const auto prepare = [&](asdf_vk_scene& each) -> Scene& {
    bool isNew = false;
    Scene& prepared = preparedScene(each, computed->orientation, control, &isNew);
    if (isNew) preparation += prepared.preparationSeconds();
    return prepared;
  };
  Scene& prepared = prepare(*scene);
  object->result = former != nullptr ? prepared.compare(prepare(*former), computed, {}, control)
                                     : prepared.compute(computed, {}, control);
  object->result.report.stageSeconds += preparation;
  *result = handles<asdf_vk_result>().add(std::move(object));
}

}  // namespace
}  // namespace asdfvk::c

using namespace asdfvk;     // NOLINT: the functions of C have no namespace.
using namespace asdfvk::c;  // NOLINT

extern "C" {

int asdf_vk_abi(void) { return ASDF_VK_ABI; }
const char* asdf_vk_version(void) { return ASDFVK_VERSION; }
int asdf_vk_version_number(void) {
  return 10000 * ASDFVK_VERSION_MAJOR + 100 * ASDFVK_VERSION_MINOR + ASDFVK_VERSION_PATCH;
}

asdf_vk_status asdf_vk_session_create(const asdf_vk_options* options, asdf_vk_session** session) {
  return guarded([&] {
    requireArgument(session, "the output");
    auto object = std::make_shared<asdf_vk_session>();
    object->settings = sessionSettings(options);
    const ThreadLimit limit(object->settings.threadCount);
    object->session = std::make_unique<Session>(object->settings);
    object->device = joined(object->session->deviceLines(), "\n");
    *session = handles<asdf_vk_session>().add(std::move(object));
  });
}

asdf_vk_status asdf_vk_session_device(const asdf_vk_session* session, const char** text) {
  return guarded([&] {
    requireArgument(text, "the output");
    *text = handles<asdf_vk_session>().get(session)->device.c_str();
  });
}

void asdf_vk_session_destroy(asdf_vk_session* session) { handles<asdf_vk_session>().destroy(session); }

asdf_vk_status asdf_vk_scene_create(asdf_vk_session* session, const void* vertices, asdf_vk_type vertexType,
                                    size_t vertexCount, const void* corners, asdf_vk_type cornerType, size_t faceCount,
                                    const char* unit, asdf_vk_scene** scene) {
  return guarded([&] {
    requireArgument(scene, "the output");
    auto used = handles<asdf_vk_session>().get(session);
    requireIndexType(numberOf(cornerType));
    requireAtMost(kMaxTriangleCount, faceCount, "faces");
    const auto indices = spanOf<uint32_t>(corners, 3 * uint64_t{faceCount}, "the corners");
    addScene(std::move(used), meshOf(viewOf(vertices, numberOf(vertexType), vertexCount, indices, {}), unit), scene);
  });
}

asdf_vk_status asdf_vk_scene_create_polygons(asdf_vk_session* session, const void* vertices, asdf_vk_type vertexType,
                                             size_t vertexCount, const void* corners, asdf_vk_type cornerType,
                                             const uint64_t* firstCorner, size_t faceCount, const char* unit,
                                             asdf_vk_scene** scene) {
  return guarded([&] {
    requireArgument(scene, "the output");
    auto used = handles<asdf_vk_session>().get(session);
    requireIndexType(numberOf(cornerType));
    requireAtMost(kMaxIndexCount, faceCount, "faces");
    const auto first = spanOf<uint64_t>(firstCorner, uint64_t{faceCount} + 1, "first_corner");
    requireAtMost(kMaxIndexCount, first.back(), "corners");
    const auto indices = spanOf<uint32_t>(corners, first.back(), "the corners");
    addScene(std::move(used), meshOf(viewOf(vertices, numberOf(vertexType), vertexCount, indices, first), unit), scene);
  });
}

asdf_vk_status asdf_vk_scene_read(asdf_vk_session* session, const char* path, asdf_vk_scene** scene) {
  return guarded([&] {
    requireArgument(scene, "the output");
    auto used = handles<asdf_vk_session>().get(session);
    requireArgument(path, "the path");
    addScene(std::move(used), readMesh(path), scene);
  });
}

asdf_vk_status asdf_vk_scene_mesh(const asdf_vk_scene* scene, asdf_vk_mesh* mesh) {
  return guarded([&] {
    requireArgument(mesh, "the output");
    const Mesh& own = *handles<asdf_vk_scene>().get(scene)->mesh;
    const std::vector<uint32_t>& faceOf = own.polygons.inputFaceOf;
    *mesh = {&own.vertices.data()->x,
             own.vertices.size(),
             own.faces.data()->data(),
             own.faces.size(),
             faceOf.empty() ? nullptr : faceOf.data(),
             own.inputFaceCount(),
             own.unit.c_str()};
  });
}

void asdf_vk_scene_destroy(asdf_vk_scene* scene) { handles<asdf_vk_scene>().destroy(scene); }

asdf_vk_status asdf_vk_compute(asdf_vk_scene* scene, const asdf_vk_options* options, asdf_vk_progress progress,
                               void* user, asdf_vk_result** result) {
  ProgressCall call(progress, user);
  return guarded([&] { computeScene(handles<asdf_vk_scene>().get(scene), nullptr, options, call.control(), result); });
}

asdf_vk_status asdf_vk_compare(asdf_vk_scene* scene, asdf_vk_scene* former, const asdf_vk_options* options,
                               asdf_vk_progress progress, void* user, asdf_vk_result** result) {
  ProgressCall call(progress, user);
  return guarded([&] {
    const auto used = handles<asdf_vk_scene>().get(scene), other = handles<asdf_vk_scene>().get(former);
    if (used->session != other->session)
      throw Error(ErrorCode::InvalidArgument, "the scenes are of different sessions; create both on one session");
    computeScene(used, other.get(), options, call.control(), result);
  });
}

asdf_vk_status asdf_vk_values_at(asdf_vk_scene* scene, const asdf_vk_options* options, const double* points,
                                 const double* normals, size_t pointCount, double* values, asdf_vk_progress progress,
                                 void* user) {
  ProgressCall call(progress, user);
  return guarded([&] {
    const auto used = handles<asdf_vk_scene>().get(scene);
    requireAtMost(kMaxIndexCount, pointCount, "points");
    const auto places = spanOf<double>(points, 3 * uint64_t{pointCount}, "the points");
    const auto axes = spanOf<double>(normals, 3 * uint64_t{pointCount}, "the normals");
    if (pointCount > 0) requireArgument(values, "the output");
    const Options given = pointOptions(options);
    const RunControl control = call.control();
    const SessionUse use(*used->session);
    Scene& prepared = preparedScene(*used, given.orientation, control);
    const std::vector<double> found = given.measure == Measure::Thickness
                                          ? prepared.thicknessAt(places, axes, given.thickness, control)
                                          : prepared.valuesAt(places, axes, given.cone, control);
    std::copy(found.begin(), found.end(), values);
  });
}

}  // extern "C"
