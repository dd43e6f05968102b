#include "generate/corpus.h"

#include <utility>

namespace asdfvk {

std::vector<KnownPart> corpusParts() {
  std::vector<KnownPart> all;
  for (const auto& make : {wallParts, edgeParts, gapParts, voidParts, thickParts, soundParts, dangerousParts})
    for (KnownPart& part : make()) all.push_back(std::move(part));
  return all;
}

}  // namespace asdfvk
