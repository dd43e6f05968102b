#include "io/threemf_model_list.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/input_failure.h"
#include "io/zip_archive.h"

namespace asdfvk {

void ModelList::charge(uint64_t bytes) {
  chargedBytes_ += bytes;
  if (chargedBytes_ > limitBytes_)
    throw Error(ErrorCode::InputTooLarge, fmt::format("its mesh needs more than {} MiB of memory", limitBytes_ >> 20));
}

size_t ModelList::indexAt(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  const auto [known, isNew] = indexOf_.emplace(partName(path), models_.size());
  if (!isNew) return known->second;
  constexpr size_t kMaxModels = 4096;
  if (models_.size() == kMaxModels) failInput(fmt::format("more than {} model files", kMaxModels));
  charge(sizeof(ModelFile) + 128 + path.size());
  models_.push_back({.path = std::string(path), .unit = kModelUnits.data()});
  return models_.size() - 1;
}

void ModelList::countSkipped(std::string_view element) {
  constexpr size_t kMaxNames = 3;
  if (element == "beamlattice") {
    ++latticeCount_;
    return;
  }
  ++unknownCount_;
  if (unknownNames_.size() < kMaxNames) unknownNames_.insert(asdfvk::quoted(element));
}

std::vector<std::string> ModelList::describeSkipped() const {
  std::vector<std::string> phrases;
  if (latticeCount_ > 0) phrases.push_back(counted(latticeCount_, "beam lattice"));
  if (unknownCount_ > 0)
    phrases.push_back(fmt::format("{} ({})", counted(unknownCount_, "unknown element"), joined(unknownNames_, ", ")));
  return phrases;
}

}  // namespace asdfvk
