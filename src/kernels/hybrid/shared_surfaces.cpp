#include "kernels/hybrid/shared_surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "base/id.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/remeshing/dual/ball_property.h"
#include "kernels/remeshing/dual/cell_components.h"
#include "kernels/remeshing/dual/clean_up_dual.h"
#include "kernels/remeshing/dual/dual_polygons.h"
#include "kernels/remeshing/dual/dual_soup.h"
#include "kernels/remeshing/dual/element_changes.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/validity/check_validity.h"
#include "kernels/voronoi/line_edges.h"
#include "kernels/voronoi/restricted_diagram.h"
#include "model/soup_of_model.h"

namespace strataflow {

namespace {

/// One dual, judged.
struct Attempt {
  SharedSurfaces surfaces;
  std::string flaw;                       ///< empty: valid
  std::vector<std::uint32_t> bad_sites;   ///< in whose cells triangles cross; ascending
  std::vector<Vec3> wanted_sites;         ///< on what was not kept
  std::vector<std::uint32_t> flat_sites;  ///< of triangles with hardly any area, as between points of a straight line
};

/// Where more sites would tell an element that is not as it was from its neighbours: on the corner, half-way along each
/// part of the line inside a cell, in the middle of each component of the surface.
void add_wanted_sites(const StructuralModel& model, const RestrictedDiagram& diagram, const CellComponents& components,
                      const ElementChange& change, std::vector<Vec3>& wanted) {
  for (const std::uint32_t element : change.before) {
    if (change.element == ElementKind::corner) wanted.push_back(model.points[model.corners[element].vertex]);
    if (change.element == ElementKind::line)
      for (std::uint32_t begin = components.line_begin[element], end; begin < components.line_begin[element + 1];
           begin = end) {
        end = begin + 1;
        while (end < components.line_begin[element + 1] && components.parts[end].site == components.parts[begin].site)
          ++end;
        const LinePart& part = components.parts[begin + (end - begin) / 2];
        wanted.push_back(0.5 * (part.begin + part.end));
      }
    if (change.element == ElementKind::surface)
      for (std::uint32_t c = 0; c < components.surfaces.size(); ++c) {
        if (components.surfaces[c].surface != element) continue;
        const auto pieces = components.pieces_of(c);
        const auto corners = diagram.piece_points(pieces[pieces.size() / 2]);
        Vec3 sum;
        for (const Vec3& corner : corners) sum = sum + corner;
        wanted.push_back((1.0 / static_cast<double>(corners.size())) * sum);
      }
  }
}

/// Whether a failure of the ball property costs more than a sheet of its own.
bool is_bad(BallCheck check) { return check != BallCheck::several_sheets && check != BallCheck::several_arcs; }

Result<Attempt> attempt(const StructuralModel& model, const RestrictedDiagram& diagram, std::size_t site_count,
                        bool must_keep_all) {
  const Result<CellComponents> components = find_cell_components(model, diagram, site_count);
  if (!components) return components.failure();
  MergeOptions merge;
  merge.merges_linked_corners = merge.merges_beyond_two_points = false;
  const ComponentPoints points = place_component_points(model, diagram, *components, merge);
  DualMesh mesh = build_dual_polygons(model, diagram, *components, points);
  clean_up_dual(model, mesh);
  const std::vector<BallFailure> failures = check_ball_property(model, diagram, *components);
  DualSoup dual = make_dual_soup(model, mesh);
  dual.soup.regions = patches_of_model(model).regions;  // for their names
  PointProperty site{site_property, "", 1, {}};
  for (const DualPoint& point : dual.points) site.values.push_back(point.site);
  dual.soup.properties = {std::move(site)};

  Attempt made;
  for (const auto& pair : find_intersections(dual.soup.points, dual.soup.triangles)) {
    made.flaw = "triangles of the dual cross each other";
    for (const std::uint32_t t : {pair.first, pair.second})
      for (const std::uint32_t point : dual.soup.triangles[t]) made.bad_sites.push_back(dual.points[point].site);
  }
  Result<BuiltModel> built = build_structural_model(dual.soup);
  if (!built) return built.failure();
  if (made.flaw.empty()) {
    const ValidityReport validity = check_validity(*built);
    if (!is_sealed(built->model, validity)) {
      made.flaw = "the dual is not sealed";
      for (const Violation& violation : validity.violations)
        if (violation.severity == Violation::Severity::error) made.flaw = violation.what;
    }
  }
  const std::vector<ElementChange> changes = compare_elements(model, dual, built->model);
  for (const ElementChange& change : changes) {
    made.surfaces.changes.push_back(describe(change, model, built->model));
    if (!must_keep_all) continue;
    if (made.flaw.empty()) made.flaw = made.surfaces.changes.back();
    if (!made.bad_sites.empty()) continue;  // what crosses makes elements of its own: mended first, few are left
    add_wanted_sites(model, diagram, *components, change, made.wanted_sites);
  }
  if (!made.flaw.empty() && made.bad_sites.empty() &&
      made.wanted_sites.empty())  // nothing crosses, yet something leaks: where cells see too much
    for (const BallFailure& failure : failures)
      if (is_bad(failure.check)) made.bad_sites.push_back(failure.site);
  made.bad_sites = sorted_unique(std::move(made.bad_sites));
  constexpr double least_height_ratio = 2e-3;  // to the longest edge
  for (const Triangle& t : dual.soup.triangles) {
    const Vec3 ab = dual.soup.points[t[1]] - dual.soup.points[t[0]],
               ac = dual.soup.points[t[2]] - dual.soup.points[t[0]];
    const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(ac - ab, ac - ab)});
    if (!(length(cross(ab, ac)) < least_height_ratio * longest)) continue;
    for (const std::uint32_t point : t) made.flat_sites.push_back(dual.points[point].site);
  }
  made.flat_sites = sorted_unique(std::move(made.flat_sites));
  made.surfaces.ball_failures = failures.size();
  made.surfaces.built = std::move(*built);
  made.surfaces.soup = std::move(dual.soup);
  return made;
}

