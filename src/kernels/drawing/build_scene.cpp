#include "kernels/drawing/build_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "graph/parallel/parallel_map.h"
#include "kernels/drawing/palette.h"
#include "kernels/quality/match_cell_faces.h"
#include "model/box3.h"

namespace strataflow {

namespace {

/// Drops the legend entries that no triangle shows; each keeps the colour of its number.
void keep_used_colours(Scene& scene) {
  std::vector<std::uint32_t> new_index(scene.legend.size(), 0);
  for (const SceneTriangle& triangle : scene.triangles)
    new_index[triangle.front_colour] = new_index[triangle.back_colour] = 1;
  std::vector<LegendEntry> used;
  for (std::size_t i = 0; i < scene.legend.size(); ++i)
    if (new_index[i]) {
      new_index[i] = static_cast<std::uint32_t>(used.size());
      used.push_back(std::move(scene.legend[i]));
    }
  scene.legend = std::move(used);
  for (SceneTriangle& triangle : scene.triangles) {
    triangle.front_colour = new_index[triangle.front_colour];
    triangle.back_colour = new_index[triangle.back_colour];
  }
}

std::string name_or_number(const std::string& name, const char* kind, std::size_t number) {
  return name.empty() ? std::string(kind) + " " + std::to_string(number) : name;
}

std::vector<LegendEntry> region_legend(const StructuralModel& model) {
  std::vector<LegendEntry> legend;
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    legend.push_back({name_or_number(model.regions[r].name, "region", r), categorical_colour(r)});
  return legend;
}

template <class Visit>
void for_each_segment(const Line& line, Visit&& visit) {
  for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i) visit(line.vertices[i], line.vertices[i + 1]);
  if (line.is_closed() && line.vertices.size() > 2) visit(line.vertices.back(), line.vertices.front());
}

/// An undirected edge and something it belongs to.
struct MarkedEdge {
  std::uint32_t low, high, mark;
  friend auto operator<=>(const MarkedEdge&, const MarkedEdge&) = default;
};

void add_edges(const std::array<std::uint32_t, 4>& face, std::uint32_t mark, std::vector<MarkedEdge>& edges) {
  const std::size_t corners = face[3] == no_index ? 3 : 4;
  for (std::size_t i = 0; i < corners; ++i) {
    const auto [low, high] = std::minmax({face[i], face[(i + 1) % corners]});
    edges.push_back({low, high, mark});
  }
}

/// Calls visit(begin, end) for each run of equal edges in the sorted list.
template <class Visit>
void for_each_edge_group(const std::vector<MarkedEdge>& edges, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
    visit(begin, end);
  }
}

/// Edges where the facets of a surface end or meet those of another, ascending.
std::vector<std::array<std::uint32_t, 2>> surface_rims(const VolumeMesh& mesh) {
  std::vector<MarkedEdge> edges;
  for (const MeshFacet& facet : mesh.facets) add_edges(facet.vertices, facet.surface, edges);
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<std::uint32_t, 2>> rims;
  for_each_edge_group(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2 || edges[begin].mark != edges[begin + 1].mark)
      rims.push_back({edges[begin].low, edges[begin].high});
  });
  return rims;
}

/// Copies of the points that are used, numbered in the order of first use.
class PointCopier {
 public:
  PointCopier(const std::vector<Vec3>& points, std::vector<Vec3>& copies)
      : points_(points), copies_(copies), copy_of_(points.size(), no_index) {}
  std::uint32_t copy(std::uint32_t point) {
    if (copy_of_[point] == no_index) {
      copy_of_[point] = static_cast<std::uint32_t>(copies_.size());
      copies_.push_back(points_[point] + offset_);
      used_.push_back(point);
    }
    return copy_of_[point];
  }
  /// Forgets all copies; the next ones are moved by `offset`.
  void start_over(const Vec3& offset) {
    for (const std::uint32_t point : used_) copy_of_[point] = no_index;
    used_.clear();
    offset_ = offset;
  }

 private:
  const std::vector<Vec3>& points_;
  std::vector<Vec3>& copies_;
  std::vector<std::uint32_t> copy_of_, used_;
  Vec3 offset_;
};

