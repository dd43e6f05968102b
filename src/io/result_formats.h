#pragma once

#include "core/atomic_file.h"
#include "io/result_writer.h"
#include "mesh/mesh.h"

namespace asdfvk {

// One writer per format; the caller commits the file. See writeResult() for what they share.

/// The list `uchar int vertex_indices` (`int int` beyond 255 corners), then `float quality`, then
/// `uchar red green blue alpha`.
void writePly(AtomicFile& file, const TriangleMesh& mesh, const FaceValues& face, bool ascii);
/// VTK's XML unstructured grid with inline base64: cell data `sdf` (Float32) and `seed` (UInt8).
void writeVtu(AtomicFile& file, const TriangleMesh& mesh, const FaceValues& face);
/// Version 1.0, '<f4', shape (#I,).
void writeNpy(AtomicFile& file, const FaceValues& face);
/// Header `face,sdf,seed`, then a row per input face with the shortest numbers that read back the same.
void writeCsv(AtomicFile& file, const FaceValues& face);

/// Whether float holds every coordinate exactly (NaN and infinities count as held).
[[nodiscard]] bool verticesAreFloats(const TriangleMesh& mesh);

}  // namespace asdfvk
