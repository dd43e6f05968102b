// Built in place of cgal_sdf.cpp where there is no CGAL.
#include "cgal_sdf.h"

namespace asdfvk::bench {

bool hasCgal() { return false; }

std::optional<double> cgalSeconds(const Mesh&) { return {}; }

}  // namespace asdfvk::bench