/// Per cell: 1 if `cut` leaves it.
std::vector<char> cells_left(const VolumeMesh& mesh, const CutPlane& cut) {
  return parallel_map(
      mesh.cell_count(),
      [&](std::size_t cell) {
        Vec3 sum;
        for (std::uint32_t i = mesh.cell_offsets[cell]; i < mesh.cell_offsets[cell + 1]; ++i)
          sum = sum + mesh.points[mesh.cell_vertices[i]];
        const Vec3 centroid = (1.0 / (mesh.cell_offsets[cell + 1] - mesh.cell_offsets[cell])) * sum;
        return static_cast<char>(!(dot(centroid - cut.point, cut.normal) > 0));
      },
      4096);
}

std::vector<LegendEntry> cell_legend(const VolumeMesh& mesh, std::vector<std::uint32_t>& colour_of_cell) {
  std::vector<LegendEntry> legend;
  colour_of_cell.resize(mesh.cell_count());
  if (mesh.cell_region.size() == mesh.cell_count()) {
    std::vector<std::int32_t> regions(mesh.cell_region.begin(), mesh.cell_region.end());
    std::sort(regions.begin(), regions.end());
    regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
    for (const std::int32_t region : regions) {
      const auto number = static_cast<std::size_t>(std::max(region, 0));
      const std::string name = region >= 0 && number < mesh.region_names.size() ? mesh.region_names[number] : "";
      legend.push_back({region < 0 ? "no region" : name_or_number(name, "region", number),
                        region < 0 ? Colour{190, 190, 190} : categorical_colour(number)});
    }
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
      colour_of_cell[cell] = static_cast<std::uint32_t>(
          std::lower_bound(regions.begin(), regions.end(), mesh.cell_region[cell]) - regions.begin());
    return legend;
  }
  constexpr std::array<std::pair<CellType, const char*>, 4> types = {{{CellType::tetrahedron, "tetrahedra"},
                                                                      {CellType::pyramid, "pyramids"},
                                                                      {CellType::prism, "prisms"},
                                                                      {CellType::hexahedron, "hexahedra"}}};
  for (std::size_t i = 0; i < types.size(); ++i) legend.push_back({types[i].second, categorical_colour(i)});
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::uint32_t i = 0; i < types.size(); ++i)
      if (mesh.cell_types[cell] == types[i].first) colour_of_cell[cell] = i;
  return legend;
}

}  // namespace

CutPlane middle_cut(const VolumeMesh& mesh, double azimuth_deg) {
  Box3 box;
  for (const Vec3& point : mesh.points) box.take(point);
  const double x = std::cos(azimuth_deg * std::numbers::pi / 180), y = std::sin(azimuth_deg * std::numbers::pi / 180);
  CutPlane cut;
  cut.point = box.centre();
  if (std::abs(x) > std::abs(y))
    cut.normal.x = x > 0 ? 1 : -1;
  else
    cut.normal.y = y > 0 ? 1 : -1;
  return cut;
}

Scene scene_of_model(const StructuralModel& model, ColourBy colour_by) {
  Scene scene;
  scene.points = model.points;
  if (colour_by == ColourBy::region) {
    scene.legend = region_legend(model);
  } else {
    for (std::size_t e = 0; e < model.entities.size(); ++e)
      scene.legend.push_back({name_or_number(model.entities[e].name, "entity", e), categorical_colour(e)});
  }
  const auto nowhere =
      static_cast<std::uint32_t>(scene.legend.size());  // region colour with the universe on both sides
  scene.legend.push_back({"no region", {190, 190, 190}});
  scene.triangles.reserve(model.triangles.size());
  for (const Surface& surface : model.surfaces) {
    SceneTriangle triangle;
    triangle.front_colour = triangle.back_colour = surface.entity;
    if (colour_by == ColourBy::region) {
      const auto behind = [&](std::uint32_t far, std::uint32_t near) {
        return far != universe ? far : near != universe ? near : nowhere;
      };
      triangle.front_colour = behind(surface.region_minus, surface.region_plus);
      triangle.back_colour = behind(surface.region_plus, surface.region_minus);
    }
    if (!surface.is_dangling())
      triangle.outside = surface.region_plus == universe ? 1 : surface.region_minus == universe ? -1 : 0;
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      triangle.vertices = model.triangles[t];
      scene.triangles.push_back(triangle);
    }
  }
  for (const Line& line : model.lines)
    for_each_segment(line, [&](std::uint32_t a, std::uint32_t b) { scene.lines.push_back({a, b}); });
  keep_used_colours(scene);
  return scene;
}

