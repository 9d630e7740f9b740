#include "kernels/drawing/scene_of_quads.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "kernels/drawing/palette.h"

namespace strataflow {

namespace {

enum ValenceColour : std::uint32_t { regular, three, five, other };

std::vector<LegendEntry> valence_legend() {
  return {{"regular", {225, 228, 232}},
          {"around three quads' vertex", categorical_colour(0)},
          {"around five quads' vertex", categorical_colour(1)},
          {"around another irregular vertex", categorical_colour(2)}};
}

ValenceColour colour_of(int quads) {
  return quads == 4 ? regular : quads == 3 ? three : quads == 5 ? five : other;
}

/// The triangles of a mesh, coloured by the most irregular of their points.
Scene scene_of_triangles(const FeatureMesh& mesh, const std::vector<std::int8_t>& valence, bool draws_edges) {
  Scene scene;
  scene.points = mesh.points;
  scene.legend = valence_legend();
  std::vector<char> is_on_feature(mesh.points.size(), 0);
  for (const FeatureEdge& edge : mesh.edges) {
    is_on_feature[edge.a] = is_on_feature[edge.b] = 1;
    scene.lines.push_back({edge.a, edge.b});
  }
  for (const Triangle& t : mesh.triangles) {
    std::uint32_t colour = regular;
    for (const std::uint32_t p : t)
      if (!is_on_feature[p] && p < valence.size()) colour = std::max<std::uint32_t>(colour, colour_of(valence[p]));
    scene.triangles.push_back({t, colour, colour, static_cast<std::uint8_t>(draws_edges ? 7 : 0), 0});
  }
  return scene;
}

void add_line(Scene& scene, const Vec3& a, const Vec3& b) {
  const auto first = static_cast<std::uint32_t>(scene.points.size());
  scene.points.insert(scene.points.end(), {a, b});
  scene.lines.push_back({first, first + 1});
}

}  // namespace

Scene scene_of_quads(const QuadMesh& mesh) {
  Scene scene;
  scene.points = mesh.points;
  scene.legend = valence_legend();
  std::vector<std::uint32_t> quads(mesh.points.size(), 0);
  for (const auto& quad : mesh.quads)
    for (const std::uint32_t p : quad) ++quads[p];
  // A boundary vertex has one edge more than quads.
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& quad : mesh.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [low, high] = std::minmax(quad[k], quad[(k + 1) % 4]);
      edges.push_back({low, high});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<char> is_inside(mesh.points.size(), 1);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]))
      is_inside[edges[i][0]] = is_inside[edges[i][1]] = 0;
  for (const auto& q : mesh.quads) {
    std::uint32_t colour = regular;
    for (const std::uint32_t p : q)
      if (is_inside[p]) colour = std::max<std::uint32_t>(colour, colour_of(static_cast<int>(quads[p])));
    scene.triangles.push_back({{q[0], q[1], q[2]}, colour, colour, 3, 0});
    scene.triangles.push_back({{q[0], q[2], q[3]}, colour, colour, 6, 0});
  }
  for (const FeatureEdge& edge : mesh.edges) scene.lines.push_back({edge.a, edge.b});
  return scene;
}

Scene scene_of_map(const FeatureMesh& mesh, const CornerMap& map) {
  Scene scene = scene_of_triangles(mesh, map.valence, false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto value = [&](std::size_t k) { return map.uv[3 * t + k][axis]; };
      const double low = std::min({value(0), value(1), value(2)}), high = std::max({value(0), value(1), value(2)});
      if (!(high - low < 1000)) continue;  // a map that is torn; nothing to see
      for (double level = std::ceil(low); level <= high; ++level) {
        std::vector<Vec3> ends;
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = value(k) - level, b = value((k + 1) % 3) - level;
          if ((a < 0) == (b < 0)) continue;
          const Vec3 &p = mesh.points[mesh.triangles[t][k]], &q = mesh.points[mesh.triangles[t][(k + 1) % 3]];
          ends.push_back(p + (a / (a - b)) * (q - p));
        }
        if (ends.size() == 2) add_line(scene, ends[0], ends[1]);
      }
    }
  return scene;
}

Scene scene_of_field(const FeatureMesh& mesh, const FrameField& field) {
  Scene scene = scene_of_triangles(mesh, field.valence, true);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 &a = mesh.points[mesh.triangles[t][0]], &b = mesh.points[mesh.triangles[t][1]],
               &c = mesh.points[mesh.triangles[t][2]];
    const Vec3 along = b - a, normal = cross(along, c - a);
    const double size = length(along), area = length(normal);
    if (!(size > 0) || !(area > 0)) continue;
    const Vec3 x = (1 / size) * along, y = (1 / area) * cross(normal, x), middle = (1.0 / 3) * (a + b + c);
    const double reach = 0.25 * std::sqrt(area);
    for (const double angle : field.angles[t]) {
      const Vec3 arm = (reach * std::cos(angle)) * x + (reach * std::sin(angle)) * y;
      add_line(scene, middle - arm, middle + arm);
    }
  }
  return scene;
}

}  // namespace strataflow
