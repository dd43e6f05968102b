#pragma once

namespace asdfvk {

class AtomicFile;
class ResultView;

/// FileFormat::write of PLY.
void writePly(AtomicFile& file, const ResultView& result);

}  // namespace asdfvk
