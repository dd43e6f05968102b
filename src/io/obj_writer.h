#pragma once

namespace asdfvk {

class AtomicFile;
class ResultView;

/// FileFormat::write, writeBeside and needsBeside of OBJ.
void writeObj(AtomicFile& file, const ResultView& result);
void writeObjMaterials(AtomicFile& file, const ResultView& result);
[[nodiscard]] bool hasObjMaterials(const ResultView& result);

}  // namespace asdfvk