/// More sites where they are wanted, and one in each bad cell, at the corner of its pieces farthest from the site. They
/// stand for one sheet.
void add_sites(const RestrictedDiagram& diagram, const std::vector<std::uint32_t>& bad_sites, std::vector<Vec3> added,
               SharedSites& shared) {
  std::vector<double> farthest(bad_sites.size(), 0);
  std::vector<Vec3> place(bad_sites.size());
  for (std::size_t i = 0; i < diagram.piece_count(); ++i) {
    const auto found = std::lower_bound(bad_sites.begin(), bad_sites.end(), diagram.piece_site[i]);
    if (found == bad_sites.end() || *found != diagram.piece_site[i]) continue;
    const auto k = static_cast<std::size_t>(found - bad_sites.begin());
    for (const Vec3& corner : diagram.piece_points(i))
      if (const double d = length(corner - shared.sites[*found]); d > farthest[k]) {
        farthest[k] = d;
        place[k] = corner;
      }
  }
  for (std::size_t k = 0; k < bad_sites.size(); ++k)
    if (farthest[k] > 0) added.push_back(place[k]);
  const auto before = [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::sort(added.begin(), added.end(), before);
  added.erase(std::unique(added.begin(), added.end()), added.end());
  std::vector<Vec3> present = shared.sites;
  std::sort(present.begin(), present.end(), before);
  for (const Vec3& site : added) {
    if (std::binary_search(present.begin(), present.end(), site, before)) continue;
    shared.sites.push_back(site);
    shared.stacks.emplace_back();
    shared.is_on_box.push_back(0);
    shared.is_pinned.resize(shared.sites.size(), 0);
    shared.is_pinned.back() = 1;  // else its neighbours push it off what it was added for
  }
}

}  // namespace

Result<SharedSurfaces> remesh_on_shared_sites(const StructuralModel& model, SharedSites shared,
                                              const SharedSurfacesOptions& options) {
  if (shared.sites.empty()) return Failure{FailureCode::invalid_input, "there are no sites", "ask for more sites"};
  const std::vector<LineEdge> lines = line_edges(model);
  const CvtDomain domain{model.points, model.triangles, options.density, lines};
  const std::size_t asked = shared.sites.size();
  const auto is_cancelled = [&] {
    return options.settle.optimise.is_cancelled && options.settle.optimise.is_cancelled();
  };
  constexpr std::int64_t most_flat_rounds = 3;
  constexpr std::size_t most_growth = 4;  // beyond it sites follow one another without end
  std::int64_t flat_rounds = 0;
  std::optional<SharedSurfaces> valid;  // the last that was
  for (std::int64_t round = 0;; ++round) {
    SettleOptions settle = options.settle;
    if (round > 0) settle.rounds = 1;  // the others lie well already
    Result<OptimisedSites> settled = settle_shared_sites(model, domain, shared, settle);
    if (!settled) return settled.failure();
    if (is_cancelled()) return Failure{FailureCode::cancelled, "cancelled", "run again to go on"};
    shared.sites = std::move(settled->sites);
    SiteNeighbours neighbours;
    neighbours.move_to(shared.sites);
    const RestrictedDiagram diagram = restrict_to_triangles(model.points, model.triangles, neighbours);
    Result<Attempt> made = attempt(model, diagram, shared.sites.size(), options.must_keep_all);
    if (!made) return made.failure();
    if (made->flaw.empty()) {
      made->surfaces.sites = shared.sites.size();
      made->surfaces.added_sites = shared.sites.size() - asked;
      // Flat triangles are valid, and leave no room for good cells: worth a few rounds.
      if (made->flat_sites.empty() || flat_rounds++ == most_flat_rounds) return std::move(made->surfaces);
      valid = std::move(made->surfaces);
      made->bad_sites = std::move(made->flat_sites);
    } else if (valid && flat_rounds++ == most_flat_rounds) {
      return std::move(*valid);
    }
    const std::size_t before = shared.sites.size();
    if (valid ? flat_rounds <= most_flat_rounds : round < options.rounds && before <= most_growth * asked)
      add_sites(diagram, made->bad_sites, std::move(made->wanted_sites), shared);
    if (shared.sites.size() > before) continue;
    if (valid) return std::move(*valid);
    return Failure{FailureCode::geometry_failed,
                   "after " + std::to_string(round) +
                       " rounds of adding sites the dual on common sites is still not valid: " + made->flaw,
                   "ask for more sites"};
  }
}

std::vector<std::uint32_t> sites_of_points(const StructuralModel& model) {
  std::vector<std::uint32_t> sites(model.points.size(), no_index);
  for (const PointProperty& property : model.properties) {
    if (property.name != site_property || property.width != 1 || property.values.size() != sites.size()) continue;
    for (std::size_t p = 0; p < sites.size(); ++p)
      if (property.values[p] >= 0 && property.values[p] < no_index)
        sites[p] = static_cast<std::uint32_t>(property.values[p]);
  }
  return sites;
}

}  // namespace strataflow
