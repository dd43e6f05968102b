#include "cli/other_meshes.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <optional>
#include <utility>
#include <variant>

#include "asdf_vk/scene.h"
#include "cli/loaded_mesh.h"
#include "core/length_unit.h"
#include "core/stopwatch.h"

namespace asdfvk {
namespace {

std::string nameOfFile(const std::string& path) {
  return path == "-" ? "standard input" : std::filesystem::path(path).stem().string();
}

/// Reads other meshes, and gives the mesh their unit if it states none.
std::vector<Mesh> readOthers(Mesh& mesh, const std::string& name, const std::vector<std::string>& paths,
                             const ReadOptions& reading, const RunControl& control) {
  std::vector<Mesh> others;
  const std::string* withUnit = &name;
  for (const std::string& path : paths) {
    LoadedMesh loaded = loadMesh(path, reading, false, control.stop);
    if (loaded.failure) std::rethrow_exception(loaded.failure);
    std::string unit = commonUnit(mesh.unit, loaded.mesh.unit, *withUnit, path);
    if (unit != mesh.unit) withUnit = &path;
    mesh.unit = std::move(unit);
    others.push_back(std::move(loaded.mesh));
  }
  return others;
}

Mesh joinedWith(const Mesh& mesh, const std::string& name, const std::vector<Mesh>& others,
                const std::vector<std::string>& paths) {
  std::vector<const Mesh*> meshes{&mesh};
  std::vector<std::string> names{nameOfFile(name)};
  for (const Mesh& other : others) meshes.push_back(&other);
  for (const std::string& path : paths) names.push_back(nameOfFile(path));
  return joinMeshes(meshes, names);
}

}  // namespace

ComputedMesh computeAmong(Session& session, Mesh& mesh, const std::string& name, const OtherMeshes& others,
                          const ReadOptions& reading, const CheckedOptions& options, const RunControl& control) {
  ComputedMesh computed;
  const Stopwatch watch;
  const bool isComparison = !others.former.empty();
  const std::vector<Mesh> read =
      readOthers(mesh, name, isComparison ? std::vector{others.former} : others.with, reading, control);
  std::vector<uint8_t> region;
  if (!isComparison) {
    for (const Mesh& other : read) computed.faceCounts.push_back(other.inputFaceCount());
    computed.joined = joinedWith(mesh, name, read, others.with);
    region.assign(computed.joined.inputFaceCount(), 0);
    std::fill_n(region.begin(), mesh.inputFaceCount(), uint8_t{1});
  }
  const double readSeconds = watch.seconds();
  Scene scene(session, isComparison ? mesh : computed.joined, options->orientation, control.withoutProgress());
  std::optional<Scene> former;
  if (isComparison) former.emplace(session, read.front(), options->orientation, control.withoutProgress());
  computed.result = former ? scene.compare(*former, options, {}, control) : scene.compute(options, region, control);
  StageSeconds& seconds = computed.result.report.stageSeconds;
  seconds[Stage::Read] += readSeconds;
  seconds += scene.preparationSeconds();
  if (former) seconds += former->preparationSeconds();
  return computed;
}

void numberFacesByFile(Report& report, uint64_t faceCount, const std::vector<uint64_t>& others) {
  for (std::optional<ThicknessReport>* const measured : {&report.thickness, &report.gap}) {
    if (!*measured) continue;
    for (UnjudgedReason& reason : (*measured)->unjudged.reasons) {
      uint64_t count = faceCount;
      for (size_t i = 0; reason.face >= count && i < others.size(); count = others[i++]) reason.face -= count;
    }
  }
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
