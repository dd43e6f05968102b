#pragma once

#include "paper/evaluation.h"
#include "paper/output_folder.h"
#include "paper/page.h"
#include "paper/studio.h"
#include "paper/subject.h"

namespace asdfvk::bench {

/// Figure 7: what each sampler selects at 7 % of the faces, and the average errors that come of it with the paper's
/// interpolation and with the balanced recipe's.
void addSamplerFigure(Page& page, const Studio& studio, const OutputFolder& folder, Session& session, Subject& subject,
                      const Evaluation& evaluation, uint32_t seedSetCount, const RunControl& control);

}  // namespace asdfvk::bench
