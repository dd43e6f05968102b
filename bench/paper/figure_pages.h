#pragma once

#include <map>
#include <string>

#include "asdf_vk/session.h"
#include "page/page.h"
#include "paper/evaluation.h"
#include "paper/output.h"

namespace asdfvk::bench {

/// A page per figure, figureN.html, with the results that its pictures show: docs/page.md.
class FigurePages {
 public:
  /// figure: number in the paper. label: distinguishes this result from the others of the figure.
  void add(int figure, const NamedMesh& mesh, const Result& result, const std::string& label);

  void write(const OutputFolder& folder) const;

 private:
  std::map<int, Page> pages_;
};

}  // namespace asdfvk::bench
