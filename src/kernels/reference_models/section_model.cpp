#include "kernels/reference_models/section_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {

Vec3 SectionModel::at(std::uint32_t block, const MapPoint& p, double z_m) const {
  // On a branch line the closed block's both sides are one point, which lies outside the numbers of the far block.
  const double share = std::clamp(p.a - block, 0.0, 1.0);
  const double x = line_x(block, p.b, z_m) * (1 - share) + line_x(block + 1, p.b, z_m) * share;
  return {x + p.shift_m, p.b, z_m};
}

double SectionModel::height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const {
  if (level == 0) return box.low.z;
  if (level + 1 == blocks[block].size()) return box.high.z;
  // Columns lean less than surfaces are flat, so that this contracts.
  const double share = std::clamp(p.a - block, 0.0, 1.0);
  double z = 0.5 * (box.low.z + box.high.z);
  for (int step = 0; step < 200; ++step) {
    const double next = surface_z(block, level, share, at(block, p, z).x, p.b, z);
    if (next == z) break;
    z = next;
  }
  return z;
}

std::array<double, 2> SectionModel::fault_span(const SectionFault& fault, double y) const {
  const std::uint32_t block = fault.line - 1;
  const auto& levels = blocks[block];
  for (std::uint32_t l = 0; l < levels.size(); ++l)
    if (levels[l].cut == Cut::cutter) return {box.low.z, height(block, l, {double(fault.line), y, 0})};
  return {box.low.z, box.high.z};
}

void SectionModel::close_with_box(std::uint32_t number_of_blocks, const std::vector<Level>& inner) {
  top_entity = static_cast<std::uint32_t>(entities.size());
  for (const char* side : {"Top", "Bottom", "North", "South", "East", "West"})
    entities.push_back({side, Role::boundary});
  std::vector<Level> levels{{top_entity + 1, Cut::plain}};
  levels.insert(levels.end(), inner.begin(), inner.end());
  levels.push_back({top_entity, Cut::plain});
  blocks.assign(number_of_blocks, levels);
}

std::vector<double> SectionModel::rows(double edge_m) const {
  std::vector<double> rows;
  for (std::size_t k = 0; k + 1 < row_breaks.size(); ++k) {
    const double from = row_breaks[k], to = row_breaks[k + 1];
    const double count = std::max(2.0, std::round((to - from) / edge_m));
    for (double i = 0; i < count; ++i) rows.push_back(from + (to - from) * (i / count));
  }
  rows.push_back(row_breaks.back());
  return rows;
}

std::uint32_t SectionModel::columns_in(std::uint32_t block, double edge_m) const {
  const double z = 0.5 * (box.low.z + box.high.z);
  const double width = line_x(block + 1, box.high.y, z) - line_x(block, box.high.y, z);
  return static_cast<std::uint32_t>(std::max(2.0, std::round(width / edge_m)));
}

/// A block has no width south of the line where the two faults beside it join.
bool SectionModel::is_closed(std::uint32_t block, double y) const {
  return line_x(block, y, box.low.z) == line_x(block + 1, y, box.low.z);
}

ColumnMap SectionModel::map(double edge_m) const {
  ColumnMap map;
  const std::vector<double> y = rows(edge_m);
  const auto row_count = static_cast<std::uint32_t>(y.size());
  std::vector<std::uint32_t> column_block, line_column{0};
  for (std::uint32_t block = 0; block < block_count(); ++block) {
    column_block.insert(column_block.end(), columns_in(block, edge_m), block);
    line_column.push_back(static_cast<std::uint32_t>(column_block.size()));
  }
  const auto column_count = static_cast<std::uint32_t>(column_block.size()) + 1;
  std::vector<std::uint32_t> number(std::size_t{column_count} * row_count);
  for (std::uint32_t j = 0; j < row_count; ++j) {
    for (std::uint32_t i = 0; i < column_count; ++i) {
      std::uint32_t& point = number[std::size_t{j} * column_count + i];
      const std::uint32_t block = column_block[i == 0 ? 0 : i - 1];
      if (i > 0 && is_closed(block, y[j])) {
        point = number[std::size_t{j} * column_count + i - 1];
        continue;
      }
      point = static_cast<std::uint32_t>(map.points.size());
      const std::uint32_t first = line_column[block], count = line_column[block + 1] - first;
      map.points.push_back({block + double(i - first) / count, y[j], 0});
    }
  }
  const auto at_grid = [&](std::uint32_t i, std::uint32_t j) { return number[std::size_t{j} * column_count + i]; };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t block) {
    if (a != b && b != c && c != a) map.triangles.push_back({{a, b, c}, block});
  };
  for (std::uint32_t j = 0; j + 1 < row_count; ++j) {
    for (std::uint32_t i = 0; i + 1 < column_count; ++i) {
      const std::uint32_t a = at_grid(i, j), b = at_grid(i + 1, j), c = at_grid(i + 1, j + 1), d = at_grid(i, j + 1);
      add(a, b, c, column_block[i]);
      add(a, c, d, column_block[i]);
    }
  }
  const std::array<double, 2> bottom{box.low.z, box.low.z}, top{box.high.z, box.high.z};
  const std::uint32_t north = top_entity + 2, south = top_entity + 3, east = top_entity + 4, west = top_entity + 5;
  for (std::uint32_t i = 0; i + 1 < column_count; ++i) {
    for (const auto& [entity, j] : {std::pair{south, 0u}, std::pair{north, row_count - 1}})
      if (at_grid(i, j) != at_grid(i + 1, j))
        map.walls.push_back({{at_grid(i, j), at_grid(i + 1, j)}, entity, bottom, top});
  }
  for (std::uint32_t j = 0; j + 1 < row_count; ++j)
    for (const auto& [entity, i] : {std::pair{west, 0u}, std::pair{east, column_count - 1}})
      map.walls.push_back({{at_grid(i, j), at_grid(i, j + 1)}, entity, bottom, top});
  for (const SectionFault& fault : faults) {
    const std::uint32_t i = line_column[fault.line];
    for (std::uint32_t j = 0; j + 1 < row_count; ++j) {
      if (y[j] < fault.south_m || y[j + 1] > fault.north_m) continue;
      const auto here = fault_span(fault, y[j]), next = fault_span(fault, y[j + 1]);
      map.walls.push_back({{at_grid(i, j), at_grid(i, j + 1)}, fault.entity, {here[0], next[0]}, {here[1], next[1]}});
    }
  }
  return map;
}

