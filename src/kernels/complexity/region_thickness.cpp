#include "kernels/complexity/region_thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 64;  ///< triangles

struct Corners {
  Vec3 a, b, c;
};

Corners corners_of(const StructuralModel& model, std::uint32_t t) {
  const auto [i, j, k] = model.triangles[t];
  return {model.points[i], model.points[j], model.points[k]};
}

std::uint64_t parts_of(double length_m, double spacing_m) {
  return static_cast<std::uint64_t>(std::clamp(std::ceil(length_m / spacing_m), 1.0, 1e6));
}

/// The parts of a triangle that samples stand for: rows parallel to its longest edge, cut into pieces.
struct Rows {
  Corners corner;  ///< the longest edge is a–b
  double base_m = 0;
  std::uint64_t count = 1;

  Rows(const Corners& given, double spacing_m) : corner(given) {
    const auto turned = [&] { corner = {corner.b, corner.c, corner.a}; };
    const double ab = length(given.b - given.a), bc = length(given.c - given.b), ca = length(given.a - given.c);
    base_m = std::max({ab, bc, ca});
    if (ab < base_m) turned();
    if (ab < base_m && bc < base_m) turned();
    const double twice_area = length(cross(corner.b - corner.a, corner.c - corner.a));
    if (base_m > 0) count = parts_of(twice_area / base_m, spacing_m);
  }
  double low(std::uint64_t row) const { return static_cast<double>(row) / static_cast<double>(count); }
  std::uint64_t pieces(std::uint64_t row, double spacing_m) const { return parts_of((1 - low(row)) * base_m, spacing_m); }
};

/// Along the ray, in [0, 1] of it; infinite for a miss. Edges belong to the triangle.
double hit_of(const Vec3& origin, const Vec3& ray, const Corners& t) {
  constexpr double miss = std::numeric_limits<double>::infinity();
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, p = cross(ray, ac);
  const double determinant = dot(ab, p);
  if (determinant == 0) return miss;
  const Vec3 from = origin - t.a, q = cross(from, ab);
  const double u = dot(from, p) / determinant, v = dot(ray, q) / determinant, at = dot(ac, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && at > 1e-9 && at <= 1 ? at : miss;
}

/// Per surface: those that share a line with it, itself included, ascending.
std::vector<std::vector<std::uint32_t>> neighbours_of_surfaces(const StructuralModel& model) {
  std::vector<std::vector<std::uint32_t>> neighbours(model.surfaces.size());
  for (const Line& line : model.lines)
    for (const std::uint32_t s : line.surfaces)
      neighbours[s].insert(neighbours[s].end(), line.surfaces.begin(), line.surfaces.end());
  for (auto& some : neighbours) some = sorted_unique(std::move(some));
  return neighbours;
}

}  // namespace

ThicknessSamples sample_region_thickness(const StructuralModel& model, const BoxElements& box,
                                         const ThicknessOptions& options) {
  std::vector<std::uint32_t> triangles;
  for (std::size_t s = 0; s < model.surfaces.size(); ++s)
    for (std::uint32_t t = model.surfaces[s].first_triangle; box.surfaces[s] == 0 && t < model.surfaces[s].end_triangle;
         ++t)
      triangles.push_back(t);
  std::vector<FloatBox> boxes;
  for (const std::uint32_t t : triangles) {
    Box3 one;
    for (const std::uint32_t v : model.triangles[t]) one.take(model.points[v]);
    boxes.push_back(enclosing(one));
  }
  const BoundingVolumeTree tree(boxes);

  const auto neighbours = neighbours_of_surfaces(model);
  ThicknessSamples result;
  result.spacing_m = options.spacing_m;
  const auto samples_a_side = [&] {
    std::uint64_t sum = 0;
    for (const std::uint32_t t : triangles) {
      const Rows rows(corners_of(model, t), result.spacing_m);
      for (std::uint64_t row = 0; row < rows.count; ++row) sum += rows.pieces(row, result.spacing_m);
    }
    return sum;
  };
  while (samples_a_side() > std::max<std::uint64_t>(options.most, triangles.size())) result.spacing_m *= 1.5;

  auto per_triangle = parallel_map(
      triangles.size(),
      [&](std::size_t index) {
        const std::uint32_t t = triangles[index];
        const Corners corner = corners_of(model, t);
        const Vec3 normal = cross(corner.b - corner.a, corner.c - corner.a);
        const double twice_area = length(normal);
        std::vector<ThicknessSample> samples;
        if (!(twice_area > 0)) return samples;
        const Surface& surface = model.surfaces[model.triangle_surface[t]];
        const std::vector<std::uint32_t>& near = neighbours[model.triangle_surface[t]];
        const Rows rows(corner, result.spacing_m);
        for (std::uint32_t side = 0; side < 2; ++side) {
          const std::uint32_t region = side == 1 ? surface.region_plus : surface.region_minus;
          if (region == universe) continue;
          const Vec3 ray = ((side == 1 ? 1 : -1) * options.reach_m / twice_area) * normal;
          for (std::uint64_t row = 0; row < rows.count; ++row) {
            const double low = rows.low(row), high = rows.low(row + 1), middle = 0.5 * (low + high);
            const std::uint64_t pieces = rows.pieces(row, result.spacing_m);
            const double area_m2 =
                0.5 * twice_area * ((1 - low) * (1 - low) - (1 - high) * (1 - high)) / static_cast<double>(pieces);
            const Vec3 from = rows.corner.a + middle * (rows.corner.c - rows.corner.a);
            const Vec3 to = rows.corner.b + middle * (rows.corner.c - rows.corner.b);
            for (std::uint64_t i = 0; i < pieces; ++i) {
              const Vec3 p = from + ((static_cast<double>(i) + 0.5) / static_cast<double>(pieces)) * (to - from);
              Box3 path;
              path.take(p);
              path.take(p + ray);
              double nearest = std::numeric_limits<double>::infinity();
              std::uint32_t met = model.triangle_surface[t];  // of equal hits the lowest surface
              tree.visit_items(enclosing(path), [&](std::uint32_t other) {
                if (other == index) return;
                const double hit = hit_of(p, ray, corners_of(model, triangles[other]));
                const std::uint32_t hit_surface = model.triangle_surface[triangles[other]];
                if (hit < nearest || (hit == nearest && hit_surface < met)) {
                  nearest = hit;
                  met = hit_surface;
                }
              });
              const bool is_wedge = std::isfinite(nearest) && std::binary_search(near.begin(), near.end(), met);
              samples.push_back({t, side, region, p, area_m2, nearest * options.reach_m, is_wedge ? 1u : 0u});
            }
          }
        }
        return samples;
      },
      grain);
  for (const auto& samples : per_triangle)
    result.samples.insert(result.samples.end(), samples.begin(), samples.end());
  return result;
}

}  // namespace strataflow
