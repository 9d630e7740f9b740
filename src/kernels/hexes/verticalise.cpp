#include "kernels/hexes/verticalise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hexes/conjugate_gradients.h"
#include "kernels/hexes/gather_entries.h"
#include "kernels/hexes/gravity_field.h"
#include "kernels/hexes/untangle_plan.h"
#include "kernels/hexes/upright_system.h"

namespace strataflow {
namespace {

/// Tetrahedra that are not positive in (u, v, z), exactly.
std::vector<std::uint32_t> turned_over(const LabelledTets& tets, const std::vector<Vec3>& plan) {
  const std::vector<char> is_over = parallel_map(
      tets.tets.size(),
      [&](std::size_t t) -> char {
        std::array<Vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) {
          p[k] = plan[tets.tets[t][k]];
          p[k].z = tets.points[tets.tets[t][k]].z;
        }
        return orientation_3d(p[0], p[1], p[2], p[3]) <= 0;
      },
      1024);
  std::vector<std::uint32_t> over;
  for (std::uint32_t t = 0; t < is_over.size(); ++t)
    if (is_over[t]) over.push_back(t);
  return over;
}

/// Σ |t| ‖∇U − I‖²: the matrix of both coordinates and their right-hand sides (2.4).
struct LinearDeformation {
  std::vector<MatrixEntry> matrix;  ///< without the pin
  std::array<std::vector<double>, 2> right;
};

LinearDeformation linear_deformation(const LabelledTets& tets, const UprightSystem& system,
                                     const std::vector<TetGradients>& gradients) {
  LinearDeformation linear;
  for (auto& side : linear.right) side.assign(system.unknown_count, 0);
  const auto visit_rows = [&](std::size_t t, auto&& visit) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t p = tets.tets[t][i];
      for (std::uint32_t s = system.first[p]; s < system.first[p + 1]; ++s)
        visit(system.shares[s], gradients[t].gradient[i], gradients[t].volume_m3);
    }
  };
  for (std::size_t t = 0; t < tets.tets.size(); ++t)
    visit_rows(t, [&](const UprightSystem::Share& row, const Vec3& gradient, double volume_m3) {
      linear.right[0][row.unknown] += row.weight * volume_m3 * gradient.x;
      linear.right[1][row.unknown] += row.weight * volume_m3 * gradient.y;
    });
  linear.matrix = gather_entries(tets.tets.size(), [&](std::size_t t, std::vector<MatrixEntry>& entries) {
    visit_rows(t, [&](const UprightSystem::Share& row, const Vec3& gradient, double volume_m3) {
      visit_rows(t, [&](const UprightSystem::Share& column, const Vec3& other, double) {
        if (column.unknown <= row.unknown)
          entries.push_back(
              {row.unknown, column.unknown, row.weight * column.weight * volume_m3 * dot(gradient, other)});
      });
    });
  });
  return linear;
}

/// The fault with most tetrahedra turned over around it; the side, where there is none at a fault.
std::string worst_wall(const LabelledTets& tets, const WallSheets& sheets, const std::vector<std::uint32_t>& over) {
  std::vector<std::array<std::uint32_t, 2>> count(tets.entities.size(), {0, 0});  // as a fault, as a side
  for (const std::uint32_t t : over)
    for (const std::uint32_t p : tets.tets[t])
      for (const std::uint32_t sheet : sheets.sheets_at(p)) {
        const std::uint32_t entity = sheets.sheet_entity[sheet];
        ++count[entity][tets.entities[entity].role == Role::fault ? 0 : 1];
      }
  const auto worst = std::max_element(count.begin(), count.end());
  return *worst == std::array<std::uint32_t, 2>{0, 0}
             ? "no fault"
             : tets.entities[static_cast<std::size_t>(worst - count.begin())].name;
}

/// Share of all volume that some tetrahedra have.
double volume_ratio(const std::vector<TetGradients>& gradients, const std::vector<std::uint32_t>& some) {
  double all = 0, of_some = 0;
  for (const TetGradients& tet : gradients) all += tet.volume_m3;
  for (const std::uint32_t t : some) of_some += gradients[t].volume_m3;
  return of_some / all;
}

}  // namespace

bool stands_upright(const LabelledTets& tets) {
  return std::all_of(tets.facets.begin(), tets.facets.end(), [&](const SheetFacet& facet) {
    if (facet.kind != SheetKind::side && !(facet.kind == SheetKind::fault && facet.is_aligned)) return true;
    const auto& [a, b, c] = facet.vertices;
    const Vec3 n = cross(tets.points[b] - tets.points[a], tets.points[c] - tets.points[a]);
    return std::abs(n.z) <= 1e-9 * length(n);
  });
}