/// The raw surfaces of a section model. Gaps (and overshoots) are the share `ratio` of: the width of the block
/// (horizon to fault, horizon to west and east side), the length along the strike (to south and north side, to a
/// branch line), the height of the fault, or the largest clearance under a cutter.
class RawSections {
 public:
  RawSections(const SectionModel& model, double edge_m, double ratio)
      : model_(model), edge_m_(edge_m), ratio_(ratio), sheets_(model.entities) {}

  TriangleSoup build() {
    for (std::uint32_t level = 1; level + 1 < model_.blocks[0].size(); ++level) add_level(level);
    for (const SectionFault& fault : model_.faults) add_fault(fault);
    sheets_.add_box_sides(model_.top_entity, model_.box.low, model_.box.high, edge_m_);
    return sheets_.take();
  }

 private:
  // Each kind of surface has its own mesh size, so that meshes do not match by chance.
  double horizon_edge_m() const { return 1.07 * edge_m_; }
  double fault_edge_m() const { return 0.93 * edge_m_; }

  /// The fault that separates the blocks beside `line` at a row of a level, not counting a tip.
  bool is_apart(std::uint32_t line, double row, const Level& level) const {
    const double y = std::clamp(row, model_.box.low.y, model_.box.high.y);  // rows may overshoot the box
    for (const SectionFault& fault : model_.faults) {
      if (fault.line != line || !model_.cuts_level(fault, level)) continue;
      const bool after_south = fault.touches_south ? y >= fault.south_m : y > fault.south_m;
      const bool before_north = fault.touches_north ? y <= fault.north_m : y < fault.north_m;
      if (after_south && before_north) return true;
    }
    // South of a branch line the block between has no width: its other side is the same line.
    return line > 1 && model_.is_closed(line - 1, y) && is_apart(line - 1, y, level);
  }

  /// The widest a block gets.
  double width_m(std::uint32_t block) const {
    const double z = 0.5 * (model_.box.low.z + model_.box.high.z), y = model_.box.high.y;
    return model_.line_x(block + 1, y, z) - model_.line_x(block, y, z);
  }

  /// Where block `block` starts along the strike: the south side, or the branch line that closes it.
  double south_end(std::uint32_t block, double south) const {
    if (!model_.is_closed(block, south)) return south;
    double closed = south, open = model_.box.high.y;
    for (int step = 0; step < 80; ++step)
      (model_.is_closed(block, 0.5 * (closed + open)) ? closed : open) = 0.5 * (closed + open);
    return closed;
  }

  /// The rows of a sheet from `south` to `north`, its ends moved by the gap where they touch something.
  std::vector<double> rows_between(double south, double north, bool touches_south, bool touches_north,
                                   double edge_m) const {
    std::vector<double> rows;
    for (const double y : model_.rows(edge_m))
      if (y > south && y < north) rows.push_back(y);
    const double gap = ratio_ * (north - south);
    const double first = touches_south ? south + gap : south, last = touches_north ? north - gap : north;
    // Rows next to a moved end would make slivers; those that must exist stay.
    const auto is_free = [&](double y) {
      return std::count(model_.row_breaks.begin(), model_.row_breaks.end(), y) == 0;
    };
    const auto margin = [&](double y) { return is_free(y) ? 0.3 * edge_m : 0.0; };
    while (!rows.empty() && rows.front() <= first + margin(rows.front())) rows.erase(rows.begin());
    while (!rows.empty() && rows.back() >= last - margin(rows.back())) rows.pop_back();
    rows.insert(rows.begin(), first);
    rows.push_back(last);
    return rows;
  }

