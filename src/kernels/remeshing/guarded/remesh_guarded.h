#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "model/structural_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

struct RemeshGuardedOptions {
  double target_edge_length_m = 50.0;              ///< > 0
  std::vector<double> surface_edge_length_m = {};  ///< per surface, > 0; empty: target_edge_length_m everywhere
  double distance_ratio = 0.002;                   ///< > 0: how far the input may lie from the mesh, of its diagonal
  double turn_angle_deg = 50.0;                    ///< (0, 90): how far a triangle may turn away from those it replaces
  double smallest_size_ratio = 0.4;         ///< (0, 1]: how far edges may shrink along strips between lines; 1: not
  double size_growth_ratio = 0.5;           ///< > 0: how fast they grow from there, per metre
  std::int64_t rounds = 7;                  ///< ≥ 0: of splitting, collapsing, flipping and evening out
  std::int64_t mending_rounds = 12;         ///< ≥ 0: at what is still bad, at most
  std::int64_t shape_rounds = 8;            ///< ≥ 0: of raising the mean shape
  std::function<bool()> is_cancelled = {};  ///< asked now and then, by several threads
};

/// Why a triangle kept an angle below 5°.
enum class BadTriangleReason : std::uint8_t {
  touches_small_feature,  ///< a line or a gap between two lines shorter than half an edge, or a narrow corner
  kept_input              ///< every step that would mend it was refused
};

struct BadTriangle {
  std::uint32_t triangle = 0;  ///< of the soup
  double smallest_angle_deg = 0;
  BadTriangleReason reason = BadTriangleReason::kept_input;
};

struct RemeshGuardedReport {
  std::uint64_t splits = 0, collapses = 0, flips = 0, moves = 0, mended = 0;
  std::array<std::uint64_t, verdict_count> verdicts{};  ///< of every step tried, by Verdict
  std::vector<BadTriangle> bad_triangles;               ///< below 5°, ascending
};

struct RemeshGuardedResult {
  TriangleSoup soup;  ///< one patch per surface of the input, in its order
  RemeshGuardedReport report;
};

/// The edge length at which equilateral triangles on `area_m2` have `sites` vertices.
double edge_length_of(double area_m2, double sites);

/// Remeshes a valid, conforming model so that it stays one at every step: the same corners, lines, surfaces and
/// regions, no improper intersection (pellerin2014 §5: the automatic repair the thesis lacks). Where a good triangle
/// cannot be had that way the bad one stays and is listed.
/// Fails with invalid_options for an option out of its domain, with cancelled.
Result<RemeshGuardedResult> remesh_guarded(const StructuralModel& model, const RemeshGuardedOptions& options = {});

}  // namespace strataflow
