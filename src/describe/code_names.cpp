// The names of the stages, verdicts and warnings. Those of errors are in core/error.cpp, which throws them.
#include "describe/report_keys.h"

namespace asdfvk {

static_assert(kStageNames.size() == kStageCount);

const char* nameOf(Stage stage) { return kStageNames[static_cast<size_t>(stage)]; }
const char* nameOf(ThicknessVerdict verdict) { return kThicknessVerdictNames[static_cast<size_t>(verdict)]; }
const char* nameOf(WarningCode code) { return kWarningCodeNames[static_cast<size_t>(code)]; }

}  // namespace asdfvk