  /// The map point of column `i` of `count` in a block, moved off the contacts west and east of it.
  MapPoint placed(std::uint32_t block, double y, std::uint32_t i, std::uint32_t count, bool west, bool east) const {
    const double share = double(i) / count;
    if (ratio_ >= 0) {
      const double from = west ? ratio_ : 0, to = east ? 1 - ratio_ : 1;
      return {block + (from * (1 - share) + to * share), y, 0};
    }
    const double reach = -ratio_ * width_m(block);
    return {block + share, y, (east ? reach * share : 0) - (west ? reach * (1 - share) : 0)};
  }

  void add_level(std::uint32_t level) {
    const Level& what = model_.blocks[0][level];
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<double> clearance;
    std::vector<std::uint32_t> west_side;  // the points of the block before on the line that is next
    std::uint32_t cutter = 0;
    for (std::uint32_t l = 0; l < model_.blocks[0].size(); ++l)
      if (model_.blocks[0][l].cut == Cut::cutter) cutter = l;
    const bool is_cut = what.cut == Cut::below_cutter || what.cut == Cut::above_cutter;
    for (std::uint32_t block = 0; block < model_.block_count(); ++block) {
      const std::vector<double> y =
          rows_between(south_end(block, model_.box.low.y), model_.box.high.y, true, true, horizon_edge_m());
      const std::uint32_t count = model_.columns_in(block, horizon_edge_m());
      std::vector<std::uint32_t> east_side, number((count + 1) * y.size());
      for (std::size_t j = 0; j < y.size(); ++j) {
        const bool west = block == 0 || is_apart(block, y[j], what);
        const bool east = block + 1 == model_.block_count() || is_apart(block + 1, y[j], what);
        for (std::uint32_t i = 0; i <= count; ++i) {
          std::uint32_t& point = number[j * (count + 1) + i];
          if (i == 0 && !west) {
            point = west_side[j];
            continue;
          }
          const MapPoint p = placed(block, y[j], i, count, west, east);
          const double z = model_.height(block, level, p);
          point = static_cast<std::uint32_t>(points.size());
          points.push_back(model_.at(block, p, z));
          const double gap = is_cut ? model_.height(block, cutter, p) - z : 1.0;
          clearance.push_back(what.cut == Cut::above_cutter ? -gap : gap);
        }
        east_side.push_back(number[j * (count + 1) + count]);
      }
      for (std::uint32_t j = 0; j + 1 < y.size(); ++j) {
        for (std::uint32_t i = 0; i < count; ++i) {
          const std::uint32_t a = number[j * (count + 1) + i], b = number[j * (count + 1) + i + 1];
          const std::uint32_t c = number[(j + 1) * (count + 1) + i + 1], d = number[(j + 1) * (count + 1) + i];
          for (const Triangle& t : {Triangle{a, b, c}, Triangle{a, c, d}})
            if (length(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) > 0) triangles.push_back(t);
        }
      }
      west_side = east_side;
    }
    if (!is_cut) return sheets_.add_sheet(what.entity, points, triangles);
    const double extent = *std::max_element(clearance.begin(), clearance.end());
    for (double& gap : clearance) gap -= ratio_ * extent;
    sheets_.add_clipped_sheet(what.entity, points, triangles, clearance);
  }

  void add_fault(const SectionFault& fault) {
    const std::vector<double> y =
        rows_between(fault.south_m, fault.north_m, fault.touches_south, fault.touches_north, fault_edge_m());
    const double height = model_.box.high.z - model_.box.low.z;
    const auto count = static_cast<std::uint32_t>(std::max(3.0, std::round(height / fault_edge_m())));
    sheets_.add_grid(
        fault.entity, count + 1, static_cast<std::uint32_t>(y.size()), [&](std::uint32_t i, std::uint32_t j) {
          const auto span = model_.fault_span(fault, y[j]);
          const double share = double(i) / count;
          const double from = fault.touches_below ? ratio_ : 0, to = fault.touches_above ? 1 - ratio_ : 1;
          const double z = span[0] + (span[1] - span[0]) * (from * (1 - share) + to * share);
          const auto on_line = [&](double row) { return model_.at(fault.line - 1, {double(fault.line), row, 0}, z); };
          const bool is_past_branch = y[j] < fault.south_m && fault.south_m > model_.box.low.y;
          if (!is_past_branch) return on_line(y[j]);
          // Straight on through the fault it branches from, which it would follow otherwise.
          return 2.0 * on_line(fault.south_m) - on_line(2 * fault.south_m - y[j]);
        });
  }

  const SectionModel& model_;
  double edge_m_, ratio_;
  SheetSoup sheets_;
};

TriangleSoup SectionModel::raw_surfaces(double edge_m, double ratio) const {
  return RawSections(*this, edge_m, ratio).build();
}

}  // namespace strataflow
