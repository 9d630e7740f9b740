#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {
namespace {

constexpr Role skin = Role::boundary;
constexpr std::uint32_t none = 0xffffffffu;

std::uint32_t parts_of(double length_m, double edge_m, double least) {
  return static_cast<std::uint32_t>(std::max(least, std::round(length_m / edge_m)));
}

/// A plate with an upright along its western side, a rib between them and four round holes. Columns are vertical.
class Bracket final : public ColumnModel {
 public:
  Bracket() {
    box = {{0, 0, 0}, {200, 120, upright_z}};
    for (const char* face : {"Bottom", "PlateTop", "UprightTop", "RibTop", "Holes", "North", "South", "East", "West",
                             "UprightFront", "RibNorth", "RibSouth"})
      entities.push_back({face, skin});
    const auto of_top = [](std::uint32_t top) { return std::vector<Level>{{bottom, Cut::plain}, {top, Cut::plain}}; };
    blocks = {of_top(plate_top), of_top(upright_top), of_top(rib_top)};
  }

  Vec3 at(std::uint32_t, const MapPoint& p, double z_m) const override { return {p.a, p.b, z_m}; }

  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const override {
    if (level == 0) return 0;
    return block == plate ? plate_z : block == upright ? upright_z : rib_z(p.a);
  }

