#include "io/input_failure.h"
#include "io/step_library.h"

namespace asdfvk {

StepModuleFunction stepModule() { failInput("is STEP, which this build cannot read; export STL or 3MF"); }

}  // namespace asdfvk
