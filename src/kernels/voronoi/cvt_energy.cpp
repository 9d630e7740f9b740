#include "kernels/voronoi/cvt_energy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/parallel/parallel_map.h"
#include "kernels/voronoi/cvt_share.h"
#include "kernels/voronoi/restricted_diagram.h"
#include "kernels/voronoi/triangle_cells.h"

namespace strataflow {

namespace {

/// Shares of a run of triangles, in order of first need; a site may come twice where two compete for a slot.
class ShareList {
 public:
  ShareList() { slots_.fill(none); }
  CvtShare& of(std::uint32_t site) {
    std::uint32_t& slot = slots_[(site * 2654435761u) >> (32 - slot_bits)];
    if (slot == none || shares[slot].site != site) {
      slot = static_cast<std::uint32_t>(shares.size());
      shares.emplace_back();
      shares.back().site = site;
    }
    return shares[slot];
  }
  std::vector<CvtShare> shares;

 private:
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr int slot_bits = 8;
  std::array<std::uint32_t, std::size_t{1} << slot_bits> slots_;
};

/// Moments of a triangle given by its corners relative to the site, with the density at each.
void add_triangle(const std::array<Vec3, 3>& u, CvtShare& share) {
  const Vec3 normal = cross(u[1] - u[0], u[2] - u[0]);
  const double area = 0.5 * length(normal);
  const Vec3 sum = u[0] + u[1] + u[2];
  share.mass += area;
  share.moment = share.moment + (area / 3) * sum;
  // Σ u_i·u_i + Σ_{i<j} u_i·u_j = (Σ u_i·u_i + sum·sum) / 2
  share.energy += area / 12 * (dot(u[0], u[0]) + dot(u[1], u[1]) + dot(u[2], u[2]) + dot(sum, sum));
}

void add_triangle(const std::array<Vec3, 3>& u, const std::array<double, 3>& density, CvtShare& share) {
  const double area = 0.5 * length(cross(u[1] - u[0], u[2] - u[0]));
  const double total = density[0] + density[1] + density[2];
  share.mass += area / 3 * total;
  for (std::size_t i = 0; i < 3; ++i) share.moment = share.moment + (area / 12 * (total + density[i])) * u[i];
  // ∫ λ_i λ_j λ_k over a triangle is 2·area·(product of the factorials of the multiplicities) / 5!
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) {
        const int equal = (i == j) + (j == k) + (i == k);
        sum += density[i] * dot(u[j], u[k]) * (equal == 3 ? 6 : equal == 1 ? 2 : 1);
      }
  share.energy += area / 60 * sum;
}

/// The density on a triangle, as an affine function of position.
struct LinearDensity {
  Vec3 origin, slope;
  double at_origin = 1;
  double at(const Vec3& y) const { return at_origin + dot(slope, y - origin); }
};

LinearDensity linear_density(const std::array<Vec3, 3>& corners, const std::array<double, 3>& values) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  LinearDensity density{corners[0], {}, values[0]};
  if (!(determinant > 0)) return density;
  const double a = values[1] - values[0], b = values[2] - values[0];
  density.slope = ((a * vv - b * uv) / determinant) * u + ((b * uu - a * uv) / determinant) * v;
  return density;
}

/// What one segment of a line adds: to its site, and to the sites whose bisectors end it.
struct Pull {
  std::uint32_t site = 0;
  double energy = 0;
  Vec3 gradient;
};

/// d(end of segment)/d(both sites of the bisector that cuts it there), applied to dF/d(end).
void pull_by_end(const Vec3& end, const Vec3& along, const Vec3& by_end, std::uint32_t owner, std::uint32_t other,
                 const std::vector<Vec3>& sites, std::vector<Pull>& pulls) {
  const Vec3 across = sites[other] - sites[owner];
  const double speed = dot(across, along);
  if (!(std::abs(speed) > 1e-9 * length(across) * length(along))) return;  // the bisector holds the line: no derivative
  const double slope = dot(by_end, along) / speed;
  pulls.push_back({owner, 0, slope * (end - sites[owner])});
  pulls.push_back({other, 0, slope * (sites[other] - end)});
}

}  // namespace

