#include <algorithm>
#include <cmath>
#include <functional>

#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {
namespace {

constexpr double half_m = 60;      // of the cube
constexpr double roof_rim_m = 60;  // height where the diapir's wall turns into its roof
enum Block : std::uint32_t { inside, outside };
enum Entities : std::uint32_t { h1, h2, h3, body, top, bottom, north, south, east, west };

/// Map coordinates: the square max(|a|, |b|) ≤ 1 becomes the disc of the diapir, the ring out to 2 the rest of the box.
class Diapir final : public ColumnModel {
 public:
  Diapir() {
    box = {{0, 0, 0}, {2 * half_m, 2 * half_m, 2 * half_m}};
    entities = {{"H1", Role::horizon},       {"H2", Role::horizon},     {"H3", Role::horizon},
                {"Diapir", Role::intrusion}, {"Top", Role::boundary},   {"Bottom", Role::boundary},
                {"North", Role::boundary},   {"South", Role::boundary}, {"East", Role::boundary},
                {"West", Role::boundary}};
    const auto plain = [](std::uint32_t entity) { return Level{entity, Cut::plain}; };
    blocks = {{plain(bottom), plain(body), plain(h3), plain(top)},
              {plain(bottom), plain(h1), plain(h2), plain(h3), plain(top)}};
  }

  Vec3 at(std::uint32_t block, const MapPoint& p, double z_m) const override {
    const double ring = std::max(std::abs(p.a), std::abs(p.b));
    if (!(ring > 0)) return {half_m, half_m, z_m};
    const double a = p.a / ring, b = p.b / ring, radius = radius_m(z_m) / std::sqrt(a * a + b * b);
    if (block == inside) return {half_m + a * radius * ring, half_m + b * radius * ring, z_m};
    const double share = ring - 1;
    return {half_m + (a * radius) * (1 - share) + (a * half_m) * share,
            half_m + (b * radius) * (1 - share) + (b * half_m) * share, z_m};
  }

  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const override {
    if (level == 0) return box.low.z;
    if (level + 1 == blocks[block].size()) return box.high.z;
    double z = half_m;
    for (int step = 0; step < 200; ++step) {
      const Vec3 here = at(block, p, z);
      const double from_axis = std::sqrt((here.x - half_m) * (here.x - half_m) + (here.y - half_m) * (here.y - half_m));
      const double next = surface_z(blocks[block][level].entity, from_axis, p);
      if (next == z) break;
      z = next;
    }
    return z;
  }

  ColumnMap map(double edge_m) const override { return ring_map(edge_m, 0, 2); }

  TriangleSoup raw_surfaces(double edge_m, double ratio) const override {
    SheetSoup sheets(entities);
    // Horizons: from the wall (or the axis) to the sides of the box, less the gap.
    for (const std::uint32_t level : {1u, 2u, 3u}) {
      const std::uint32_t entity = blocks[outside][level].entity;
      const ColumnMap sheet = ring_map(1.07 * edge_m, entity == h3 ? 0.0 : 1 + ratio, 2 - ratio);
      add_sheet(sheets, entity, sheet, [&](const MapPoint& p, std::uint32_t block) {
        const std::uint32_t of_block = block == inside && entity == h3 ? 2u : level;
        return at(block, p, height(block, of_block, p));
      });
    }
    // The diapir: its roof, and the wall down to the bottom less the gap, as one sheet.
    const double low = ratio * roof_rim_m;
    const double skirt = std::max(1.0, std::round((roof_rim_m - low) / (0.93 * edge_m)));
    const ColumnMap roof = ring_map(0.93 * edge_m, 0, 1, skirt);
    add_sheet(sheets, body, roof, [&](const MapPoint& p, std::uint32_t) {
      const double ring = std::max(std::abs(p.a), std::abs(p.b));
      if (ring <= 1) return at(inside, p, height(inside, 1, p));
      return at(inside, {p.a / ring, p.b / ring, 0}, roof_rim_m + (low - roof_rim_m) * std::min(1.0, ring - 1));
    });
    sheets.add_box_sides(top, box.low, box.high, edge_m);
    return sheets.take();
  }

 private:
  static double radius_m(double z) { return 18 + 8 * bump((z - 50) / 50); }

  static double surface_z(std::uint32_t entity, double from_axis, const MapPoint& p) {
    const double near = bump(from_axis / 58);
    switch (entity) {
      case h1:
        return 7.5 + 4 * near;
      case h2:
        return 38 + 20 * near;
      case h3:
        return 84 + 14 * near;
      default: {
        const double ring = std::min(1.0, std::max(std::abs(p.a), std::abs(p.b)));
        return roof_rim_m + 14 * (1 - ring * ring);
      }
    }
  }

