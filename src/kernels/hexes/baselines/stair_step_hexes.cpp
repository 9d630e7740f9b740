#include "kernels/hexes/baselines/stair_step_hexes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/baselines/plan_frame.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/extrusion/fault_surface.h"
#include "kernels/hexes/extrusion/make_hex_facets.h"
#include "kernels/hexes/extrusion/plan_edges.h"
#include "kernels/hexes/extrusion/plumb_line.h"

namespace strataflow {
namespace {

/// Lines are dropped a little beside the middle and the corners of a column, so that none runs in a fault.
constexpr double middle_shift_x = 0.37e-7, middle_shift_y = 0.61e-7;  // of an edge
constexpr double corner_shift_x = 1e-9, corner_shift_y = 0.7e-9;

/// A column of cells as its own fault block sees it.
struct Column {
  std::vector<double> middle_z;                 ///< per level
  std::vector<std::array<double, 4>> corner_z;  ///< per level
  std::vector<std::array<char, 4>> is_seen;     ///< per level: no fault between the middle and the corner
  std::vector<std::uint32_t> fault_at;          ///< per level: the fault it has leapt over, or no_index
  std::vector<std::int32_t> region;             ///< per layer
};

/// The points over one point of the plan, and which of them each column around it has at each level.
struct Pillar {
  std::vector<double> z;
  std::vector<std::uint32_t> of;  ///< wedge · (layers + 1) + level
};

class StairStep {
 public:
  StairStep(const LayeredSpace& space, double edge_m)
      : space_(space),
        model_(space.model),
        layers_(space.layers.layer_count()),
        edge_m_(edge_m),
        lines_(space, space.model.points) {
    for (std::uint32_t e = 0; e < model_.entities.size(); ++e)
      if (std::any_of(model_.facets.begin(), model_.facets.end(), [&](const SheetFacet& facet) {
            return facet.entity == e && facet.kind == SheetKind::fault && facet.is_aligned != 0;
          })) {
        faults_.push_back(e);
        surfaces_.push_back(std::make_unique<FaultSurface>(model_, e));
      }
  }

  Result<ExtrudedHexes> build() {
    if (const Result<void> made = make_plan(); !made) return made.failure();
    columns_ = parallel_map(
        grid_.plan.quads.size(), [&](std::size_t q) { return column(q); }, 8);
    if (const Result<void> found = find_fault_faces(); !found) return found.failure();
    make_cells();
    judge_cells(result_);
    make_facets();
    return std::move(result_);
  }

 private:
  Result<void> make_plan() {
    FrameFit fit;
    for (const SheetFacet& facet : model_.facets)
      if (facet.kind == SheetKind::side) {
        const Vec3 n = cross(model_.points[facet.vertices[1]] - model_.points[facet.vertices[0]],
                             model_.points[facet.vertices[2]] - model_.points[facet.vertices[0]]);
        fit.take(n, std::hypot(n.x, n.y));
      }
    frame_ = fit.frame();
    Box3 box;
    for (const Vec3& p : model_.points) box.take(Vec3{dot(p, frame_.i), dot(p, frame_.j), 0});
    std::array<std::uint32_t, 2> size{};
    const std::array<double, 2> extent{box.high.x - box.low.x, box.high.y - box.low.y};
    if (!(extent[0] / edge_m_ * (extent[1] / edge_m_) * (layers_ + 1.0) < double(1 << 28)))
      return Failure{FailureCode::geometry_failed, "more than 2^30 vertices", "ask for longer edges or fewer layers"};
    for (std::size_t d = 0; d < 2; ++d) {
      size[d] = static_cast<std::uint32_t>(std::max(1.0, std::round(extent[d] / edge_m_)));
      step_[d] = extent[d] / size[d];
    }
    const auto at = [&](double i, double j) {
      return (box.low.x + i * step_[0]) * frame_.i + (box.low.y + j * step_[1]) * frame_.j;
    };
    const std::vector<char> is_inside = parallel_map(
        std::size_t{size[0]} * size[1],
        [&](std::size_t q) {
          const Vec3 p =
              at(q % size[0] + 0.5 + middle_shift_x, static_cast<double>(q / size[0]) + 0.5 + middle_shift_y);
          return static_cast<char>(!lines_.at(p.x, p.y).is_empty());
        },
        64);
    QuadMesh& plan = grid_.plan;
    plan.local_origin = model_.local_origin;
    std::vector<std::uint32_t> number(std::size_t{size[0] + 1} * (size[1] + 1), no_index);
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
      std::uint32_t& n = number[i + std::size_t{size[0] + 1} * j];
      if (n == no_index) {
        n = static_cast<std::uint32_t>(plan.points.size());
        plan.points.push_back(at(i, j));
      }
      return n;
    };
    for (std::uint32_t j = 0; j < size[1]; ++j)
      for (std::uint32_t i = 0; i < size[0]; ++i)
        if (is_inside[i + std::size_t{size[0]} * j])
          plan.quads.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
    if (plan.quads.empty())
      return Failure{FailureCode::geometry_failed, "no column has its middle inside the model",
                     "ask for shorter edges"};
    for (const std::uint32_t e : faults_) plan.features.push_back({model_.entities[e].name, Role::fault, 0, -1});
    return {};
  }