Scene scene_of_exploded_regions(const StructuralModel& model, double factor) {
  Scene scene;
  scene.legend = region_legend(model);
  PointCopier copier(model.points, scene.points);
  Box3 whole;
  for (const Vec3& point : model.points) whole.take(point);
  for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
    const Region& region = model.regions[r];
    std::vector<SurfaceSide> sides = model.frontiers[region.external_frontier].sides;
    Box3 box;
    for (const SurfaceSide& side : sides)
      for (std::uint32_t t = model.surfaces[side.surface].first_triangle; t < model.surfaces[side.surface].end_triangle;
           ++t)
        for (const std::uint32_t vertex : model.triangles[t]) box.take(model.points[vertex]);
    for (const std::uint32_t inner : region.internal_frontiers)
      sides.insert(sides.end(), model.frontiers[inner].sides.begin(), model.frontiers[inner].sides.end());
    copier.start_over(factor * (box.centre() - whole.centre()));
    std::vector<std::uint32_t> surfaces, lines;  // a dangling surface has both its sides here
    for (const SurfaceSide& side : sides) surfaces.push_back(side.surface);
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    for (const std::uint32_t s : surfaces) {
      const Surface& surface = model.surfaces[s];
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        SceneTriangle triangle;
        for (int i = 0; i < 3; ++i) triangle.vertices[i] = copier.copy(model.triangles[t][i]);
        triangle.front_colour = triangle.back_colour = r;
        scene.triangles.push_back(triangle);
      }
      lines.insert(lines.end(), surface.lines.begin(), surface.lines.end());
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    for (const std::uint32_t line : lines)
      for_each_segment(model.lines[line], [&](std::uint32_t a, std::uint32_t b) {
        scene.lines.push_back({copier.copy(a), copier.copy(b)});
      });
  }
  keep_used_colours(scene);
  return scene;
}

Scene scene_of_volume_mesh(const VolumeMesh& mesh, const std::optional<CutPlane>& cut) {
  Scene scene;
  std::vector<std::uint32_t> colour_of_cell;
  scene.legend = cell_legend(mesh, colour_of_cell);
  const std::vector<char> kept = cut ? cells_left(mesh, *cut) : std::vector<char>(mesh.cell_count(), 1);
  const std::vector<CellFace> faces = match_cell_faces(mesh, &kept).boundary_faces;

  PointCopier copier(mesh.points, scene.points);
  std::vector<MarkedEdge> edges;
  for (const CellFace& face : faces) {
    const std::uint32_t colour = colour_of_cell[face.cell];
    const auto& v = face.vertices;
    const auto add_triangle = [&](int a, int b, int c, std::uint8_t mesh_edges) {
      scene.triangles.push_back(
          {{copier.copy(v[a]), copier.copy(v[b]), copier.copy(v[c])}, colour, colour, mesh_edges, 0});
    };
    if (face.is_triangle()) {
      add_triangle(0, 1, 2, 7);
    } else {  // the diagonal is not drawn
      add_triangle(0, 1, 2, 3);
      add_triangle(0, 2, 3, 6);
    }
    add_edges(v, colour, edges);
  }
  std::sort(edges.begin(), edges.end());
  const auto rims = surface_rims(mesh);
  for_each_edge_group(edges, [&](std::size_t begin, std::size_t end) {
    const std::array<std::uint32_t, 2> edge{edges[begin].low, edges[begin].high};
    if (edges[begin].mark != edges[end - 1].mark || std::binary_search(rims.begin(), rims.end(), edge))
      scene.lines.push_back({copier.copy(edge[0]), copier.copy(edge[1])});
  });
  keep_used_colours(scene);
  return scene;
}

}  // namespace strataflow