void CvtEnergy::evaluate(const std::vector<Vec3>& sites, bool with_attraction, CvtTerms& terms) {
  neighbours_.move_to(sites);
  find_owners(domain_.points, neighbours_, owners_);
  const bool has_density = !domain_.density.empty();

  constexpr std::size_t grain = 1024;
  const std::size_t count = domain_.triangles.size();
  const auto chunks = parallel_map((count + grain - 1) / grain, [&](std::size_t chunk) {
    ShareList list;
    TriangleCells cells(neighbours_);
    const std::size_t end = std::min(count, (chunk + 1) * grain);
    for (std::size_t t = chunk * grain; t < end; ++t) {
      const Triangle& triangle = domain_.triangles[t];
      const std::array<Vec3, 3> corners{domain_.points[triangle[0]], domain_.points[triangle[1]],
                                        domain_.points[triangle[2]]};
      std::array<double, 3> values{1, 1, 1};
      if (has_density) values = {domain_.density[triangle[0]], domain_.density[triangle[1]], domain_.density[triangle[2]]};
      const std::uint32_t owner = owners_[triangle[0]];
      if (owner == owners_[triangle[1]] && owner == owners_[triangle[2]]) {  // cells are convex: all of it
        const std::array<Vec3, 3> u{corners[0] - sites[owner], corners[1] - sites[owner], corners[2] - sites[owner]};
        has_density ? add_triangle(u, values, list.of(owner)) : add_triangle(u, list.of(owner));
        continue;
      }
      const LinearDensity density = has_density ? linear_density(corners, values) : LinearDensity{};
      cells.cut(corners, owner);
      for (std::size_t i = 0; i < cells.piece_count(); ++i) {
        const TrianglePiece piece = cells.piece(i);
        const Vec3& site = sites[piece.site];
        CvtShare& share = list.of(piece.site);
        for (std::size_t k = 2; k < piece.points.size(); ++k) {
          const std::array<Vec3, 3> u{piece.points[0] - site, piece.points[k - 1] - site, piece.points[k] - site};
          if (has_density)
            add_triangle(u, {density.at(piece.points[0]), density.at(piece.points[k - 1]), density.at(piece.points[k])},
                         share);
          else
            add_triangle(u, share);
        }
      }
    }
    return std::move(list.shares);
  });

  sum_shares(chunks, sites, terms);
  if (!with_attraction) return;
  terms.attraction_gradient.assign(sites.size(), Vec3{});

  const auto pulls = parallel_map(domain_.line_edges.size(), [&](std::size_t index) {
    const auto [t, edge] = domain_.line_edges[index];
    const Triangle& triangle = domain_.triangles[t];
    TriangleCells cells(neighbours_);
    cells.cut({domain_.points[triangle[0]], domain_.points[triangle[1]], domain_.points[triangle[2]]},
              owners_[triangle[0]]);
    std::vector<Pull> made;
    for (std::size_t i = 0; i < cells.piece_count(); ++i) {
      const TrianglePiece piece = cells.piece(i);
      const std::size_t corner_count = piece.points.size();
      for (std::size_t k = 0; k < corner_count; ++k) {
        if (!piece.edges[k].is_triangle_edge() || piece.edges[k].triangle_edge() != edge) continue;
        const Vec3 &from = piece.points[k], &to = piece.points[(k + 1) % corner_count], &site = sites[piece.site];
        const Vec3 normal = cross(site - to, from - to);
        made.push_back({piece.site, 0.5 * dot(normal, normal), cross(normal, to - from)});
        const PieceEdge before = piece.edges[(k + corner_count - 1) % corner_count];
        const PieceEdge after = piece.edges[(k + 1) % corner_count];
        if (!before.is_triangle_edge())
          pull_by_end(from, to - from, cross(normal, site - to), piece.site, before.site(), sites, made);
        if (!after.is_triangle_edge())
          pull_by_end(to, to - from, cross(normal, from - site), piece.site, after.site(), sites, made);
      }
    }
    return made;
  }, 64);
  for (const std::vector<Pull>& made : pulls)
    for (const Pull& pull : made) {
      terms.attraction += pull.energy;
      terms.attraction_gradient[pull.site] = terms.attraction_gradient[pull.site] + pull.gradient;
    }
}

}  // namespace strataflow
