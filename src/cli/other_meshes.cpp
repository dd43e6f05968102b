#include "cli/other_meshes.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <variant>

#include "asdf_vk/scene.h"
#include "core/stopwatch.h"

namespace asdfvk {
namespace {

std::string nameOfFile(const std::string& path) {
  return path == "-" ? "standard input" : std::filesystem::path(path).stem().string();
}

Mesh joinedWith(const Mesh& mesh, const std::string& name, const std::vector<std::string>& with,
                const ReadOptions& reading) {
  std::vector<Mesh> others;
  std::vector<std::string> names{nameOfFile(name)};
  for (const std::string& path : with) {
    others.push_back(readMesh(path, reading));
    names.push_back(nameOfFile(path));
  }
  std::vector<const Mesh*> meshes{&mesh};
  for (const Mesh& other : others) meshes.push_back(&other);
  return joinMeshes(meshes, names);
}

}  // namespace

ComputedMesh computeAmong(Session& session, const Mesh& mesh, const std::string& name, const OtherMeshes& others,
                          const ReadOptions& reading, const Options& options, const RunControl& control) {
  ComputedMesh computed;
  const Stopwatch watch;
  if (!others.with.empty()) computed.joined = joinedWith(mesh, name, others.with, reading);
  Mesh former;
  if (!others.former.empty()) former = readMesh(others.former, reading);
  const double readSeconds = watch.seconds();
  const Mesh& whole = others.with.empty() ? mesh : computed.joined;
  std::vector<uint8_t> region;
  if (!others.with.empty()) {
    region.assign(whole.inputFaceCount(), 0);
    std::fill_n(region.begin(), mesh.inputFaceCount(), uint8_t{1});
  }
  Scene scene(session, whole, options.orientation, control.withoutProgress());
  std::optional<Scene> formerScene;
  if (!others.former.empty()) formerScene.emplace(session, former, options.orientation, control.withoutProgress());
  computed.result =
      formerScene ? scene.compare(*formerScene, options, region, control) : scene.compute(options, region, control);
  StageSeconds& seconds = computed.result.report.stageSeconds;
  seconds[Stage::Read] += readSeconds;
  seconds += scene.preparationSeconds();
  if (formerScene) seconds += formerScene->preparationSeconds();
  return computed;
}

std::vector<Field> fieldsOfMesh(const Mesh& mesh, const std::vector<Field>& fields) {
  std::vector<Field> ofMesh = fields;
  for (Field& field : ofMesh) {
    const size_t count = field.location == FieldLocation::PerVertex ? mesh.vertices.size() : mesh.inputFaceCount();
    std::visit([&](auto& values) { values.resize(count * field.componentCount); }, field.values);
  }
  return ofMesh;
}

}  // namespace asdfvk