  ColumnMap map(double edge_m) const override {
    ColumnMap map;
    std::vector<std::array<double, 2>> x = divided(breaks_x, edge_m), y = divided(breaks_y, edge_m);
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> number;
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
      const auto [found, is_new] = number.emplace(std::array{i, j}, static_cast<std::uint32_t>(map.points.size()));
      if (is_new) map.points.push_back({x[i][0], y[j][0], 0});
      return found->second;
    };
    const auto add_quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint32_t block) {
      map.triangles.push_back({{a, b, c}, block});
      map.triangles.push_back({{a, c, d}, block});
    };
    const auto east_end = static_cast<std::uint32_t>(x.size()) - 1,
               north_end = static_cast<std::uint32_t>(y.size()) - 1;
    for (std::uint32_t j = 0; j < north_end; ++j)
      for (std::uint32_t i = 0; i < east_end; ++i) {
        const auto cell_x = static_cast<std::size_t>(x[i][1]), cell_y = static_cast<std::size_t>(y[j][1]);
        if (has_hole(cell_x, cell_y)) continue;
        add_quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1), block_of(cell_x, cell_y));
      }
    for (std::size_t cell_y = 0; cell_y + 1 < breaks_y.size(); ++cell_y)
      for (std::size_t cell_x = 0; cell_x + 1 < breaks_x.size(); ++cell_x) {
        if (!has_hole(cell_x, cell_y)) continue;
        std::vector<std::uint32_t> rim, across, up;  // the square around the hole, counter-clockwise
        for (std::uint32_t i = 0; i <= east_end; ++i)
          if (x[i][0] >= breaks_x[cell_x] && x[i][0] <= breaks_x[cell_x + 1]) across.push_back(i);
        for (std::uint32_t j = 0; j <= north_end; ++j)
          if (y[j][0] >= breaks_y[cell_y] && y[j][0] <= breaks_y[cell_y + 1]) up.push_back(j);
        for (std::size_t i = 0; i + 1 < across.size(); ++i) rim.push_back(point(across[i], up.front()));
        for (std::size_t j = 0; j + 1 < up.size(); ++j) rim.push_back(point(across.back(), up[j]));
        for (std::size_t i = across.size(); i-- > 1;) rim.push_back(point(across[i], up.back()));
        for (std::size_t j = up.size(); j-- > 1;) rim.push_back(point(across.front(), up[j]));
        const double centre_x = 0.5 * (breaks_x[cell_x] + breaks_x[cell_x + 1]);
        const double centre_y = 0.5 * (breaks_y[cell_y] + breaks_y[cell_y + 1]);
        const std::vector<std::uint32_t> square = rim;
        const std::uint32_t rings = parts_of(square_m / 2 - hole_m, edge_m, 1);
        for (std::uint32_t ring = 1; ring <= rings; ++ring) {
          std::vector<std::uint32_t> next;
          for (const std::uint32_t on_square : square) {
            const double dx = map.points[on_square].a - centre_x, dy = map.points[on_square].b - centre_y;
            const double share = double(ring) / rings, inner = hole_m / std::sqrt(dx * dx + dy * dy);
            const double scale = ring == rings ? inner : 1 + share * (inner - 1);
            next.push_back(static_cast<std::uint32_t>(map.points.size()));
            map.points.push_back({centre_x + scale * dx, centre_y + scale * dy, 0});
          }
          for (std::size_t k = 0; k < rim.size(); ++k) {
            const std::size_t after = (k + 1) % rim.size();
            add_quad(rim[k], rim[after], next[after], next[k], plate);
          }
          rim = next;
        }
        for (std::size_t k = 0; k < rim.size(); ++k)
          map.walls.push_back({{rim[k], rim[(k + 1) % rim.size()]}, holes, {0, 0}, {plate_z, plate_z}});
      }
    // A wall wherever neighbouring tops differ, and around the outside.
    const auto add_wall = [&](std::uint32_t a, std::uint32_t b, std::uint32_t low, std::uint32_t high,
                              std::uint32_t entity) {
      Wall wall{{a, b}, entity, {}, {}};
      for (std::size_t k = 0; k < 2; ++k) {
        const MapPoint& p = map.points[wall.ends[k]];
        wall.low_m[k] = low == none ? 0 : height(low, 1, p);
        wall.high_m[k] = height(high, 1, p);
      }
      map.walls.push_back(wall);
    };
    const auto block_at = [&](std::uint32_t i, std::uint32_t j) {
      return block_of(static_cast<std::size_t>(x[i][1]), static_cast<std::size_t>(y[j][1]));
    };
    for (std::uint32_t i = 0; i < east_end; ++i) {
      add_wall(point(i, 0), point(i + 1, 0), none, block_at(i, 0), south);
      add_wall(point(i, north_end), point(i + 1, north_end), none, block_at(i, north_end - 1), north);
      for (std::uint32_t j = 1; j < north_end; ++j) {
        const std::uint32_t below = block_at(i, j - 1), above = block_at(i, j);
        if (below == plate && above == rib) add_wall(point(i, j), point(i + 1, j), plate, rib, rib_south);
        if (below == rib && above == plate) add_wall(point(i, j), point(i + 1, j), plate, rib, rib_north);
      }
    }
    for (std::uint32_t j = 0; j < north_end; ++j) {
      add_wall(point(0, j), point(0, j + 1), none, block_at(0, j), west);
      add_wall(point(east_end, j), point(east_end, j + 1), none, block_at(east_end - 1, j), east);
      for (std::uint32_t i = 1; i < east_end; ++i)
        if (block_at(i - 1, j) == upright && block_at(i, j) != upright)
          add_wall(point(i, j), point(i, j + 1), block_at(i, j), upright, upright_front);
    }
    return map;
  }

  TriangleSoup raw_surfaces(double, double) const override { return {}; }

 private:
  enum Block : std::uint32_t { plate, upright, rib };
  enum Face : std::uint32_t {
    bottom,
    plate_top,
    upright_top,
    rib_top,
    holes,
    north,
    south,
    east,
    west,
    upright_front,
    rib_north,
    rib_south
  };
  static constexpr double plate_z = 12, upright_z = 100, hole_m = 12, square_m = 40, rib_foot_x = 80;
  static constexpr std::array<double, 8> breaks_x{0, 12, 30, 70, rib_foot_x, 130, 170, 200};
  static constexpr std::array<double, 8> breaks_y{0, 7, 47, 54, 66, 73, 113, 120};

  static double rib_z(double x) { return plate_z + (rib_foot_x - x); }
  static bool has_hole(std::size_t cell_x, std::size_t cell_y) {
    return (cell_x == 2 || cell_x == 5) && (cell_y == 1 || cell_y == 5);
  }
  static std::uint32_t block_of(std::size_t cell_x, std::size_t cell_y) {
    return cell_x == 0 ? upright : cell_y == 3 && cell_x <= 3 ? rib : plate;
  }
  /// Coordinates and the number of the interval that starts there.
  static std::vector<std::array<double, 2>> divided(const std::array<double, 8>& breaks, double edge_m) {
    std::vector<std::array<double, 2>> at;
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const double span = breaks[k + 1] - breaks[k];
      const std::uint32_t parts = parts_of(span, edge_m, span == square_m ? 3 : 1);
      for (std::uint32_t i = 0; i < parts; ++i) at.push_back({breaks[k] + span * (double(i) / parts), double(k)});
    }
    at.push_back({breaks.back(), double(breaks.size() - 1)});
    return at;
  }
};

/// A hub with a bore, and seven blades wound around it. A column is the ray from the axis through (a, b) = (part of
/// a turn, z); what the column model calls a height is the distance from the axis.
class Impeller final : public ColumnModel {
 public:
  Impeller() {
    box = {{0, 0, 0}, {200, 200, length_m}};
    for (const char* face : {"Bore", "Hub", "Tips", "Front", "Back", "Pressure", "Suction", "Leading", "Trailing"})
      entities.push_back({face, skin});
    blocks = {{{bore, Cut::plain}, {hub, Cut::plain}}, {{bore, Cut::plain}, {tips, Cut::plain}}};
  }