  /// The first fault between two points, as an index into faults_, or no_index.
  std::uint32_t fault_between(const Vec3& a, const Vec3& b) const {
    for (std::uint32_t f = 0; f < faults_.size(); ++f)
      if (surfaces_[f]->meets(a, b)) return f;
    return no_index;
  }

  std::vector<PlumbLevel> levels_on(const PlumbLine& line) const {
    std::vector<PlumbLevel> levels;
    for (std::uint32_t k = 0; k <= layers_; ++k) levels.push_back(line.at_level(k));
    const StratigraphicTets& layers = space_.layers;
    for (std::size_t unit = 0; unit + 1 < layers.level_w.size() && unit < layers.units.size(); ++unit) {
      const UnitLayers& how = layers.units[unit];
      const std::uint32_t floor = layers.level_w[unit], roof = layers.level_w[unit + 1];
      const double base_m = levels[floor].z, top_m = levels[roof].z;
      if (how.layout == LayerLayout::proportional || !((top_m - base_m) / (roof - floor) > how.thickness_m)) continue;
      for (std::uint32_t k = floor + 1; k < roof; ++k)
        levels[k].z = how.layout == LayerLayout::parallel_to_top ? top_m - (roof - k) * how.thickness_m
                                                                 : base_m + (k - floor) * how.thickness_m;
    }
    return levels;
  }

  Column column(std::size_t q) const {
    const auto& quad = grid_.plan.quads[q];
    const Vec3 &first = grid_.plan.points[quad[0]], &last = grid_.plan.points[quad[2]];
    const Vec3 middle =
        0.5 * (first + last) + middle_shift_x * step_[0] * frame_.i + middle_shift_y * step_[1] * frame_.j;
    const PlumbLine middle_line = lines_.at(middle.x, middle.y);
    const std::vector<PlumbLevel> middles = levels_on(middle_line);
    Column column;
    column.corner_z.resize(layers_ + 1);
    column.is_seen.assign(layers_ + 1, {});
    column.fault_at.assign(layers_ + 1, no_index);
    for (std::uint32_t k = 0; k <= layers_; ++k) {
      column.middle_z.push_back(middles[k].z);
      if (!middles[k].is_in_jump) continue;
      const Vec3 at{middle.x, middle.y, middles[k].z}, reach{0, 0, 1e-6 * edge_m_};
      column.fault_at[k] = fault_between(at - reach, at + reach);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      // Into the column.
      const double side_i = c == 0 || c == 3 ? 1 : -1, side_j = c < 2 ? 1 : -1;
      const Vec3 corner = grid_.plan.points[quad[c]] + side_i * corner_shift_x * step_[0] * frame_.i +
                          side_j * corner_shift_y * step_[1] * frame_.j;
      const PlumbLine line = lines_.at(corner.x, corner.y);
      if (line.is_empty()) continue;
      const std::vector<PlumbLevel> levels = levels_on(line);
      for (std::uint32_t k = 0; k <= layers_; ++k) {
        column.corner_z[k][c] = levels[k].z;
        column.is_seen[k][c] =
            fault_between({middle.x, middle.y, column.middle_z[k]}, {corner.x, corner.y, levels[k].z}) == no_index;
      }
    }
    for (std::uint32_t k = 0; k <= layers_; ++k) continue_plane(column, k);
    for (std::uint32_t k = 0; k < layers_; ++k) {
      const std::uint32_t tet = middle_line.tet_at(0.5 * (column.middle_z[k] + column.middle_z[k + 1]));
      column.region.push_back(model_.region[tet]);
    }
    return column;
  }

