#include "kernels/simulation_grid/build_simulation_grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "graph/parallel/parallel_map.h"
#include "kernels/quality/measure_cell.h"
#include "kernels/simulation_grid/cell_contacts.h"
#include "kernels/simulation_grid/straight_pillars.h"

namespace strataflow {

namespace {
/// A millidarcy times a metre, in cP·m³/(day·bar).
constexpr double darcy_unit = 9.869233e-16 * 86400 * 1e5 / 1e-3;
constexpr std::uint32_t corner_i[] = {0, 1, 1, 0}, corner_j[] = {0, 0, 1, 1};

double mean_edge_length(const QuadMesh& plan) {
  double sum = 0;
  for (const auto& quad : plan.quads)
    for (int s = 0; s < 4; ++s) sum += length(plan.points[quad[(s + 1) % 4]] - plan.points[quad[s]]);
  return plan.quads.empty() ? 0 : sum / (4.0 * static_cast<double>(plan.quads.size()));
}

Result<void> check_options(const HexGrid& hexes, const std::vector<RegionRock>& rock,
                           const std::vector<FaultTransmissibility>& faults, const SimulationGridOptions& options) {
  const auto wrong = [](const std::string& what, const std::string& remedy) {
    return Failure{FailureCode::invalid_options, what, remedy};
  };
  if (options.pillar_tolerance_m && !(*options.pillar_tolerance_m > 0 && std::isfinite(*options.pillar_tolerance_m)))
    return wrong("pillar_tolerance_m is not positive", "give a length in metres, or leave it out");
  for (std::size_t r = 0; r < rock.size(); ++r) {
    const std::string name = rock[r].region.empty() ? "region " + std::to_string(r) : rock[r].region;
    if (!(rock[r].porosity >= 0 && rock[r].porosity <= 1))
      return wrong(name + ": porosity is not within 0 … 1", "correct it");
    for (const double k : {rock[r].permeability_lateral_md, rock[r].permeability_vertical_md})
      if (!(k >= 0 && std::isfinite(k))) return wrong(name + ": a permeability is negative or no number", "correct it");
  }
  for (const FaultTransmissibility& fault : faults) {
    if (!(fault.multiplier >= 0 && std::isfinite(fault.multiplier)))
      return wrong("fault " + fault.fault + ": the multiplier is negative or no number", "correct it");
    const auto& all = hexes.mesh.entities;
    if (std::none_of(all.begin(), all.end(),
                     [&](const Entity& e) { return e.role == Role::fault && e.name == fault.fault; }))
      return wrong("there is no fault " + fault.fault + " in the grid", "name one of the model's faults");
  }
  for (std::size_t cell = 0; cell < hexes.mesh.cell_count(); ++cell) {
    const std::int32_t region = hexes.mesh.cell_region[cell];
    if (!hexes.is_dead[cell] && (region < 0 || static_cast<std::size_t>(region) >= rock.size()))
      return Failure{FailureCode::invalid_input, "region " + std::to_string(region) + " has no rock properties",
                     "give properties for every region"};
  }
  return {};
}

class SimulationGridBuilder {
 public:
  SimulationGridBuilder(const HexGrid& hexes, const std::vector<std::uint32_t>& cells, ColumnPlacement& placement)
      : hexes_(hexes), cells_(cells), placement_(placement) {}

  Result<void> build_grid(std::uint64_t most_places) {
    turn_first_column();
    CornerPointGrid& grid = out.grid;
    grid.local_origin = hexes_.mesh.local_origin;
    grid.size = {placement_.packing.size[0], placement_.packing.size[1], placement_.height};
    set_pillars();
    if (!(handedness() > 0)) {  // a row and a column of nothing, whose pillars may stand anywhere
      ++grid.size[0], ++grid.size[1];
      set_pillars();
    }
    const std::uint64_t places = std::uint64_t{grid.size[0]} * grid.size[1] * grid.size[2];
    if (places > most_places)
      return Failure{
          FailureCode::unsupported,
          "the index box would have " + std::to_string(places) + " places for " +
              std::to_string(hexes_.mesh.cell_count()) + " cells, in " + std::to_string(placement_.pieces.size()) +
              " pieces of columns",
          "leave hex.layout automatic, raise hex.pillar_tolerance_m so that fewer columns are split, or choose a "
          "coarser grid"};
    set_cells();
    fill_empty_columns();
    return {};
  }