  Vec3 at(std::uint32_t, const MapPoint& p, double radius_m) const override {
    const Vec3 ray = on_circle(p.a);
    return {100 + radius_m * ray.x, 100 + radius_m * ray.y, p.b};
  }

  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const override {
    if (level == 0) return bore_m;
    const double from_front = 1 - p.b / length_m;  // 0 at the front, 1 at the back
    const double on_hub = 26 + 34 * from_front * from_front;
    return block == of_hub ? on_hub : on_hub + 16 + 8 * (1 - from_front);
  }

  ColumnMap map(double edge_m) const override {
    ColumnMap map;
    std::vector<std::array<double, 2>> rows;  // z, whether blades stand after it
    for (const auto& [from, to, is_bladed] :
         {std::array{0.0, blade_low_m, 0.0}, {blade_low_m, blade_high_m, 1.0}, {blade_high_m, length_m, 0.0}}) {
      const std::uint32_t parts = parts_of(to - from, edge_m, is_bladed > 0 ? 3 : 1);
      for (std::uint32_t k = 0; k < parts; ++k) rows.push_back({from + (to - from) * (double(k) / parts), is_bladed});
    }
    rows.push_back({length_m, 0});
    constexpr double hub_girth = 6.28 * 45;
    const std::uint32_t across = parts_of(blade_share * hub_girth, edge_m, 1);
    const std::uint32_t gap = parts_of((1.0 / blade_count - blade_share) * hub_girth, edge_m, 4);
    const std::uint32_t sector = across + gap, columns = blade_count * sector;
    for (const auto& row : rows)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const double k = i % sector, start = double(i / sector) / blade_count;
        const double share = k <= across ? blade_share * (k / across)
                                         : blade_share + (1.0 / blade_count - blade_share) * ((k - across) / gap);
        map.points.push_back({start + share + twist * (row[0] / length_m), row[0], 0});
      }
    const auto row_count = static_cast<std::uint32_t>(rows.size());
    const auto point = [&](std::uint32_t i, std::uint32_t j) { return j * columns + i % columns; };
    const auto add_wall = [&](std::uint32_t a, std::uint32_t b, std::uint32_t entity, bool is_blade) {
      Wall wall{{a, b}, entity, {}, {}};
      for (std::size_t k = 0; k < 2; ++k) {
        const MapPoint& p = map.points[wall.ends[k]];
        wall.low_m[k] = is_blade ? height(of_hub, 1, p) : bore_m;
        wall.high_m[k] = height(is_blade ? of_blade : of_hub, 1, p);
      }
      map.walls.push_back(wall);
    };
    for (std::uint32_t j = 0; j + 1 < row_count; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const bool is_blade = rows[j][1] > 0 && i % sector < across;
        const std::uint32_t a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
        map.triangles.push_back({{a, b, c}, is_blade ? of_blade : of_hub});
        map.triangles.push_back({{a, c, d}, is_blade ? of_blade : of_hub});
        if (!is_blade) continue;
        if (i % sector == 0) add_wall(a, d, pressure, true);
        if (i % sector + 1 == across) add_wall(b, c, suction, true);
        if (j > 0 && rows[j - 1][1] == 0) add_wall(a, b, trailing, true);
        if (rows[j + 1][1] == 0) add_wall(d, c, leading, true);
      }
    for (std::uint32_t i = 0; i < columns; ++i) {
      add_wall(point(i, 0), point(i + 1, 0), back, false);
      add_wall(point(i, row_count - 1), point(i + 1, row_count - 1), front, false);
    }
    return map;
  }

  TriangleSoup raw_surfaces(double, double) const override { return {}; }

 private:
  enum Block : std::uint32_t { of_hub, of_blade };
  enum Face : std::uint32_t { bore, hub, tips, front, back, pressure, suction, leading, trailing };
  static constexpr double length_m = 80, bore_m = 14, blade_low_m = 10, blade_high_m = 70;
  static constexpr double blade_share = 0.025, twist = 0.2;  // of a turn
  static constexpr std::uint32_t blade_count = 7;

  /// The point of the unit circle after `turn` turns, by the four operations: the same on every machine.
  static Vec3 on_circle(double turn) {
    const double quarters = std::floor(4 * turn + 0.5);
    const double half = (4 * turn - quarters) * 0.78539816339744831, square = half * half;  // half the angle left
    const double t = half * (1 + square * (1.0 / 3 + square * (2.0 / 15 + square * (17.0 / 315))));
    const double x = (1 - t * t) / (1 + t * t), y = 2 * t / (1 + t * t);
    switch (static_cast<int>(quarters) & 3) {
      case 0:
        return {x, y, 0};
      case 1:
        return {-y, x, 0};
      case 2:
        return {-x, -y, 0};
      default:
        return {y, -x, 0};
    }
  }
};

}  // namespace

std::unique_ptr<ColumnModel> bracket() { return std::make_unique<Bracket>(); }
std::unique_ptr<ColumnModel> impeller() { return std::make_unique<Impeller>(); }

}  // namespace strataflow
