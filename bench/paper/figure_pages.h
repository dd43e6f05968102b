#pragma once

#include <map>
#include <string>

#include "asdf_vk/session.h"
#include "page/page.h"
#include "paper/evaluation.h"
#include "paper/output.h"

namespace asdfvk::bench {

/// Writes a page (docs/page.md) per figure, figureN.html. The page has the results that the pictures of the figure
/// show.
class FigurePages {
 public:
  /// figure: number of the figure in the paper. label: distinguishes the results of a figure.
  void add(int figure, const NamedMesh& mesh, const Result& result, const std::string& label);

  void write(const OutputFolder& folder) const;

 private:
  std::map<int, Page> pages_;
};

}  // namespace asdfvk::bench