  void connect(const std::vector<CellContact>& contacts, const std::vector<FaultTransmissibility>& multipliers) {
    std::vector<std::uint32_t> fault_of_entity(hexes_.mesh.entities.size(), no_index);
    for (std::size_t e = 0; e < fault_of_entity.size(); ++e) {
      const Entity& entity = hexes_.mesh.entities[e];
      if (entity.role != Role::fault) continue;
      fault_of_entity[e] = static_cast<std::uint32_t>(out.faults.size());
      out.faults.push_back({entity.name, 1});
      for (const FaultTransmissibility& fault : multipliers)
        if (fault.fault == entity.name) out.faults.back().multiplier = fault.multiplier;
    }
    for (const CellContact& contact : contacts) {
      const std::uint32_t a = cell_of_hex_[contact.cell_0], b = cell_of_hex_[contact.cell_1];
      const std::uint32_t fault = contact.fault == no_index ? no_index : fault_of_entity[contact.fault];
      if (piece_of_hex_[contact.cell_0] == piece_of_hex_[contact.cell_1] && are_neighbours(a, b)) {
        ++out.report.index_contacts;
        // One of both sides: simulators multiply by the numbers of both.
        if (fault != no_index) {
          const auto p = out.grid.indices(std::min(a, b)), q = out.grid.indices(std::max(a, b));
          const bool along_i = p[1] == q[1];
          const std::uint32_t lower = (along_i ? p[0] < q[0] : p[1] < q[1]) ? std::min(a, b) : std::max(a, b);
          out.fault_faces.push_back({fault, lower, along_i ? CellFace::i_high : CellFace::j_high});
        }
        continue;
      }
      const bool is_vertical = contact.side_0 >= 4;
      CellConnection connection{std::min(a, b), std::max(a, b), fault, is_vertical, length(contact.area), 0};
      const double half_0 = half_transmissibility(contact.cell_0, contact.side_0, contact.area);
      const double half_1 = half_transmissibility(contact.cell_1, contact.side_1, contact.area);
      if (half_0 > 0 && half_1 > 0) connection.transmissibility = darcy_unit / (1 / half_0 + 1 / half_1);
      if (fault != no_index) connection.transmissibility *= out.faults[fault].multiplier;
      ++(is_vertical         ? out.report.vertical_connections
         : fault != no_index ? out.report.fault_connections
                             : out.report.lateral_connections);
      out.connections.push_back(connection);
    }
    std::sort(out.connections.begin(), out.connections.end(), [](const CellConnection& a, const CellConnection& b) {
      return std::tie(a.cell_0, a.cell_1, a.fault, a.area_m2) < std::tie(b.cell_0, b.cell_1, b.fault, b.area_m2);
    });
    const auto key = [](const FaultFace& f) { return std::tuple{f.fault, f.face, f.cell}; };
    std::sort(out.fault_faces.begin(), out.fault_faces.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto last = std::unique(out.fault_faces.begin(), out.fault_faces.end(),
                                  [&](const auto& a, const auto& b) { return key(a) == key(b); });
    out.fault_faces.erase(last, out.fault_faces.end());
  }

  void report() {
    SimulationGridReport& report = out.report;
    report.layout = placement_.layout;
    report.reason = placement_.reason;
    report.blocks = static_cast<std::uint32_t>(placement_.pieces.size());
    std::vector<std::uint32_t> pieces_of_block(placement_.blocks.size());
    std::uint64_t columns = 0;
    for (const ColumnPiece& piece : placement_.pieces) {
      const auto& quads = placement_.blocks[piece.block].quads;
      const auto own = static_cast<std::uint64_t>(quads.size()) -
                       static_cast<std::uint64_t>(std::count(quads.begin(), quads.end(), no_index));
      columns += own;
      if (++pieces_of_block[piece.block] == 2) report.split_columns += static_cast<std::uint32_t>(own);
    }
    report.occupancy_ratio = static_cast<double>(columns) / (double{1} * out.grid.size[0] * out.grid.size[1]);
    struct Error {
      double deviation = 0, volume = 0, difference = 0;
    };
    const auto errors = parallel_map(
        hexes_.mesh.cell_count(),
        [&](std::size_t hex) {
          Error error;
          if (hexes_.is_dead[hex]) return error;
          const auto own = hex_corners(hex), written = corners_in_grid(hex);
          for (int v = 0; v < 8; ++v) error.deviation = std::max(error.deviation, length(own[v] - written[v]));
          error.volume = cell_volume(CellType::hexahedron, own);
          error.difference = cell_volume(CellType::hexahedron, written) - error.volume;
          return error;
        },
        1024);
    double volume = 0, difference = 0;
    for (std::size_t hex = 0; hex < errors.size(); ++hex) {
      ++(hexes_.is_dead[hex] ? report.dead_cells : report.active_cells);
      volume += errors[hex].volume, difference += errors[hex].difference;
      report.largest_deviation_m = std::max(report.largest_deviation_m, errors[hex].deviation);
      if (errors[hex].volume > 0)
        report.largest_volume_error_ratio =
            std::max(report.largest_volume_error_ratio, std::abs(errors[hex].difference) / errors[hex].volume);
    }
    report.volume_error_ratio = volume > 0 ? difference / volume : 0;
  }

  SimulationGrid out;

 private:
  std::array<Vec3, 8> hex_corners(std::size_t hex) const {
    std::array<Vec3, 8> corners;
    for (int v = 0; v < 8; ++v)
      corners[v] = hexes_.mesh.points[hexes_.mesh.cell_vertices[hexes_.mesh.cell_offsets[hex] + v]];
    return corners;
  }
  /// The corners of a hexahedron as the grid has them, in the hexahedron's own order.
  std::array<Vec3, 8> corners_in_grid(std::size_t hex) const {
    const auto there = out.grid.corners_of(cell_of_hex_[hex]);
    std::array<Vec3, 8> corners;
    for (std::uint32_t v = 0; v < 8; ++v) corners[(turn_of_hex_[hex] + v) % 4 + (v & 4)] = there[v];
    return corners;
  }

  bool are_neighbours(std::uint32_t a, std::uint32_t b) const {
    const auto p = out.grid.indices(a), q = out.grid.indices(b);
    const auto apart = [&](int axis) { return p[axis] > q[axis] ? p[axis] - q[axis] : q[axis] - p[axis]; };
    return apart(0) + apart(1) <= 1;  // a pair in one column has only dead cells between
  }

  double half_transmissibility(std::uint32_t hex, std::uint32_t side, const Vec3& area) const {
    Vec3 cell_middle, side_middle;
    for (const Vec3& corner : hex_corners(hex)) cell_middle = cell_middle + 0.125 * corner;
    for (const Vec3& corner : side_corners(hexes_.mesh, hex, side)) side_middle = side_middle + 0.25 * corner;
    const Vec3 way = side_middle - cell_middle;
    const RegionRock& rock = out.rock[static_cast<std::size_t>(hexes_.mesh.cell_region[hex])];
    const double permeability = side >= 4 ? rock.permeability_vertical_md : rock.permeability_lateral_md;
    const double square = dot(way, way);
    return square > 0 ? permeability * std::abs(dot(area, way)) / square : 0;
  }

  /// Simulators tell right from left by the pillars at three corners of the index box. In a row of columns the first is
  /// turned so that they span something.
  void turn_first_column() {
    if (placement_.layout != "unstructured") return;
    const ColumnPiece &first = placement_.pieces.front(), &last = placement_.pieces.back();
    PlanBlock& block = placement_.blocks[first.block];
    const auto pillar = [&](const ColumnPiece& piece, std::uint32_t i, std::uint32_t j) {
      return straight_pillar(
                 points_on_pillar(hexes_, cells_, placement_.blocks[piece.block], i, j, piece.low, piece.high))
          .upper;
    };
    double best = 0;
    std::uint32_t best_turn = 0;
    for (std::uint32_t turn = 0; turn < 4; ++turn) {
      block.turns[0] = turn;
      const double spanned =
          cross(pillar(last, 1, 0) - pillar(first, 0, 0), pillar(first, 0, 1) - pillar(first, 0, 0)).z;
      if (spanned > best) best = spanned, best_turn = turn;
    }
    block.turns[0] = best_turn;
  }

  void set_pillars() {
    CornerPointGrid& grid = out.grid;
    const std::size_t count = std::size_t{grid.size[0] + 1} * (grid.size[1] + 1);
    grid.pillars.assign(2 * count, {});
    std::vector<std::uint8_t> is_set(count);
    std::array<std::uint32_t, 2> first_column{no_index, no_index};  // J, I
    for (std::size_t p = 0; p < placement_.pieces.size(); ++p) {
      const ColumnPiece& piece = placement_.pieces[p];
      const PlanBlock& block = placement_.blocks[piece.block];
      for (std::uint32_t j = 0; j <= block.size[1]; ++j)
        for (std::uint32_t i = 0; i <= block.size[0]; ++i) {
          const auto points = points_on_pillar(hexes_, cells_, block, i, j, piece.low, piece.high);
          if (i < block.size[0] && j < block.size[1] && block.quad(i, j) != no_index)
            first_column =
                std::min(first_column, {placement_.packing.places[p][1] + j, placement_.packing.places[p][0] + i});
          if (points.empty()) continue;
          const StraightPillar pillar = straight_pillar(points);
          const std::size_t place =
              grid.pillar(placement_.packing.places[p][0] + i, placement_.packing.places[p][1] + j);
          grid.pillars[2 * place] = pillar.upper, grid.pillars[2 * place + 1] = pillar.lower;
          is_set[place] = 1;
        }
    }
    // No cell stands on the others. Most copy the one before; the corners of the box go on from the first column.
    std::size_t first = 0;
    while (first < count && !is_set[first]) ++first;
    for (std::size_t place = 0; place < count; ++place)
      if (!is_set[place]) {
        const std::size_t from = place > first ? place - 1 : first;
        grid.pillars[2 * place] = grid.pillars[2 * from], grid.pillars[2 * place + 1] = grid.pillars[2 * from + 1];
      }
    const Vec3 at = grid.pillars[2 * grid.pillar(first_column[1], first_column[0])];
    const Vec3 along_i = grid.pillars[2 * grid.pillar(first_column[1] + 1, first_column[0])] - at;
    const Vec3 along_j = grid.pillars[2 * grid.pillar(first_column[1], first_column[0] + 1)] - at;
    for (const auto [i, j] : {std::array{0u, 0u}, std::array{grid.size[0], 0u}, std::array{0u, grid.size[1]}}) {
      const std::size_t corner = grid.pillar(i, j);
      if (is_set[corner]) continue;
      const Vec3 way = (double{1} * i - first_column[1]) * along_i + (double{1} * j - first_column[0]) * along_j;
      grid.pillars[2 * corner] = {at.x + way.x, at.y + way.y, at.z};
      grid.pillars[2 * corner + 1] = grid.pillars[2 * corner] - Vec3{0, 0, 1};
    }
  }

  /// Twice the area that the pillars at three corners of the box span, in plan, relative to the square of its sides.
  double handedness() const {
    const auto& pillars = out.grid.pillars;
    const Vec3 i = pillars[2 * out.grid.pillar(out.grid.size[0], 0)] - pillars[0];
    const Vec3 j = pillars[2 * out.grid.pillar(0, out.grid.size[1])] - pillars[0];
    const double spanned = i.x * j.y - i.y * j.x;
    return spanned > 1e-9 * (i.x * i.x + i.y * i.y + j.x * j.x + j.y * j.y) ? spanned : 0;
  }

  void set_cells() {
    CornerPointGrid& grid = out.grid;
    grid.is_active.assign(grid.cell_count(), 0);
    grid.corner_z.assign(8 * grid.cell_count(), 0);
    out.hex_of_cell.assign(grid.cell_count(), no_index);
    out.cell_region.assign(grid.cell_count(), -1);
    cell_of_hex_.assign(hexes_.mesh.cell_count(), no_index);
    piece_of_hex_ = turn_of_hex_ = cell_of_hex_;
    has_column_.assign(std::size_t{grid.size[0]} * grid.size[1], 0);
    for (std::uint32_t p = 0; p < placement_.pieces.size(); ++p) {
      const ColumnPiece& piece = placement_.pieces[p];
      const PlanBlock& block = placement_.blocks[piece.block];
      for (std::uint32_t j = 0; j < block.size[1]; ++j)
        for (std::uint32_t i = 0; i < block.size[0]; ++i)
          if (block.quad(i, j) != no_index)
            set_column(p, piece, block.quad(i, j), block.turn(i, j), placement_.packing.places[p][0] + i,
                       placement_.packing.places[p][1] + j);
    }
  }

  void set_column(std::uint32_t p, const ColumnPiece& piece, std::uint32_t quad, std::uint32_t turn, std::uint32_t i,
                  std::uint32_t j) {
    CornerPointGrid& grid = out.grid;
    has_column_[i + std::size_t{grid.size[0]} * j] = 1;
    // As near to the place of their layers as the height of the box lets.
    const std::uint32_t above = std::min(hexes_.layers - piece.high, placement_.height - (piece.high - piece.low));
    for (std::uint32_t k = 0; k < placement_.height; ++k) {
      const bool is_over = k < above, is_under = k >= above + piece.high - piece.low;
      // Places above and below the piece have no height.
      const std::uint32_t layer = is_over ? piece.high - 1 : is_under ? piece.low : piece.high - 1 - (k - above);
      const std::uint32_t hex = cells_[std::size_t{quad} * hexes_.layers + layer];
      const std::uint32_t* vertices = &hexes_.mesh.cell_vertices[hexes_.mesh.cell_offsets[hex]];
      for (std::uint32_t c = 0; c < 4; ++c) {
        const std::uint32_t own = (turn + c) % 4;
        const double bottom = hexes_.mesh.points[vertices[own]].z, top = hexes_.mesh.points[vertices[own + 4]].z;
        grid.corner_z[grid.corner({i, j, k}, corner_i[c], corner_j[c], 0)] = is_under ? bottom : top;
        grid.corner_z[grid.corner({i, j, k}, corner_i[c], corner_j[c], 1)] = is_over ? top : bottom;
      }
      if (is_over || is_under) continue;
      const std::size_t cell = grid.cell(i, j, k);
      out.hex_of_cell[cell] = hex;
      cell_of_hex_[hex] = static_cast<std::uint32_t>(cell);
      piece_of_hex_[hex] = p;
      turn_of_hex_[hex] = turn;
      if (hexes_.is_dead[hex]) continue;
      grid.is_active[cell] = 1;
      out.cell_region[cell] = hexes_.mesh.cell_region[hex];
    }
  }

  /// Corners of empty columns take the heights of a column on the same pillar, so that viewers show no gaps.
  void fill_empty_columns() {
    CornerPointGrid& grid = out.grid;
    const double anywhere = grid.corner_z.empty() ? 0 : hexes_.mesh.points[hexes_.mesh.cell_vertices[0]].z;
    for (std::uint32_t j = 0; j < grid.size[1]; ++j)
      for (std::uint32_t i = 0; i < grid.size[0]; ++i) {
        if (has_column_[i + std::size_t{grid.size[0]} * j]) continue;
        for (std::uint32_t c = 0; c < 4; ++c) {
          const std::uint32_t node_i = i + corner_i[c], node_j = j + corner_j[c];
          std::uint32_t from_i = no_index, from_j = 0, from_c = 0;
          for (std::uint32_t d = 0; d < 4 && from_i == no_index; ++d) {
            if (node_i < corner_i[d] || node_j < corner_j[d]) continue;
            const std::uint32_t other_i = node_i - corner_i[d], other_j = node_j - corner_j[d];
            if (other_i < grid.size[0] && other_j < grid.size[1] &&
                has_column_[other_i + std::size_t{grid.size[0]} * other_j])
              from_i = other_i, from_j = other_j, from_c = d;
          }
          for (std::uint32_t k = 0; k < grid.size[2]; ++k)
            for (std::uint32_t dk = 0; dk < 2; ++dk)
              grid.corner_z[grid.corner({i, j, k}, corner_i[c], corner_j[c], dk)] =
                  from_i == no_index
                      ? anywhere
                      : grid.corner_z[grid.corner({from_i, from_j, k}, corner_i[from_c], corner_j[from_c], dk)];
        }
      }
  }

  const HexGrid& hexes_;
  const std::vector<std::uint32_t>& cells_;
  ColumnPlacement& placement_;
  std::vector<std::uint32_t> cell_of_hex_, piece_of_hex_, turn_of_hex_;
  std::vector<std::uint8_t> has_column_;  ///< per column of the box
};
}  // namespace

Result<SimulationGrid> build_simulation_grid(const HexGrid& hexes, const std::vector<RegionRock>& rock,
                                             const std::vector<FaultTransmissibility>& faults,
                                             const SimulationGridOptions& options) {
  const auto cells = cells_by_column(hexes);
  if (!cells) return cells.failure();
  if (cells->empty())
    return Failure{FailureCode::invalid_input, "the grid has no cells", "check the model and the edge length"};
  if (const auto checked = check_options(hexes, rock, faults, options); !checked) return checked.failure();
  const auto opposite = opposite_half_edges(hexes.plan);
  if (!opposite) return opposite.failure();
  const double tolerance_m = options.pillar_tolerance_m.value_or(0.01 * mean_edge_length(hexes.plan));
  auto placement = place_columns(hexes, *cells, *opposite, options.layout, tolerance_m);
  if (!placement) return placement.failure();
  SimulationGridBuilder builder(hexes, *cells, *placement);
  builder.out.rock = rock;
  if (const auto built = builder.build_grid(options.most_places); !built) return built.failure();
  builder.connect(find_cell_contacts(hexes, *cells, *opposite), faults);
  builder.report();
  return std::move(builder.out);
}

}  // namespace strataflow