Result<UprightPlan> verticalise(const LabelledTets& tets, const VerticaliseOptions& options) {
  constexpr double tolerated_ratio = 1e-4;  // of the volume: slivers, which lifting leaves aside
  if (options.untangling_steps < 0)
    return Failure{FailureCode::invalid_options, "untangling_steps must not be negative", "use 600"};
  UprightPlan upright;
  upright.plan = tets.points;
  for (Vec3& p : upright.plan) p.z = 0;
  upright.sheets = find_wall_sheets(tets);
  upright.is_identity = stands_upright(tets);
  if (upright.is_identity) {
    upright.traced = trace_walls(tets, upright.sheets, std::vector<Vec3>(tets.tets.size(), Vec3{0, 0, -1}));
    return upright;
  }
  if (const Result<void> checked = check_walls(tets, upright.sheets); !checked) return checked.failure();
  upright.traced = trace_walls(tets, upright.sheets, gravity_field(tets, upright.sheets));
  const UprightSystem system = substitute(tets.points.size(), upright.traced.constraints);
  const std::vector<TetGradients> gradients = tet_gradients(tets);
  LinearDeformation linear = linear_deformation(tets, system, gradients);
  // One unknown is pinned where it is: the matrix knows nothing of translations.
  const Vec3 pin = tets.points[system.point_of[0]];
  double scale = 0;
  std::erase_if(linear.matrix, [&](const MatrixEntry& entry) {
    if (entry.column != 0) return false;
    if (entry.row == 0) {
      scale += entry.value;
    } else {
      linear.right[0][entry.row] -= entry.value * pin.x;
      linear.right[1][entry.row] -= entry.value * pin.y;
    }
    return true;
  });
  linear.matrix.push_back({0, 0, scale});
  linear.right[0][0] = scale * pin.x;
  linear.right[1][0] = scale * pin.y;
  const Multigrid guide(symmetric_rows(system.unknown_count, linear.matrix), constant_mode(system.unknown_count));
  linear.matrix = {};
  std::vector<double> u, v;
  for (const std::uint32_t p : system.point_of) {
    u.push_back(tets.points[p].x);
    v.push_back(tets.points[p].y);
  }
  constexpr std::size_t most_solving = 2000;
  if (conjugate_gradients(guide, linear.right[0], u, 1e-11, most_solving) == most_solving ||
      conjugate_gradients(guide, linear.right[1], v, 1e-11, most_solving) == most_solving)
    return Failure{FailureCode::geometry_failed, "faults that stand upright leave parts of the plan without a place",
                   "drop an alignment with drop_alignment"};
  const auto place = [&] {
    const std::vector<double> all_u = system.expanded(u), all_v = system.expanded(v);
    for (std::size_t p = 0; p < upright.plan.size(); ++p) upright.plan[p] = {all_u[p], all_v[p], 0};
  };
  place();
  std::vector<std::uint32_t> over = turned_over(tets, upright.plan);
  upright.flipped_by_linear = static_cast<std::uint32_t>(over.size());
  if (!over.empty()) {
    UntangledPlan untangled = untangle_plan(tets, system, gradients, guide, std::move(u), std::move(v),
                                            static_cast<std::size_t>(options.untangling_steps));
    u = std::move(untangled.u);
    v = std::move(untangled.v);
    upright.untangling_steps = untangled.steps;
    place();
    over = turned_over(tets, upright.plan);
    if (volume_ratio(gradients, over) > tolerated_ratio) {
      const std::string name = worst_wall(tets, upright.sheets, over);
      return Failure{
          FailureCode::geometry_failed,
          std::to_string(over.size()) + " tetrahedra stay turned over when faults are set upright, most at " + name,
          "build on surfaces with better triangles (output.from = \"surfaces\"), mesh finer, or leave it out "
          "with drop_alignment = [\"" +
              name + "\"]"};
    }
    upright.left_turned_over = static_cast<std::uint32_t>(over.size());
  }
  upright.smallest_determinant = ordered_reduce(
      tets.tets.size(), std::numeric_limits<double>::infinity(),
      [&](std::size_t t) {
        Vec3 du, dv;
        for (std::size_t k = 0; k < 4; ++k) {
          du = du + upright.plan[tets.tets[t][k]].x * gradients[t].gradient[k];
          dv = dv + upright.plan[tets.tets[t][k]].y * gradients[t].gradient[k];
        }
        return du.x * dv.y - du.y * dv.x;
      },
      [](double a, double b) { return std::min(a, b); });
  return upright;
}

}  // namespace strataflow