  /// Corners beyond a fault: on the plane through the middle that fits those that are seen best, level across where
  /// these do not say how it dips.
  static void continue_plane(Column& column, std::uint32_t level) {
    constexpr std::array<double, 4> di{-0.5, 0.5, 0.5, -0.5}, dj{-0.5, -0.5, 0.5, 0.5};
    double ii = 0, ij = 0, jj = 0, zi = 0, zj = 0;
    const double middle = column.middle_z[level];
    for (std::size_t c = 0; c < 4; ++c) {
      if (!column.is_seen[level][c]) continue;
      const double dz = column.corner_z[level][c] - middle;
      ii += di[c] * di[c], ij += di[c] * dj[c], jj += dj[c] * dj[c];
      zi += di[c] * dz, zj += dj[c] * dz;
    }
    const double determinant = ii * jj - ij * ij;
    double gi = 0, gj = 0;
    if (determinant > 1e-9) {
      gi = (zi * jj - zj * ij) / determinant;
      gj = (zj * ii - zi * ij) / determinant;
    } else if (ii + jj > 0) {  // seen along one diagonal alone: the flattest plane through it
      gi = zi / (ii + jj);
      gj = zj / (ii + jj);
    }
    for (std::size_t c = 0; c < 4; ++c)
      if (!column.is_seen[level][c]) column.corner_z[level][c] = middle + gi * di[c] + gj * dj[c];
  }

  std::uint32_t fault_beside(const PlanEdge& edge, std::uint32_t layer) const {
    std::array<Vec3, 2> middle;
    for (std::size_t s = 0; s < 2; ++s) {
      const auto& quad = grid_.plan.quads[edge.quads[s]];
      middle[s] = 0.5 * (grid_.plan.points[quad[0]] + grid_.plan.points[quad[2]]) +
                  middle_shift_x * step_[0] * frame_.i + middle_shift_y * step_[1] * frame_.j;
      const std::vector<double>& z = columns_[edge.quads[s]].middle_z;
      middle[s].z = 0.5 * (z[layer] + z[layer + 1]);
    }
    return fault_between(middle[0], middle[1]);
  }

  /// Cells beside each other are parted where a fault runs between their middles; edges that are so in any layer are
  /// traces in the plan.
  Result<void> find_fault_faces() {
    Result<PlanEdges> edges = find_plan_edges(grid_.plan, model_);
    if (!edges) return edges.failure();
    fault_of_ = parallel_map(
        edges->edges.size(),
        [&](std::size_t e) {
          std::vector<std::uint32_t> faults(layers_, no_index);
          if (edges->edges[e].quads[1] == no_index) return faults;
          for (std::uint32_t k = 0; k < layers_; ++k) faults[k] = fault_beside(edges->edges[e], k);
          return faults;
        },
        32);
    edges_ = *std::move(edges);
    join_half_open_faces();
    for (std::size_t e = 0; e < fault_of_.size(); ++e)
      for (std::uint32_t f = 0; f < faults_.size(); ++f)
        if (std::find(fault_of_[e].begin(), fault_of_[e].end(), f) != fault_of_[e].end())
          grid_.plan.edges.push_back({edges_.edges[e].points[0], edges_.edges[e].points[1], f});
    return {};
  }

  /// Where a cell ends in an edge beside a fault, its triangle may coincide with three corners of the face across: such
  /// faces are opened, so that cells share a whole face or none of it. Every round opens some, so there is a last.
  void join_half_open_faces() {
    for (bool changes = true; changes;) {
      changes = false;
      pillars_ = parallel_map(
          grid_.plan.points.size(), [&](std::size_t p) { return pillar(static_cast<std::uint32_t>(p)); }, 32);
      for (std::size_t e = 0; e < fault_of_.size(); ++e)
        for (std::uint32_t k = 0; k < layers_; ++k) {
          if (fault_of_[e][k] == no_index || !is_half_open(edges_.edges[e], k)) continue;
          fault_of_[e][k] = no_index;
          changes = true;
        }
    }
  }

