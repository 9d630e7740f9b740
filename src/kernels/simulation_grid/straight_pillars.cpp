#include "kernels/simulation_grid/straight_pillars.h"

#include <algorithm>
#include <cmath>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {
/// The corner of a place's cells that the pillar (i, j) stands on, by where the place lies from it.
std::uint32_t place_corner(std::uint32_t di, std::uint32_t dj) { return dj == 0 ? di : 3 - di; }

/// Whether the corners of layers [low, high) lie on straight pillars at every place between a block's columns.
bool is_straight(const HexGrid& hexes, const std::vector<std::uint32_t>& cells, const PlanBlock& block,
                 std::uint32_t low, std::uint32_t high, double tolerance_m) {
  constexpr std::uint32_t grain = 64;
  const std::uint32_t width = block.size[0] + 1, count = width * (block.size[1] + 1);
  const auto bent = parallel_map((count + grain - 1) / grain, [&](std::size_t chunk) {
    const auto first = static_cast<std::uint32_t>(chunk) * grain;
    for (std::uint32_t p = first; p < std::min(count, first + grain); ++p)
      if (straight_pillar(points_on_pillar(hexes, cells, block, p % width, p / width, low, high)).deviation_m >
          tolerance_m)
        return 1;
    return 0;
  });
  return std::find(bent.begin(), bent.end(), 1) == bent.end();
}

/// Where to cut; empty when a layer by itself is not straight.
std::vector<std::uint32_t> cut_levels(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                      const PlanBlock& block, double tolerance_m, std::uint32_t most_layers) {
  std::vector<std::uint32_t> levels{0};
  while (levels.back() < hexes.layers) {
    const std::uint32_t low = levels.back(), most = std::min(hexes.layers - low, most_layers) + low;
    const auto is_straight_to = [&](std::uint32_t level) {
      return is_straight(hexes, cells, block, low, level, tolerance_m);
    };
    // A part of what is straight need not be straight by itself: first the whole is asked for, then ever more.
    std::uint32_t high = low == 0 && is_straight_to(most) ? most : low;
    while (high < most && is_straight_to(high + 1)) ++high;
    if (high == low) {
      if (block.quads.size() > 1) return {};
      ++high;  // the four edges of one cell: straight by themselves, or nearly horizontal
    }
    levels.push_back(high);
  }
  return levels;
}
}  // namespace

StraightPillar straight_pillar(const std::vector<Vec3>& points) {
  StraightPillar pillar;
  if (points.empty()) return pillar;
  const auto by_height = [](const Vec3& a, const Vec3& b) {
    return a.z != b.z ? a.z < b.z : lexicographically_less(a, b);
  };
  pillar.upper = *std::max_element(points.begin(), points.end(), by_height);
  pillar.lower = *std::min_element(points.begin(), points.end(), by_height);
  const double height = pillar.upper.z - pillar.lower.z;
  // Points at one height but for rounding say nothing about a direction.
  if (!(height > 1e-9 * (1 + std::abs(pillar.upper.z)))) pillar.lower = pillar.upper - Vec3{0, 0, 1};
  const Vec3 down = pillar.lower - pillar.upper;
  double square = 0;
  for (const Vec3& point : points) {
    const double t = (point.z - pillar.upper.z) / down.z;
    const double x = pillar.upper.x + t * down.x - point.x, y = pillar.upper.y + t * down.y - point.y;
    square = std::max(square, x * x + y * y);
  }
  pillar.deviation_m = std::sqrt(square);
  return pillar;
}

std::vector<Vec3> points_on_pillar(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                   const PlanBlock& block, std::uint32_t i, std::uint32_t j, std::uint32_t low,
                                   std::uint32_t high) {
  std::vector<Vec3> points;
  points.reserve(8 * std::size_t{high - low});
  for (std::uint32_t dj = 0; dj < 2; ++dj)
    for (std::uint32_t di = 0; di < 2; ++di) {
      if (i < di || j < dj || i - di >= block.size[0] || j - dj >= block.size[1]) continue;
      const std::uint32_t quad = block.quad(i - di, j - dj);
      if (quad == no_index) continue;
      const std::uint32_t corner = (block.turn(i - di, j - dj) + place_corner(di, dj)) % 4;
      for (std::uint32_t layer = low; layer < high; ++layer) {
        const std::uint32_t cell = cells[std::size_t{quad} * hexes.layers + layer];
        const std::uint32_t* vertices = &hexes.mesh.cell_vertices[hexes.mesh.cell_offsets[cell]];
        points.push_back(hexes.mesh.points[vertices[corner]]);
        points.push_back(hexes.mesh.points[vertices[corner + 4]]);
      }
    }
  return points;
}

std::vector<ColumnPiece> split_at_bent_pillars(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                               std::vector<PlanBlock>& blocks, double tolerance_m,
                                               std::uint32_t most_layers) {
  const auto cut_all = [&](const std::vector<PlanBlock>& all) {
    return parallel_map(
        all.size(), [&](std::size_t b) { return cut_levels(hexes, cells, all[b], tolerance_m, most_layers); }, 16);
  };
  auto levels = cut_all(blocks);
  if (std::any_of(levels.begin(), levels.end(), [](const auto& cuts) { return cuts.empty(); })) {
    std::vector<PlanBlock> apart;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (!levels[b].empty()) {
        apart.push_back(std::move(blocks[b]));
        continue;
      }
      for (std::size_t q = 0; q < blocks[b].quads.size(); ++q)
        if (blocks[b].quads[q] != no_index) apart.push_back({{1, 1}, {blocks[b].quads[q]}, {blocks[b].turns[q]}});
    }
    blocks = std::move(apart);
    levels = cut_all(blocks);
  }
  std::vector<ColumnPiece> pieces;
  for (std::uint32_t b = 0; b < blocks.size(); ++b)
    for (std::size_t n = 1; n < levels[b].size(); ++n) pieces.push_back({b, levels[b][n - 1], levels[b][n]});
  return pieces;
}

}  // namespace strataflow
