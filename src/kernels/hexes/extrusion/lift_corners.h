#pragma once
#include <optional>

#include "kernels/hexes/extrude_hexes.h"
#include "kernels/hexes/extrusion/bridged_levels.h"
#include "kernels/hexes/extrusion/plan_edges.h"
#include "kernels/hexes/tet_locator.h"

namespace strataflow {

/// Where a corner of a quad lies at one level.
struct Lift {
  std::uint32_t tet = no_index;
  double outside_m = 0;  ///< of the tetrahedron in UVW
  Vec3 position;         ///< XYZ
  bool is_unreached = false;
  bool is_squeezed = false;  ///< a unit too thin for its parallel layers ends at this level
  bool is_bridged = false;   ///< it has no place of its own beside a fault that need not be followed
  double bridged_m = 0;      ///< then: how far from there
};

/// Finds the place in space of corners of quads at levels (coudert2024 S14). Corners over fault traces and over the
/// outline come to lie on the fault and on the side themselves, where weak verticality or a straight edge of a quad
/// leaves them a little beside. Levels inside units whose layers are parallel are found by their height. Columns that
/// cross faults which need not be followed have their levels bridged (BridgedLevels). Safe to use from several threads.
class CornerLifter {
 public:
  CornerLifter(const LayeredSpace& space, const QuadMesh& plan, const PlanEdges& edges, const ExtrudeOptions& options);

  double edge_m() const { return edge_m_; }
  /// A quad whose centre lies outside the model at some level.
  std::optional<std::uint32_t> outside_quad() const { return outside_quad_; }
  /// The tetrahedron that holds the middle of a layer over a quad's centre.
  std::uint32_t tet_of_cell(std::uint32_t quad, std::uint32_t layer) const { return centre_places_[quad][layer].tet; }
  /// Of a plan point away from faults, or on the side of a volumetric fault (there it is where the quads outside are),
  /// at every level.
  std::vector<Lift> lift_column(std::uint32_t point) const;
  /// Of a quad's corner (4·quad + k) on a fault: in the tetrahedron of the ball around it nearest to the one below the
  /// quad's centre, counted in steps that cross no fault; of those connected with it in the ball, the one that holds
  /// the corner best.
  std::vector<Lift> lift_column_on_fault(std::uint32_t corner) const;

 private:
  void lift_centres();
  Lift lift(std::uint32_t point, double w, std::uint32_t start) const;
  Lift lift_on_fault(std::uint32_t corner, double w, std::uint32_t start) const;
  Lift lift_at_height(std::uint32_t corner, double z) const;
  std::optional<BridgedLevels> bridges_over(std::uint32_t corner) const;
  template <class LiftAt>
  std::vector<Lift> lift_bridged(std::uint32_t corner, LiftAt&& lift_at) const;
  template <class LiftAt>
  std::vector<Lift> lift_levels(LiftAt&& lift_at) const;
  std::uint32_t first_in_ball(std::uint32_t from, const std::vector<std::uint32_t>& ball) const;
  std::vector<std::uint32_t> connected_in_ball(std::uint32_t start, const std::vector<std::uint32_t>& ball) const;
  Vec3 position_in(const TetLocator& locator, const TetLocator::Place& best,
                   const std::vector<std::uint32_t>& candidates, const Vec3& p) const;
  std::optional<Vec3> position_on_walls(const TetLocator& locator, std::uint32_t point,
                                        const std::vector<std::uint32_t>& near, const Vec3& p) const;
  double wall_reach_m(std::uint32_t point) const;

  const LayeredSpace& space_;
  const QuadMesh& plan_;
  const PlanEdges& edges_;
  const ExtrudeOptions& options_;
  std::uint32_t layers_ = 0;
  double edge_m_ = 1;
  TetLocator locator_;
  std::optional<PlumbLines> lines_;  // of the plan, where faults need not be followed
  std::optional<TetLocator> heights_;
  std::vector<std::uint32_t> wall_of_face_;
  std::vector<std::vector<TetLocator::Place>> centre_places_;  // per quad: middles of layers, then levels beside faults
  std::optional<std::uint32_t> outside_quad_;
};

}  // namespace strataflow
