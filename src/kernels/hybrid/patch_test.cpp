#include "kernels/hybrid/patch_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/sparse/symmetric_system.h"
#include "kernels/quality/match_cell_faces.h"
#include "model/box3.h"

namespace strataflow {

namespace {

constexpr std::size_t corner_count = 8;

/// The vertices of a cell at the corners of a hexahedron; some repeat.
std::array<std::uint32_t, corner_count> hexahedron_of(const VolumeMesh& mesh, std::size_t cell) {
  const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[cell]];
  switch (mesh.cell_types[cell]) {
    case CellType::tetrahedron:
      return {v[0], v[1], v[2], v[2], v[3], v[3], v[3], v[3]};
    case CellType::pyramid:
      return {v[0], v[1], v[2], v[3], v[4], v[4], v[4], v[4]};
    case CellType::prism:
      return {v[0], v[2], v[1], v[1], v[3], v[5], v[4], v[4]};
    case CellType::hexahedron:
      break;
  }
  return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
}

/// A place of Gauss and Legendre in the unit cube, with the shape functions there.
struct Place {
  double weight = 0;
  std::array<double, corner_count> value{};
  std::array<Vec3, corner_count> slope{};  ///< with respect to the cube's coordinates
};

/// Four places along each axis: exact for determinants times products of gradients of trilinear maps where these are
/// polynomials, and never on an edge that has shrunk to a point.
std::vector<Place> cube_places() {
  constexpr std::array<double, 4> at{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                     0.93056815579702629};
  constexpr std::array<double, 4> weight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                         0.17392742256872693};
  constexpr std::array<std::array<int, 3>, corner_count> corner{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  std::vector<Place> places;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) {
        Place place;
        place.weight = weight[i] * weight[j] * weight[k];
        const std::array<double, 3> x{at[i], at[j], at[k]};
        for (std::size_t c = 0; c < corner_count; ++c) {
          std::array<double, 3> f, g;
          for (std::size_t a = 0; a < 3; ++a) {
            f[a] = corner[c][a] ? x[a] : 1 - x[a];
            g[a] = corner[c][a] ? 1 : -1;
          }
          place.value[c] = f[0] * f[1] * f[2];
          place.slope[c] = {g[0] * f[1] * f[2], f[0] * g[1] * f[2], f[0] * f[1] * g[2]};
        }
        places.push_back(place);
      }
  return places;
}

/// One cell's part of the equations, corner by corner of its hexahedron.
struct CellPart {
  std::array<double, corner_count * corner_count> stiffness{};
  std::array<double, corner_count> load{};
  bool turns_over = false;
};

class Elements {
 public:
  explicit Elements(const VolumeMesh& mesh) : mesh_(mesh), places_(cube_places()) {}

  /// Calls visit(weight with determinant, place, point, gradients) at every place of a cell; false where it turns over.
  template <class Visit>
  bool visit_places(std::size_t cell, Visit&& visit) const {
    const auto corners = hexahedron_of(mesh_, cell);
    for (const Place& place : places_) {
      Vec3 dr, ds, dt, point;
      for (std::size_t c = 0; c < corner_count; ++c) {
        const Vec3& p = mesh_.points[corners[c]];
        point = point + place.value[c] * p;
        const Vec3 from = p - mesh_.points[corners[0]];
        dr = dr + place.slope[c].x * from;
        ds = ds + place.slope[c].y * from;
        dt = dt + place.slope[c].z * from;
      }
      const Vec3 st = cross(ds, dt), tr = cross(dt, dr), rs = cross(dr, ds);
      const double determinant = dot(dr, st);
      if (!(determinant > 0)) return false;
      std::array<Vec3, corner_count> gradient;
      for (std::size_t c = 0; c < corner_count; ++c) {
        const Vec3& slope = place.slope[c];
        gradient[c] = (1 / determinant) * (slope.x * st + slope.y * tr + slope.z * rs);
      }
      visit(place.weight * determinant, place, point, gradient);
    }
    return true;
  }

  CellPart part(std::size_t cell, const ScalarField* source) const {
    CellPart part;
    part.turns_over =
        !visit_places(cell, [&](double weight, const Place& place, const Vec3& point, const auto& gradient) {
          const double f = source ? weight * (*source)(point) : 0;
          for (std::size_t i = 0; i < corner_count; ++i) {
            part.load[i] += f * place.value[i];
            for (std::size_t j = 0; j < corner_count; ++j)
              part.stiffness[corner_count * i + j] += weight * dot(gradient[i], gradient[j]);
          }
        });
    return part;
  }

 private:
  const VolumeMesh& mesh_;
  std::vector<Place> places_;
};

