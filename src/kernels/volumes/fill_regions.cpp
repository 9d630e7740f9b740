#include "kernels/volumes/fill_regions.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>

#include "base/child_process.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/tetgen/run_tetgen.h"
#include "kernels/volumes/refine_interior.h"
#include "kernels/volumes/split_surfaces.h"

namespace strataflow {

namespace {

/// Rounds of inserting points and filling neighbours again; each round only follows from the one before.
constexpr int max_rounds = 20;

/// What came of the attempts on one region.
struct Filling {
  std::optional<RegionMesh> mesh;
  std::optional<Failure> failure;     ///< not a matter of the attempt: timed out, cancelled, no worker
  std::vector<std::string> rejected;  ///< the attempts before, and why each was not taken
  std::string taken;                  ///< the attempt that gave the mesh
};

/// All that stays the same while a model is filled.
struct Job {
  const StructuralModel& model;
  const TetrahedralizeOptions& options;
  const AttemptPlan& plan;
  const std::filesystem::path& worker;
  const CancellationToken* cancellation;

  std::string name_of(std::uint32_t region) const {
    return "region '" + model.regions[region].name + "' (" + std::to_string(region) + ")";
  }
  bool is_cancelled() const { return cancellation && cancellation->is_cancelled(); }
  InteriorGoal goal_of(std::uint32_t region) const {
    return {options.max_volume_in(model.regions[region].name), options.radius_edge_ratio};
  }
};

Failure cancelled() { return {FailureCode::cancelled, "meshing was stopped", "run it again"}; }

/// Runs one attempt; its answer, or why there is none.
std::variant<RegionAnswer, Rejection, Failure> answer_to(const Job& job, const RegionBoundary& boundary,
                                                         const RegionAttempt& attempt, const std::string& interior) {
  if (job.is_cancelled()) return cancelled();
  const RegionFrame frame(boundary, attempt);
  const TetgenRequest request =
      request_for(boundary, attempt, frame, interior, static_cast<std::uint64_t>(job.options.memory_limit_mb));
  Result<TetgenOutcome> outcome = run_tetgen(job.worker, request, job.options.timeout_s, job.cancellation);
  if (!outcome) {
    Failure failure = outcome.failure();
    failure.what = job.name_of(boundary.region) + ": " + failure.what;
    return failure;
  }
  if (outcome->end != TetgenOutcome::End::finished) return Rejection{outcome->reason};
  return answer_from(boundary, attempt, frame, std::move(outcome->response));
}

/// Takes what can be verified, refines its interior, and verifies that too.
std::variant<RegionMesh, Rejection> refined_region_mesh(const Job& job, const RegionBoundary& boundary,
                                                        const std::vector<Vec3>& points, const std::vector<Tet>& tets) {
  const double volume_m3 = job.model.regions[boundary.region].volume_m3;
  auto verdict = verified_region_mesh(boundary, points, tets, volume_m3);
  auto* mesh = std::get_if<RegionMesh>(&verdict);
  const InteriorGoal goal = job.goal_of(boundary.region);
  if (!mesh || goal.is_empty()) return verdict;
  refine_interior(boundary, *mesh, goal, job.cancellation);
  if (job.is_cancelled()) return Rejection{"the run was cancelled"};
  return verified_region_mesh(boundary, points_of(boundary, *mesh), mesh->tets, volume_m3);
}

Filling fill_keeping_surfaces(const Job& job, const RegionBoundary& boundary) {
  Filling filling;
  const std::string interior = interior_switches(job.options);
  std::vector<RegionAttempt> attempts;
  const bool is_true_space = !interior.empty() || vertical_stretch(boundary) == 1;  // angles mean nothing elsewhere
  for (RegionAttempt attempt : job.plan.keeping) {
    if (is_true_space) attempt.is_stretched = false;
    if (std::find(attempts.begin(), attempts.end(), attempt) == attempts.end()) attempts.push_back(attempt);
  }
  for (const RegionAttempt& attempt : attempts) {
    auto answer = answer_to(job, boundary, attempt, interior);
    if (auto* failure = std::get_if<Failure>(&answer)) {
      filling.failure = *failure;
      return filling;
    }
    std::variant<RegionMesh, Rejection> verdict = Rejection{};
    if (auto* rejection = std::get_if<Rejection>(&answer)) {
      verdict = *rejection;
    } else {
      const RegionAnswer& got = std::get<RegionAnswer>(answer);
      verdict = refined_region_mesh(job, boundary, got.points, got.tets);
    }
    if (auto* mesh = std::get_if<RegionMesh>(&verdict)) {
      filling.mesh = std::move(*mesh);
      filling.taken = describe(attempt);
      return filling;
    }
    filling.rejected.push_back(describe(attempt) + ": " + std::get<Rejection>(verdict).reason);
  }
  return filling;
}

/// A region filled with points inserted on its surfaces, and the surfaces with them.
struct SplitFilling {
  Filling filling;
  SurfaceTriangles surfaces;
  std::vector<std::uint8_t> changed;  ///< per triangle before the split
};

SplitFilling fill_splitting_surfaces(const Job& job, const SurfaceTriangles& surfaces, const RegionBoundary& boundary) {
  SplitFilling result;
  Filling& filling = result.filling;
  for (const RegionAttempt& attempt : job.plan.splitting) {
    auto answer = answer_to(job, boundary, attempt, "");
    if (auto* failure = std::get_if<Failure>(&answer)) {
      filling.failure = *failure;
      return result;
    }
    std::string reason;
    if (auto* rejection = std::get_if<Rejection>(&answer)) {
      reason = rejection->reason;
    } else {
      auto split = surface_split(boundary, surfaces, std::get<RegionAnswer>(answer));
      if (auto* bad_split = std::get_if<Rejection>(&split)) {
        reason = bad_split->reason;
      } else {
        const SurfaceSplit& good = std::get<SurfaceSplit>(split);
        result.surfaces = with_split(surfaces, boundary, good, result.changed);
        const RegionBoundary refined = region_boundary(job.model, result.surfaces, boundary.region);
        auto verdict = refined_region_mesh(job, refined, good.tet_points, good.tets);
        if (auto* mesh = std::get_if<RegionMesh>(&verdict)) {
          filling.mesh = std::move(*mesh);
          filling.taken = describe(attempt);
          return result;
        }
        reason = std::get<Rejection>(verdict).reason;
      }
    }
    filling.rejected.push_back(describe(attempt) + ", surfaces split: " + reason);
  }
  return result;
}

std::string joined(const std::vector<std::string>& reasons) {
  std::string text;
  for (const std::string& reason : reasons) text += (text.empty() ? "" : "; ") + reason;
  return text;
}

Failure cannot_fill(const Job& job, std::uint32_t region, const std::vector<std::string>& reasons) {
  if (job.is_cancelled()) return cancelled();  // nothing was tried to the end
  return {FailureCode::geometry_failed,
          job.name_of(region) + " could not be filled with tetrahedra: " + joined(reasons),
          "remesh its surfaces, or look for surfaces that nearly touch there (strataflow check)"};
}

/// Fills `regions` side by side; results by position in `regions`.
std::vector<Filling> fill_side_by_side(const Job& job, const std::vector<RegionBoundary>& boundaries,
                                       const std::vector<std::uint32_t>& regions) {
  std::vector<std::size_t> biggest_first(regions.size());
  std::iota(biggest_first.begin(), biggest_first.end(), std::size_t{0});
  std::sort(biggest_first.begin(), biggest_first.end(), [&](std::size_t a, std::size_t b) {
    const std::size_t size_a = boundaries[regions[a]].facets.size(), size_b = boundaries[regions[b]].facets.size();
    return size_a != size_b ? size_a > size_b : a < b;
  });
  // Whichever chunk starts next takes the biggest region left: the schedule decides when a region is filled, never how.
  std::vector<Filling> fillings(regions.size());
  std::atomic<std::size_t> next{0};
  parallel_ranges(regions.size(), 1, [&](std::size_t, std::size_t) {
    const std::size_t i = biggest_first[next.fetch_add(1)];
    fillings[i] = fill_keeping_surfaces(job, boundaries[regions[i]]);
  });
  return fillings;
}

/// Lists the points that a split added to the surfaces.
void report_inserted_points(const Job& job, const SurfaceTriangles& before, const SurfaceTriangles& after,
                            const std::string& why, std::vector<Change>& changes) {
  std::vector<std::uint32_t> surface_of(after.points.size(), no_index);
  for (std::size_t t = after.triangles.size(); t-- > 0;)
    for (const std::uint32_t vertex : after.triangles[t]) surface_of[vertex] = after.triangle_surface[t];
  for (std::size_t p = before.points.size(); p < after.points.size(); ++p) {
    const Vec3 where = after.points[p] + job.model.local_origin;
    std::array<char, 128> text;
    std::snprintf(text.data(), text.size(), "(%.10g, %.10g, %.10g) on ", where.x, where.y, where.z);
    std::string what = text.data();
    if (after.point_line[p] >= 0) {
      what += "line " + std::to_string(after.point_line[p]) + " of surfaces";
      for (const std::uint32_t s : job.model.lines[static_cast<std::size_t>(after.point_line[p])].surfaces)
        what += " " + std::to_string(s);
    } else {
      const std::uint32_t s = surface_of[p];
      what += "surface " + std::to_string(s) + " (" + job.model.entities[job.model.surfaces[s].entity].name + ")";
    }
    changes.push_back({"inserted_surface_point", what, why});
  }
}

}  // namespace

Result<FilledRegions> fill_regions(const StructuralModel& model, const TetrahedralizeOptions& options,
                                   const AttemptPlan& plan, const std::filesystem::path& worker,
                                   const CancellationToken* cancellation) {
  const Job job{model, options, plan, worker, cancellation};
  const std::size_t region_count = model.regions.size();
  FilledRegions filled{surface_triangles_of(model),
                       std::vector<RegionBoundary>(region_count),
                       std::vector<RegionMesh>(region_count),
                       {}};
  std::vector<std::uint8_t> is_waiting(region_count, 1);
  for (int round = 0; round < max_rounds; ++round) {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t r = 0; r < region_count; ++r)
      if (is_waiting[r]) waiting.push_back(r);
    if (waiting.empty()) return filled;
    parallel_ranges(waiting.size(), 1, [&](std::size_t i, std::size_t) {
      filled.boundaries[waiting[i]] = region_boundary(model, filled.surfaces, waiting[i]);
    });
    std::vector<Filling> fillings = fill_side_by_side(job, filled.boundaries, waiting);
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const std::uint32_t r = waiting[i];
      if (fillings[i].failure) return *fillings[i].failure;
      if (!fillings[i].mesh) continue;
      filled.meshes[r] = std::move(*fillings[i].mesh);
      is_waiting[r] = 0;
      if (!fillings[i].rejected.empty())
        filled.changes.push_back(
            {"repeated_region", job.name_of(r) + ": " + fillings[i].taken, joined(fillings[i].rejected)});
    }
    // Those that resisted, one after the other: each may change the surfaces of the next.
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const std::uint32_t r = waiting[i];
      if (fillings[i].mesh || !is_waiting[r]) continue;
      if (options.split_surfaces == "never") return cannot_fill(job, r, fillings[i].rejected);
      const RegionBoundary boundary = region_boundary(model, filled.surfaces, r);
      SplitFilling split = fill_splitting_surfaces(job, filled.surfaces, boundary);
      if (split.filling.failure) return *split.filling.failure;
      std::vector<std::string> reasons = fillings[i].rejected;
      reasons.insert(reasons.end(), split.filling.rejected.begin(), split.filling.rejected.end());
      if (!split.filling.mesh) return cannot_fill(job, r, reasons);
      filled.changes.push_back({"split_surfaces", job.name_of(r) + ": " + split.filling.taken, joined(reasons)});
      report_inserted_points(job, filled.surfaces, split.surfaces, job.name_of(r) + " could not be filled otherwise",
                             filled.changes);
      for (std::size_t t = 0; t < split.changed.size(); ++t) {
        if (!split.changed[t]) continue;
        const Surface& surface = model.surfaces[filled.surfaces.triangle_surface[t]];
        for (const std::uint32_t side : {surface.region_minus, surface.region_plus})
          if (side != universe) is_waiting[side] = 1;
      }
      filled.surfaces = std::move(split.surfaces);
      // Triangles of regions that did not change keep their order but not their indices.
      for (std::uint32_t other = 0; other < region_count; ++other)
        filled.boundaries[other] = region_boundary(model, filled.surfaces, other);
      filled.meshes[r] = std::move(*split.filling.mesh);
      is_waiting[r] = 0;
    }
  }
  for (std::uint32_t r = 0; r < region_count; ++r)
    if (is_waiting[r]) return cannot_fill(job, r, {"its surfaces and its neighbours' kept splitting each other"});
  return filled;
}

Result<FilledCavity> fill_cavity(const RegionBoundary& boundary, const std::string& name, double volume_m3,
                                 const TetrahedralizeOptions& options, const std::filesystem::path& worker,
                                 const CancellationToken* cancellation) {
  StructuralModel alone;  // all that a job asks of its model are a region's name and volume
  alone.regions.resize(1);
  alone.regions[0].name = name;
  alone.regions[0].volume_m3 = volume_m3;
  AttemptPlan plan;  // in true space first: tetrahedra that are Delaunay are duals of Voronoi vertices
  std::stable_partition(plan.keeping.begin(), plan.keeping.end(),
                        [](const RegionAttempt& attempt) { return !attempt.is_stretched; });
  const std::filesystem::path program = worker.empty() ? program_folder() / "tet_worker" : worker;
  const Job job{alone, options, plan, program, cancellation};
  RegionBoundary own = boundary;
  own.region = 0;
  Filling filling = fill_keeping_surfaces(job, own);
  if (filling.failure) return *filling.failure;
  return FilledCavity{std::move(filling.mesh), std::move(filling.rejected)};
}

}  // namespace strataflow
