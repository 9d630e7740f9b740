#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/quality/distribution.h"
#include "model/geology.h"
#include "model/input_data.h"

namespace strataflow {

// What is found out about hexahedra in layers and their model. Every struct lists its fields once, by name, for reports
// and for the store.

/// How near the facets on one surface of the model come to it. Vertices over fault traces count apart (there weak
/// verticality bends the plan), those where a layer has closed (there levels lie on what cuts them off), and those past
/// the end of a horizon at a fault that need not be followed, or within half an edge of such a fault (there levels
/// bridge a gap).
struct SurfaceAudit {
  std::string name;
  std::string role;
  std::uint64_t facets = 0;
  std::uint64_t vertices = 0;
  double furthest_m = 0;            ///< of the vertices that do not count apart
  double mean_m = 0;                ///< of the same
  double furthest_on_traces_m = 0;  ///< horizons: vertices over fault traces
  double furthest_closed_m = 0;     ///< where a layer has closed: from the nearest horizon, top or bottom
  double furthest_bridged_m = 0;    ///< horizons: vertices at faults that need not be followed
  double furthest_beyond_m = 0;     ///< faults: vertices past a border where the fault dies (steps end beyond it)
  double furthest_centre_m = 0;     ///< middles of facets
  double model_area_m2 = 0, grid_area_m2 = 0;  ///< horizons: seen from above; sides that match count once
  bool is_followed = true;                     ///< false for faults whose alignment was dropped
  template <class Visitor>
  void visit_fields(Visitor&& visit) {
    visit("name", name);
    visit("role", role);
    visit("facets", facets);
    visit("vertices", vertices);
    visit("furthest_m", furthest_m);
    visit("mean_m", mean_m);
    visit("furthest_on_traces_m", furthest_on_traces_m);
    visit("furthest_closed_m", furthest_closed_m);
    visit("furthest_bridged_m", furthest_bridged_m);
    visit("furthest_beyond_m", furthest_beyond_m);
    visit("furthest_centre_m", furthest_centre_m);
    visit("model_area_m2", model_area_m2);
    visit("grid_area_m2", grid_area_m2);
    visit("is_followed", is_followed);
  }
  template <class A>
  void archive(A& a) {
    visit_fields([&](const char*, auto& field) { a(field); });
  }
};

/// A region's volume in the grid and in the model. What differs may be 0.5 % of it, or half an edge of the plan times
/// the area of the dying faults and unconformities beside the region (and of volumetric faults, and of faults that need
/// not be followed), whichever is larger.
struct RegionVolumeAudit {
  std::string name;
  double model_m3 = 0, grid_m3 = 0;
  double stepped_area_m2 = 0;  ///< of the dying faults and unconformities beside it
  double allowed_m3 = 0;
  bool is_within = true;
  template <class Visitor>
  void visit_fields(Visitor&& visit) {
    visit("name", name);
    visit("model_m3", model_m3);
    visit("grid_m3", grid_m3);
    visit("stepped_area_m2", stepped_area_m2);
    visit("allowed_m3", allowed_m3);
    visit("is_within", is_within);
  }
  template <class A>
  void archive(A& a) {
    visit_fields([&](const char*, auto& field) { a(field); });
  }
};

/// Valences of the edges of all cells, dead ones too (coudert2024 S1, R21).
struct EdgeAudit {
  std::uint64_t interior_vertices = 0;
  std::uint64_t unbalanced_vertices = 0;      ///< of these, where Σ (6 − valence) is not 12 (1.1)
  std::uint64_t singular_edges = 0;           ///< inside, valence other than 4
  std::uint64_t singular_level_edges = 0;     ///< of these, those along levels: there should be none
  std::uint64_t foreign_column_edges = 0;     ///< upright edges inside whose valence is not that of the plan
  std::uint64_t boundary_singular_edges = 0;  ///< on the boundary, valence other than 2
  std::uint64_t singular_columns = 0;         ///< plan vertices over which the singular edges stand
  template <class Visitor>
  void visit_fields(Visitor&& visit) {
    visit("interior_vertices", interior_vertices);
    visit("unbalanced_vertices", unbalanced_vertices);
    visit("singular_edges", singular_edges);
    visit("singular_level_edges", singular_level_edges);
    visit("foreign_column_edges", foreign_column_edges);
    visit("boundary_singular_edges", boundary_singular_edges);
    visit("singular_columns", singular_columns);
  }
  template <class A>
  void archive(A& a) {
    visit_fields([&](const char*, auto& field) { a(field); });
  }
};

/// Findings by where they are: on the face sets of faults, and anywhere else.
struct PlacedCount {
  std::uint64_t on_faults = 0, elsewhere = 0;
  template <class Visitor>
  void visit_fields(Visitor&& visit) {
    visit("on_faults", on_faults);
    visit("elsewhere", elsewhere);
  }
  template <class A>
  void archive(A& a) {
    visit_fields([&](const char*, auto& field) { a(field); });
  }
};

/// The checks that a finite-element code makes before it takes a mesh (the list of GEOS's mesh-doctor), over the live
/// cells as live_cells joins them.
struct CellDiagnosis {
  std::uint64_t unsupported_types = 0;
  std::uint64_t repeated_nodes = 0;  ///< cells that use a node twice: wedges beside a closed layer
  std::uint64_t nonpositive_volumes = 0;
  std::uint64_t self_intersecting = 0;  ///< cells of which an edge passes through a face or another edge
  std::uint64_t misoriented = 0;        ///< cells with a face whose normal points in
  std::uint64_t non_convex = 0;         ///< cells with a vertex beyond the mean plane of a face that is not its own
  std::uint64_t warped_faces = 0;       ///< a corner further than 5 % of the mean edge from the mean plane
  double largest_warpage_ratio = 0;     ///< that distance over that edge
  PlacedCount collocated_nodes;         ///< nodes at the place of another one
  PlacedCount nonconforming_faces;      ///< inner faces with a cell on one side alone
  std::uint64_t parts = 0;              ///< that share no node
  template <class Visitor>
  void visit_fields(Visitor&& visit) {
    visit("unsupported_types", unsupported_types);
    visit("repeated_nodes", repeated_nodes);
    visit("nonpositive_volumes", nonpositive_volumes);
    visit("self_intersecting", self_intersecting);
    visit("misoriented", misoriented);
    visit("non_convex", non_convex);
    visit("warped_faces", warped_faces);
    visit("largest_warpage_ratio", largest_warpage_ratio);
    visit("collocated_nodes", collocated_nodes);
    visit("nonconforming_faces", nonconforming_faces);
    visit("parts", parts);
  }
  template <class A>
  void archive(A& a) {
    visit_fields([&](const char*, auto& field) { a(field); });
  }
};

/// All that is found out about one grid.
struct HexAudit {
  std::uint64_t cells = 0;
  std::uint64_t dead = 0;       ///< without volume: all four upright edges have closed
  std::uint64_t wedges = 0;     ///< live, but some upright edge has closed
  std::uint64_t inverted = 0;   ///< live, with a determinant ≤ 0 at a corner whose upright edge is open
  std::uint64_t misplaced = 0;  ///< cells whose mark as dead is wrong
  double edge_length_m = 0;     ///< mean of the plan
  double diagonal_m = 0;        ///< of the model
  double min_scaled_jacobian = 0, mean_scaled_jacobian = 0;  ///< live cells without closed edges
  Distribution scaled_jacobian;
  /// Angle between the normal of what two cells share and the line between their middles, degrees: beside each other,
  /// above each other, and beside each other across a fault.
  Distribution lateral_deg, vertical_deg, across_faults_deg;
  std::vector<SurfaceAudit> surfaces;   ///< by entity
  double furthest_from_horizons_m = 0;  ///< the largest of all horizons' `furthest_m`
  double furthest_from_faults_m = 0;    ///< the same of faults
  std::vector<RegionVolumeAudit> regions;
  std::uint64_t regions_beyond = 0;  ///< whose volume differs by more than is allowed
  EdgeAudit edges;
  CellDiagnosis diagnosis;
  std::vector<Polyline> singular_lines;  ///< named by valence: what a viewer should see
  template <class Visitor>
  void visit_fields(Visitor&& visit) {
    visit("cells", cells);
    visit("dead", dead);
    visit("wedges", wedges);
    visit("inverted", inverted);
    visit("misplaced", misplaced);
    visit("edge_length_m", edge_length_m);
    visit("diagonal_m", diagonal_m);
    visit("min_scaled_jacobian", min_scaled_jacobian);
    visit("mean_scaled_jacobian", mean_scaled_jacobian);
    visit("scaled_jacobian", scaled_jacobian);
    visit("lateral_deg", lateral_deg);
    visit("vertical_deg", vertical_deg);
    visit("across_faults_deg", across_faults_deg);
    visit("surfaces", surfaces);
    visit("furthest_from_horizons_m", furthest_from_horizons_m);
    visit("furthest_from_faults_m", furthest_from_faults_m);
    visit("regions", regions);
    visit("regions_beyond", regions_beyond);
    visit("edges", edges);
    visit("diagnosis", diagnosis);
  }
  template <class A>
  void archive(A& a) {
    visit_fields([&](const char*, auto& field) { a(field); });
    a(singular_lines);
  }
};

}  // namespace strataflow