  /// Concentric squares from `from` (0: a full disc) to `to`, four times `side` points each. `skirt` > 0 adds that many
  /// rings outside, up to 2.
  ColumnMap ring_map(double edge_m, double from, double to, double skirt = 0) const {
    ColumnMap map;
    const auto half = static_cast<std::int32_t>(std::max(2.0, std::round(0.4 * half_m / edge_m)));  // of a side
    const std::int32_t side = 2 * half;
    std::vector<std::uint32_t> rim;  // the last ring, counter-clockwise from the south-west corner
    const auto add_ring = [&](double scale) {
      std::vector<std::uint32_t> ring;
      for (std::int32_t quarter = 0; quarter < 4; ++quarter) {
        for (std::int32_t i = 0; i < side; ++i) {
          const double u = scale * (double(i - half) / half);
          ring.push_back(static_cast<std::uint32_t>(map.points.size()));
          const std::array<MapPoint, 4> on{MapPoint{u, -scale, 0}, {scale, u, 0}, {-u, scale, 0}, {-scale, -u, 0}};
          map.points.push_back(on[static_cast<std::size_t>(quarter)]);
        }
      }
      return ring;
    };
    const auto join = [&](const std::vector<std::uint32_t>& inner, const std::vector<std::uint32_t>& outer) {
      for (std::size_t i = 0; i < inner.size(); ++i) {
        const std::size_t next = (i + 1) % inner.size();
        map.triangles.push_back({{inner[i], outer[i], outer[next]}, outside});
        map.triangles.push_back({{inner[i], outer[next], inner[next]}, outside});
      }
    };
    double start = from;
    if (from > 0) {
      rim = add_ring(from);
    } else {
      start = 1;
      const auto number = [&](std::int32_t i, std::int32_t j) {
        return static_cast<std::uint32_t>(j * (side + 1) + i);
      };
      for (std::int32_t j = 0; j <= side; ++j)
        for (std::int32_t i = 0; i <= side; ++i)
          map.points.push_back({double(i - half) / half, double(j - half) / half, 0});
      for (std::int32_t j = 0; j < side; ++j) {
        for (std::int32_t i = 0; i < side; ++i) {
          const std::uint32_t a = number(i, j), b = number(i + 1, j), c = number(i + 1, j + 1), d = number(i, j + 1);
          // Diagonals point to the centre, so that no triangle has two edges on the circle.
          if ((i < half) == (j < half)) {
            map.triangles.push_back({{a, b, c}, inside});
            map.triangles.push_back({{a, c, d}, inside});
          } else {
            map.triangles.push_back({{a, b, d}, inside});
            map.triangles.push_back({{b, c, d}, inside});
          }
        }
      }
      for (std::int32_t i = 0; i < side; ++i) rim.push_back(number(i, 0));
      for (std::int32_t j = 0; j < side; ++j) rim.push_back(number(side, j));
      for (std::int32_t i = side; i > 0; --i) rim.push_back(number(i, side));
      for (std::int32_t j = side; j > 0; --j) rim.push_back(number(0, j));
      for (std::size_t i = 0; i < rim.size(); ++i) {
        const std::uint32_t a = rim[i], b = rim[(i + 1) % rim.size()];
        map.walls.push_back({{a, b}, body, {box.low.z, box.low.z}, {roof_rim_m, roof_rim_m}});
      }
    }
    const double stop = skirt > 0 ? 2 : to;
    const double rings = skirt > 0 ? skirt : std::max(2.0, std::round((to - start) * 40 / edge_m));
    if (stop > start) {
      for (double k = 1; k <= rings; ++k) {
        const std::vector<std::uint32_t> next = add_ring(k == rings ? stop : start + (stop - start) * (k / rings));
        join(rim, next);
        rim = next;
      }
    }
    const std::array<std::uint32_t, 4> sides{south, east, north, west};
    for (std::size_t i = 0; i < rim.size(); ++i)
      map.walls.push_back({{rim[i], rim[(i + 1) % rim.size()]},
                           sides[i / static_cast<std::size_t>(side)],
                           {box.low.z, box.low.z},
                           {box.high.z, box.high.z}});
    return map;
  }

  static void add_sheet(SheetSoup& sheets, std::uint32_t entity, const ColumnMap& map,
                        const std::function<Vec3(const MapPoint&, std::uint32_t)>& place) {
    std::vector<std::uint32_t> block(map.points.size(), outside);
    std::vector<Triangle> triangles;
    for (const MapTriangle& triangle : map.triangles) {
      for (const std::uint32_t p : triangle.corners)
        if (triangle.block == inside) block[p] = inside;
      triangles.push_back(triangle.corners);
    }
    std::vector<Vec3> points;
    for (std::size_t p = 0; p < map.points.size(); ++p) points.push_back(place(map.points[p], block[p]));
    sheets.add_sheet(entity, points, triangles);
  }
};

}  // namespace

std::unique_ptr<ColumnModel> diapir() { return std::make_unique<Diapir>(); }

}  // namespace strataflow
