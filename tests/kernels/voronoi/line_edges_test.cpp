#include "kernels/voronoi/line_edges.h"

#include <gtest/gtest.h>

#include "kernels/topology/building/build_structural_model.h"
#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

TEST(LineEdges, are_the_border_of_a_sheet_each_once) {
  TriangleSoup soup;
  const sample::Mesh mesh = sample::flat_sheet(5);
  soup.points = mesh.points;
  soup.triangles = mesh.triangles;
  soup.triangle_patch.assign(mesh.triangles.size(), 0);
  soup.patch_entity = {0};
  soup.entities = {{"H1", Role::horizon}};
  const StructuralModel model = build_structural_model(soup)->model;
  const std::vector<LineEdge> edges = line_edges(model);
  EXPECT_EQ(edges.size(), 20u);
  double border = 0;
  for (const LineEdge& edge : edges) {
    const Triangle& t = model.triangles[edge.triangle];
    border += length(model.points[t[edge.edge]] - model.points[t[(edge.edge + 1) % 3]]);
  }
  EXPECT_NEAR(border, 4, 1e-12);
}

}  // namespace
}  // namespace strataflow
