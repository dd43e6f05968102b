#pragma once

namespace asdfvk {

class AtomicFile;
class ResultView;

/// FileFormat::write of GLB.
void writeGlb(AtomicFile& file, const ResultView& result);

}  // namespace asdfvk
