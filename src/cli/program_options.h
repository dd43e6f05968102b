#pragma once

#include "cli/outputs.h"
#include "describe/option.h"

namespace asdfvk {

/// Rows of the options of outputs and batches. The arguments must outlive the rows.
[[nodiscard]] OptionRows outputRows(Outputs& outputs);
[[nodiscard]] OptionRows batchRows(BatchOptions& batch);

}  // namespace asdfvk
