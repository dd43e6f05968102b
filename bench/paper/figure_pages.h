#pragma once

#include <map>
#include <string>

#include "asdf_vk/session.h"
#include "page/page.h"
#include "paper/evaluation.h"
#include "paper/output.h"

namespace asdfvk::bench {

/// A page (docs/page.md) per figure, figureN.html, with the results of its pictures.
class FigurePages {
 public:
  /// figure: number in the paper. label: distinguishes results of a figure.
  void add(int figure, const NamedMesh& mesh, const Result& result, const std::string& label);

  void write(const OutputFolder& folder) const;

 private:
  std::map<int, Page> pages_;
};

}  // namespace asdfvk::bench
