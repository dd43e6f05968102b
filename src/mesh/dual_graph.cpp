#include "mesh/dual_graph.h"

#include "mesh/edge_survey.h"

namespace asdfvk {

DualGraph buildDualGraph(const TriangleMesh& mesh) { return surveyEdges(mesh).graph; }

}  // namespace asdfvk
