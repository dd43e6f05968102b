#include "describe/default_fields.h"

namespace asdfvk {

std::vector<std::string> defaultFieldNames(const Options& options) {
  std::vector<std::string> names;
  if (options.measuresThickness()) names.insert(names.end(), {"thickness", "least_thickness"});
  if (options.measuresGap()) names.insert(names.end(), {"gap", "least_gap"});
  if (options.measuresDiameter()) names.insert(names.end(), {"sdf", "seed"});
  if (options.postprocesses()) names.emplace_back("normalized");
  if (options.segmentation != Segmentation::None) names.emplace_back("segment");
  return names;
}

}  // namespace asdfvk
