#pragma once

#include "paper/evaluation.h"
#include "paper/page.h"
#include "paper/studio.h"
#include "paper/subject.h"

namespace asdfvk::bench {

/// The pictures of one mesh: Figures 1 (seeds and result), 2 (Laplacian), 3 (few and all faces) and 4 (error map).
void addPaperFigures(Page& page, const Studio& studio, Session& session, Subject& subject, const Evaluation& evaluation,
                     const RunControl& control);

}  // namespace asdfvk::bench
