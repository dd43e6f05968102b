#pragma once

#include <vector>

#include "paper/page.h"
#include "paper/studio.h"
#include "paper/subject.h"
#include "pipeline/asdf.h"

namespace asdfvk::bench {

/// Figure 8: the balanced result at 10 % of the faces of every mesh.
void addGallery(Page& page, const Studio& studio, Session& session, std::vector<Subject>& subjects,
                const RunControl& control);

}  // namespace asdfvk::bench
