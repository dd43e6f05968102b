#pragma once

class TopoDS_Face;

namespace asdfvk {

/// Greatest distance between the triangles of a face and its surface, at the middles of triangles and edges. Distances
/// above `enough` are searched again from the corners, because a parameter of a pole has no meaning.
[[nodiscard]] double deviationOf(const TopoDS_Face& face, double enough);

}  // namespace asdfvk
