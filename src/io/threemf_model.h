#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/assembled_mesh.h"
#include "io/xml_scanner.h"

/// Model files of a 3MF archive.
namespace asdfvk {

struct ModelUnit {
  std::string_view name;  ///< Name in the file.
  std::string_view unit;  ///< Name in kLengthUnits.
};

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
  const ModelUnit* unit = nullptr;
  std::map<uint64_t, ModelObject> objects;
  std::vector<ObjectUse> items;
};

/// The models of an archive, and the memory that they need.
class ModelList {
 public:
  explicit ModelList(uint64_t limitBytes) : limitBytes_(limitBytes) {}

  /// The index of the model at a path within the archive. A new model is empty.
  size_t indexAt(std::string_view path);
  [[nodiscard]] ModelFile& model(size_t index) { return models_[index]; }
  [[nodiscard]] const ModelFile& model(size_t index) const { return models_[index]; }
  [[nodiscard]] size_t size() const { return models_.size(); }

  /// Adds to the memory of all models. Throws Error{InputTooLarge} above the limit.
  void charge(uint64_t bytes);
  void countLattice() { ++latticeCount_; }
  [[nodiscard]] uint64_t latticeCount() const { return latticeCount_; }

 private:
  std::vector<ModelFile> models_;
  std::map<std::string, size_t, std::less<>> indexOf_;  ///< By path.
  uint64_t limitBytes_, chargedBytes_ = 0, latticeCount_ = 0;
};

/// Reads the model `index`, and adds the models that it names to the list. Throws Error as failInput() does.
void readModel(XmlScanner& xml, ModelList& models, size_t index);

}  // namespace asdfvk
