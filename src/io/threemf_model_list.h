#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/assembled_mesh.h"
#include "io/threemf_roles.h"

/// The content of the model files of a 3MF archive.
namespace asdfvk {

struct ModelUnit {
  std::string_view name;  ///< Name in the file.
  std::string_view unit;  ///< Name in kLengthUnits.
};
inline constexpr std::array<ModelUnit, 6> kModelUnits{
    {{"millimeter", "mm"}, {"micron", "um"}, {"centimeter", "cm"}, {"meter", "m"}, {"inch", "in"}, {"foot", "ft"}}};

/// An object that is placed by a build item or is a component of another object.
struct ObjectUse {
  size_t model = 0;
  uint64_t object = 0;
  Placement placement;
  PartRole role = PartRole::Material;  ///< By the settings of a slicer.
  std::string name = {};               ///< By the settings of a slicer; empty if they have none.
};

struct ModelObject {
  PartMesh mesh;
  std::string name;                    ///< By the object, or else by slicers. Empty if it has no name.
  PartRole role = PartRole::Material;  ///< By the type of the object, and by slicers.
  std::vector<ObjectUse> components;
  RoleCounts leftOut{};  ///< Parts that were removed from the mesh.
};

struct ModelFile {
  std::string path;
  const ModelUnit* unit = nullptr;
  std::map<uint64_t, ModelObject> objects;
  std::vector<ObjectUse> items;
  uint64_t unprintedCount = 0;  ///< Build items that are not to be printed.
};

/// The models of an archive, and the memory that they need.
class ModelList {
 public:
  explicit ModelList(uint64_t limitBytes) : limitBytes_(limitBytes) {}

  /// The index of the model at a path within the archive. A new model is empty. The first one is the root model.
  size_t indexAt(std::string_view path);
  [[nodiscard]] ModelFile& model(size_t index) { return models_[index]; }
  [[nodiscard]] const ModelFile& model(size_t index) const { return models_[index]; }
  [[nodiscard]] size_t size() const { return models_.size(); }

  /// Adds to the memory of all models. Throws Error{InputTooLarge} above the limit.
  void charge(uint64_t bytes);
  /// Counts an element that was skipped, and that may have geometry.
  void countSkipped(std::string_view element);
  /// The skipped elements, as noun phrases.
  [[nodiscard]] std::vector<std::string> describeSkipped() const;

  [[nodiscard]] PartSettings& settings() { return settings_; }

 private:
  std::vector<ModelFile> models_;
  std::map<std::string, size_t> indexOf_;  ///< By partName().
  uint64_t limitBytes_, chargedBytes_ = 0, latticeCount_ = 0, unknownCount_ = 0;
  std::set<std::string> unknownNames_;  ///< At most three.
  PartSettings settings_;
};

}  // namespace asdfvk