  /// Height of a column's corner at a level.
  double z_at(std::uint32_t quad, std::uint32_t point, std::uint32_t level) const {
    for (std::uint32_t i = 0;; ++i)
      if (edges_.wedges[edges_.first_wedge[point] + i] / 4 == quad)
        return pillars_[point].z[pillars_[point].of[std::size_t{i} * (layers_ + 1) + level]];
  }

  bool is_half_open(const PlanEdge& edge, std::uint32_t layer) const {
    std::array<std::array<std::array<double, 2>, 2>, 2> z{};  // per side, end, level
    std::array<std::array<bool, 2>, 2> is_closed{};
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t end = 0; end < 2; ++end) {
        for (std::uint32_t level = 0; level < 2; ++level)
          z[side][end][level] = z_at(edge.quads[side], edge.points[end], layer + level);
        is_closed[side][end] = z[side][end][0] == z[side][end][1];
      }
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t end = 0; end < 2; ++end) {
        const std::size_t other = 1 - side, far = 1 - end;
        if (is_closed[side][end] && !is_closed[side][far] && !is_closed[other][0] && !is_closed[other][1] &&
            z[side][far] == z[other][far] &&
            (z[side][end][0] == z[other][end][0] || z[side][end][0] == z[other][end][1]))
          return true;
      }
    return false;
  }

  /// Columns around a point that no fault parts at a level, each called by the first of them.
  std::vector<std::uint32_t> groups_around(std::uint32_t p, std::uint32_t level) const {
    return edges_.wedge_groups(p, [&](std::uint32_t e) {
      return (level > 0 && fault_of_[e][level - 1] == no_index) || (level < layers_ && fault_of_[e][level] == no_index);
    });
  }

  Pillar pillar(std::uint32_t p) const {
    const std::uint32_t begin = edges_.first_wedge[p], count = edges_.wedge_count(p);
    Pillar pillar;
    pillar.of.assign(std::size_t{count} * (layers_ + 1), 0);
    for (std::uint32_t k = 0; k <= layers_; ++k) {
      const std::vector<std::uint32_t> group = groups_around(p, k);
      for (std::uint32_t i = 0; i < count; ++i) {
        std::uint32_t& number = pillar.of[std::size_t{i} * (layers_ + 1) + k];
        if (group[i] != i) {
          number = pillar.of[std::size_t{group[i]} * (layers_ + 1) + k];
          continue;
        }
        number = static_cast<std::uint32_t>(pillar.z.size());
        std::array<double, 2> sum{}, members{};  // continued, seen
        double below = -std::numeric_limits<double>::infinity();
        for (std::uint32_t j = i; j < count; ++j) {
          if (group[j] != i) continue;
          const std::uint32_t corner = edges_.wedges[begin + j];
          const Column& column = columns_[corner / 4];
          const std::size_t seen = column.is_seen[k][corner % 4] ? 1 : 0;
          sum[seen] += column.corner_z[k][corner % 4];
          ++members[seen];
          if (k > 0) below = std::max(below, pillar.z[pillar.of[std::size_t{j} * (layers_ + 1) + k - 1]]);
        }
        const std::size_t best = members[1] > 0 ? 1 : 0;
        const double z = sum[best] / members[best];
        // Levels never cross, and what is closer than a closed cell is one.
        pillar.z.push_back(k > 0 && !(z > below + 1e-8 * edge_m_) ? below : z);
      }
    }
    return pillar;
  }

  void make_cells() {
    VolumeMesh& mesh = grid_.mesh;
    grid_.layers = layers_;
    mesh.local_origin = model_.local_origin;
    mesh.entities = model_.entities;
    mesh.region_names = model_.region_names;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e)
      mesh.surface_entity.push_back(static_cast<std::int32_t>(e));
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> wedge_of(4 * grid_.plan.quads.size(), 0);
    for (std::uint32_t p = 0; p < pillars_.size(); ++p) {
      first.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      for (const double z : pillars_[p].z) mesh.points.push_back(grid_.plan.points[p] + Vec3{0, 0, z});
      for (std::uint32_t i = 0; i < edges_.wedge_count(p); ++i) wedge_of[edges_.wedges[edges_.first_wedge[p] + i]] = i;
    }
    for (std::uint32_t q = 0; q < grid_.plan.quads.size(); ++q)
      for (std::uint32_t k = 0; k < layers_; ++k) {
        std::array<std::uint32_t, 8> corners{};
        for (std::uint32_t c = 0; c < 4; ++c) {
          const std::uint32_t p = grid_.plan.quads[q][c];
          const std::uint32_t* of = &pillars_[p].of[std::size_t{wedge_of[4 * q + c]} * (layers_ + 1) + k];
          corners[c] = first[p] + of[0];
          corners[4 + c] = first[p] + of[1];
        }
        mesh.add_cell(CellType::hexahedron, corners.data(), columns_[q].region[k]);
        grid_.cell_column.push_back(q);
        grid_.cell_layer.push_back(k);
      }
  }

  std::uint32_t vertex(std::uint32_t cell, std::uint32_t corner) const {
    return grid_.mesh.cell_vertices[8 * std::size_t{cell} + corner];
  }

  /// Levels and sides as in any grid of layers; where a column has leapt over levels at a fault, what lies there is the
  /// fault's, and between columns what fault_of_ says.
  void make_facets() {
    VolumeMesh& mesh = grid_.mesh;
    mesh.facets = make_hex_facets(grid_, {space_, edges_, [](std::uint32_t, std::uint32_t) { return false; }, edge_m_});
    const auto leapt = [&](std::uint32_t q, std::uint32_t level) { return columns_[q].fault_at[level]; };
    std::erase_if(mesh.facets, [&](const MeshFacet& facet) {
      const bool is_level = facet.cell_1 != no_index && facet.cell_0 / layers_ == facet.cell_1 / layers_;
      return is_level && leapt(facet.cell_0 / layers_, facet.cell_0 % layers_ + 1) != no_index;
    });
    for (std::uint32_t q = 0; q < columns_.size(); ++q)
      for (std::uint32_t k = 1; k < layers_; ++k) {
        if (leapt(q, k) == no_index || leapt(q, k - 1) != no_index) continue;  // the lowest of those that lie there
        const std::uint32_t cell = q * layers_ + k;
        mesh.facets.push_back({{vertex(cell, 0), vertex(cell, 1), vertex(cell, 2), vertex(cell, 3)},
                               faults_[leapt(q, k)],
                               cell - 1,
                               cell});
      }
    for (std::uint32_t e = 0; e < edges_.edges.size(); ++e)
      for (std::uint32_t k = 0; k < layers_; ++k) {
        if (fault_of_[e][k] == no_index) continue;
        std::array<MeshFacet, 2> both;
        for (std::size_t s = 0; s < 2; ++s) {
          const std::uint32_t cell = edges_.edges[e].quads[s] * layers_ + k, c = edges_.edges[e].sides[s];
          both[s].vertices = {vertex(cell, c), vertex(cell, (c + 1) % 4), vertex(cell, 4 + (c + 1) % 4),
                              vertex(cell, 4 + c)};
          both[s].cell_0 = cell;
          both[s].surface = faults_[fault_of_[e][k]];
        }
        auto left = both[0].vertices, right = both[1].vertices;
        std::sort(left.begin(), left.end());
        std::sort(right.begin(), right.end());
        if (left == right) both[0].cell_1 = both[1].cell_0;
        mesh.facets.push_back(both[0]);
        if (left != right) mesh.facets.push_back(both[1]);
      }
  }

  const LayeredSpace& space_;
  const LabelledTets& model_;
  std::uint32_t layers_ = 0;
  double edge_m_ = 1;
  PlumbLines lines_;
  std::vector<std::uint32_t> faults_;  ///< entities
  std::vector<std::unique_ptr<FaultSurface>> surfaces_;
  PlanFrame frame_;
  std::array<double, 2> step_{};
  std::vector<Column> columns_;
  PlanEdges edges_;
  std::vector<Pillar> pillars_;                       ///< per plan point
  std::vector<std::vector<std::uint32_t>> fault_of_;  ///< per edge and layer: index into faults_, or no_index
  ExtrudedHexes result_;
  HexGrid& grid_ = result_.grid;
};

}  // namespace

Result<ExtrudedHexes> stair_step_hexes(const LayeredSpace& space, double edge_m) {
  if (!(edge_m > 0 && std::isfinite(edge_m)))
    return Failure{FailureCode::invalid_options, "the edge length is not positive", "give hex.edge_length_m"};
  return StairStep(space, edge_m).build();
}

}  // namespace strataflow
