#include "kernels/reference_models/fracture_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/seed.h"
#include "kernels/cutting/cut_surfaces.h"
#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {
namespace {

constexpr Vec3 high{13000, 11000, 4000};
constexpr std::uint32_t fracture_count = 200, horizon_count = 2;

Vec3 unit(const Vec3& a) { return (1 / length(a)) * a; }

/// A flat convex polygon around `centre`, `along` and `up` its two half axes.
struct Fracture {
  Vec3 centre, along, up;
  Vec3 normal() const { return unit(cross(along, up)); }
};

/// Eight corners of an ellipse, counter-clockwise.
std::vector<Vec3> corners_of(const Fracture& f) {
  constexpr double diagonal = 0.70710678118654752;
  std::vector<Vec3> corners;
  for (const auto& [s, t] : {std::array{1.0, 0.0},
                             {diagonal, diagonal},
                             {0.0, 1.0},
                             {-diagonal, diagonal},
                             {-1.0, 0.0},
                             {-diagonal, -diagonal},
                             {0.0, -1.0},
                             {diagonal, -diagonal}})
    corners.push_back(f.centre + s * f.along + t * f.up);
  return corners;
}

/// The part of a convex polygon inside the box; corners made by a side lie in it exactly.
std::vector<Vec3> clipped(std::vector<Vec3> polygon) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double limit : {0.0, high[axis]}) {
      const auto inside = [&](const Vec3& p) { return limit > 0 ? limit - p[axis] : p[axis]; };
      std::vector<Vec3> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0) kept.push_back(a);
        if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
          kept.push_back(a + (at_a / (at_a - at_b)) * (b - a));
          kept.back()[axis] = limit;
        }
      }
      polygon = std::move(kept);
    }
  return polygon;
}

/// Rings around the middle of the polygon; sides longer than an edge are divided.
void add_polygon(SheetSoup& sheets, std::uint32_t entity, const std::vector<Vec3>& polygon, double edge_m) {
  std::vector<Vec3> rim, points;
  std::vector<Triangle> triangles;
  double reach = 0;
  Vec3 middle;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double parts = std::max(1.0, std::round(length(b - a) / edge_m));
    for (double i = 0; i < parts; ++i) rim.push_back(a + (i / parts) * (b - a));
    middle = middle + (1.0 / static_cast<double>(polygon.size())) * a;
  }
  for (const Vec3& p : rim) reach = std::max(reach, length(p - middle));
  const auto rings = static_cast<std::uint32_t>(std::max(1.0, std::round(reach / edge_m)));
  const auto count = static_cast<std::uint32_t>(rim.size());
  points.push_back(middle);
  for (std::uint32_t ring = 1; ring <= rings; ++ring)
    for (const Vec3& p : rim) points.push_back(ring == rings ? p : middle + (double(ring) / rings) * (p - middle));
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t after = (k + 1) % count;
    triangles.push_back({0, 1 + k, 1 + after});
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
      const std::uint32_t inner = 1 + (ring - 1) * count, outer = inner + count;
      triangles.push_back({inner + k, outer + k, outer + after});
      triangles.push_back({inner + k, outer + after, inner + after});
    }
  }
  sheets.add_sheet(entity, points, triangles);
}

Fracture drawn(RandomStream& random) {
  // Strike of three steep sets and a flat one, each spread by some degrees.
  constexpr std::array<Vec3, 4> strikes{Vec3{1, 0.2, 0}, {-0.3, 1, 0}, {0.8, -0.7, 0}, {1, 1, 0}};
  const auto set = static_cast<std::size_t>(random.below(10)) * 4 / 12;
  const auto spread = [&](double by) { return by * (2 * random.unit() - 1); };
  const Vec3 along = unit(strikes[set] + Vec3{spread(0.25), spread(0.25), spread(0.1)});
  const Vec3 wanted =
      set == 3 ? Vec3{spread(0.3) - 1, 1 + spread(0.3), spread(0.4)} : Vec3{spread(0.4), spread(0.4), 1};
  const Vec3 up = unit(wanted - dot(wanted, along) * along);
  const double half = 250 + 1300 * random.unit() * random.unit();
  const Vec3 centre{high.x * random.unit(), high.y * random.unit(), 300 + (high.z - 600) * random.unit()};
  return {centre, half * along, half * (0.5 + 0.4 * random.unit()) * up};
}

/// A fracture that just meets `other`, just misses it or crosses it at a low angle.
Fracture beside(const Fracture& other, std::uint32_t kind, RandomStream& random) {
  constexpr double three_degrees = 0.0524;
  const Vec3 normal = other.normal();
  if (kind == 2) {
    // They cross where neither has an edge: along an edge, rounding would decide.
    const Vec3 up = other.up + three_degrees * length(other.up) * normal;
    return {other.centre + 0.2 * other.along + 0.13 * other.up - 0.21 * up, 0.9 * other.along, 0.8 * up};
  }
  const double half = 200 + 200 * random.unit(), reach = kind == 0 ? half - 0.1 : half + 0.5;
  return {other.centre + 0.1 * other.along + 0.17 * other.up + reach * normal, half * normal,
          half * 0.6 * unit(other.along)};
}

}  // namespace

TriangleSoup raw_fracture_network(double edge_m, std::uint64_t seed, double extent_ratio) {
  std::vector<Entity> entities{{"H1", Role::horizon}, {"H2", Role::horizon}};
  for (std::uint32_t f = 1; f <= fracture_count; ++f) entities.push_back({"F" + std::to_string(f), Role::fault});
  for (const char* side : {"Top", "Bottom", "North", "South", "East", "West"})
    entities.push_back({side, Role::boundary});
  SheetSoup sheets(entities);
  // The horizons' points on a side of the box lie in it exactly, between those of the side.
  const auto columns = static_cast<std::uint32_t>(std::round(high.x / (1.07 * edge_m)));
  const auto rows = static_cast<std::uint32_t>(std::round(high.y / (1.07 * edge_m)));
  for (std::uint32_t h = 0; h < horizon_count; ++h)
    sheets.add_grid(h, columns + 1, rows + 1, [&](std::uint32_t i, std::uint32_t j) {
      const double x = i == columns ? high.x : high.x * (double(i) / columns);
      const double y = j == rows ? high.y : high.y * (double(j) / rows);
      return Vec3{x, y, h == 0 ? 1250 + 0.03 * x - 0.02 * y : 2700 - 0.02 * x + 0.03 * y};
    });
  RandomStream random(seed_for(seed, "dfn"));
  Fracture fracture;
  for (std::uint32_t f = 0; f < fracture_count; ++f) {
    fracture = f % 10 == 9 ? beside(fracture, f / 10 % 3, random) : drawn(random);
    Fracture sized = fracture;
    sized.along = (1 + extent_ratio) * sized.along;
    sized.up = (1 + extent_ratio) * sized.up;
    const std::vector<Vec3> inside = clipped(corners_of(sized));
    if (inside.size() >= 3) add_polygon(sheets, horizon_count + f, inside, edge_m);
  }
  sheets.add_box_sides(horizon_count + fracture_count, {0, 0, 0}, high, edge_m);
  return sheets.take();
}

Result<TriangleSoup> fracture_network(double edge_m, std::uint64_t seed) {
  Result<CutResult> cut = cut_surfaces(raw_fracture_network(edge_m, seed));
  if (!cut) return cut.failure();
  return std::move(cut->soup);
}

}  // namespace strataflow