/// The equations of a mesh with values given on its boundary.
class BoundaryValueProblem {
 public:
  static Result<BoundaryValueProblem> make(const VolumeMesh& mesh, const ScalarField* source) {
    if (mesh.cell_count() == 0)
      return Failure{FailureCode::invalid_input, "the mesh has no cells", "give a volume mesh"};
    for (const std::uint32_t v : mesh.cell_vertices)
      if (v >= mesh.points.size())
        return Failure{FailureCode::invalid_input, "a cell names a vertex that the mesh does not have",
                       "mend the file"};
    BoundaryValueProblem problem(mesh);
    const Elements elements(mesh);
    problem.parts_ = parallel_map(
        mesh.cell_count(), [&](std::size_t cell) { return elements.part(cell, source); }, 64);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
      if (problem.parts_[cell].turns_over)
        return Failure{FailureCode::geometry_failed, "cell " + std::to_string(cell) + " turns over inside",
                       "finite elements need cells that do not: see inverted"};
    problem.number();
    if (problem.unknown_count_ == 0) return problem;
    std::vector<MatrixEntry> entries;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
      const auto corners = hexahedron_of(mesh, cell);
      for (std::size_t i = 0; i < corner_count; ++i)
        for (std::size_t j = 0; j < corner_count; ++j) {
          const std::uint32_t row = problem.unknown_[corners[i]], column = problem.unknown_[corners[j]];
          if (row >= problem.unknown_count_ || column > row) continue;
          entries.push_back({row, column, problem.parts_[cell].stiffness[corner_count * i + j]});
        }
    }
    Result<SymmetricSystem> system = SymmetricSystem::factorize(problem.unknown_count_, entries);
    if (!system) return system.failure();
    problem.system_.emplace(std::move(*system));
    return problem;
  }

  /// Per point the solution that takes `values` on the boundary.
  std::vector<double> solve(const std::vector<double>& values) const {
    std::vector<double> solution(mesh_->points.size(), 0), right(unknown_count_, 0);
    for (std::size_t p = 0; p < solution.size(); ++p)
      if (unknown_[p] == given) solution[p] = values[p];
    for (std::size_t cell = 0; cell < parts_.size(); ++cell) {
      const auto corners = hexahedron_of(*mesh_, cell);
      for (std::size_t i = 0; i < corner_count; ++i) {
        const std::uint32_t row = unknown_[corners[i]];
        if (row >= unknown_count_) continue;
        right[row] += parts_[cell].load[i];
        for (std::size_t j = 0; j < corner_count; ++j)
          if (unknown_[corners[j]] == given)
            right[row] -= parts_[cell].stiffness[corner_count * i + j] * solution[corners[j]];
      }
    }
    if (!system_) return solution;
    const std::vector<double> inside = system_->solve(right);
    for (std::size_t p = 0; p < solution.size(); ++p)
      if (unknown_[p] < unknown_count_) solution[p] = inside[unknown_[p]];
    return solution;
  }

  /// ∫ |∇u|².
  double energy(const std::vector<double>& u) const {
    double sum = 0;
    for (std::size_t cell = 0; cell < parts_.size(); ++cell) {
      const auto corners = hexahedron_of(*mesh_, cell);
      // Gradients know differences only: taken against one corner, large values do not cancel.
      for (std::size_t i = 0; i < corner_count; ++i)
        for (std::size_t j = 0; j < corner_count; ++j)
          sum += parts_[cell].stiffness[corner_count * i + j] * (u[corners[i]] - u[corners[0]]) *
                 (u[corners[j]] - u[corners[0]]);
    }
    return sum;
  }

  std::uint32_t unknown_count() const { return unknown_count_; }
  std::uint64_t given_count() const {
    return static_cast<std::uint64_t>(std::count(unknown_.begin(), unknown_.end(), given));
  }

 private:
  static constexpr std::uint32_t given = no_index - 1, unused = no_index;
  explicit BoundaryValueProblem(const VolumeMesh& mesh) : mesh_(&mesh) {}

  void number() {
    unknown_.assign(mesh_->points.size(), unused);
    for (const std::uint32_t v : mesh_->cell_vertices) unknown_[v] = 0;
    for (const CellFace& face : match_cell_faces(*mesh_).boundary_faces)
      for (const std::uint32_t v : face.vertices)
        if (v != no_index) unknown_[v] = given;
    for (std::uint32_t& u : unknown_)
      if (u == 0) u = unknown_count_++;
  }

  const VolumeMesh* mesh_;
  std::vector<CellPart> parts_;
  std::vector<std::uint32_t> unknown_;  ///< per point: its row, or given, or unused
  std::uint32_t unknown_count_ = 0;
  std::optional<SymmetricSystem> system_;
};

}  // namespace

Result<PatchTestReport> run_patch_test(const VolumeMesh& mesh) {
  Result<BoundaryValueProblem> problem = BoundaryValueProblem::make(mesh, nullptr);
  if (!problem) return problem.failure();
  Box3 box;
  for (const std::uint32_t v : mesh.cell_vertices) box.take(mesh.points[v]);
  const Elements elements(mesh);
  double volume = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
    elements.visit_places(cell, [&](double weight, const auto&, const auto&, const auto&) { volume += weight; });
  PatchTestReport report;
  report.unknowns = problem->unknown_count();
  report.boundary_vertices = problem->given_count();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> field(mesh.points.size());
    for (std::size_t p = 0; p < field.size(); ++p) field[p] = mesh.points[p][axis] - box.centre()[axis];
    const std::vector<double> solved = problem->solve(field);
    for (const std::uint32_t v : mesh.cell_vertices)
      report.max_error_ratio = std::max(report.max_error_ratio, std::abs(solved[v] - field[v]) / box.diagonal_m());
    report.energy_error_ratio =
        std::max(report.energy_error_ratio, std::abs(problem->energy(solved) - volume) / volume);
  }
  return report;
}

Result<PoissonSolution> solve_poisson(const VolumeMesh& mesh, const ScalarField& source, const ScalarField& exact) {
  Result<BoundaryValueProblem> problem = BoundaryValueProblem::make(mesh, &source);
  if (!problem) return problem.failure();
  std::vector<double> wanted(mesh.points.size());
  for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p] = exact(mesh.points[p]);
  PoissonSolution solution;
  solution.values = problem->solve(wanted);
  const Elements elements(mesh);
  double squared = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto corners = hexahedron_of(mesh, cell);
    elements.visit_places(cell, [&](double weight, const Place& place, const Vec3& point, const auto&) {
      double u = 0;
      for (std::size_t c = 0; c < corner_count; ++c) u += place.value[c] * solution.values[corners[c]];
      const double error = u - exact(point);
      squared += weight * error * error;
    });
  }
  solution.error_l2 = std::sqrt(squared);
  return solution;
}

}  // namespace strataflow
