#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/id.h"
#include "base/result.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/remeshing/guarded/input_surfaces.h"
#include "kernels/remeshing/guarded/space_blocks.h"
#include "kernels/remeshing/guarded/triangle_grid.h"
#include "model/structural_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Where a vertex may go: anywhere on its surface, along its line, nowhere.
enum class VertexKind : std::uint8_t { surface, line, corner };

/// What an operation on a GuardedMesh ended with.
enum class Verdict : std::uint8_t {
  done,
  fixed,      ///< the vertex or edge may not be changed this way at all
  topology,   ///< surfaces, lines or their contacts would not be the same afterwards
  shape,      ///< triangles would be worse than allowed
  turned,     ///< a triangle would turn over
  strayed,    ///< the input would lie too far from the mesh
  crossing,   ///< triangles would meet in more than shared vertices and edges
  reordered,  ///< surfaces would follow one another around a contact in another order
};
constexpr std::size_t verdict_count = 8;

/// What an operation may do to the triangles it changes. Quality of a triangle: the sine of its smallest angle; its
/// shortfall: the square of what its quality lacks to that of 35°; its shape: shape_of.
struct ShapeDemand {
  double floor = 0.0;             ///< no triangle below this, unless the worst of the changed ones was no better
  bool must_improve = false;      ///< the sum of shortfalls has to become smaller
  bool must_raise_worst = false;  ///< the worst changed triangle has to become better
  bool must_raise_mean = false;   ///< the mean shape of the mesh, taken to be 0.95, has to become better
  double longest = std::numeric_limits<double>::infinity();  ///< collapse: new edges, as a multiple of their size,
                                                             ///< unless there are longer ones already
};

struct GuardOptions {
  double distance_m = 0;                    ///< > 0: how far the input may lie from the mesh
  double turn_angle_deg = 50.0;             ///< (0, 90): how far a triangle may turn away from those it replaces
  double cell_m = 0;                        ///< > 0: about the length of edges to come
  std::function<bool()> is_cancelled = {};  ///< asked now and then, by several threads; once true every step is refused
};

/// How a mesh is cut for GuardedMesh::in_blocks.
struct BlockOptions {
  std::size_t most_triangles = 6000;  ///< of a block; a mesh of no more than three such is not cut
  double share = 0.5;  ///< in (0.3, 0.7), of the triangles on one side of a cut: another value puts it elsewhere
};

/// Sine of the smallest angle, 0 for a triangle without area.
double quality_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// 6 area / (√3 · longest edge · half the perimeter): 1 for equilateral triangles (pellerin2014 §2.9).
double shape_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// A conforming non-manifold triangle mesh that can only be changed by steps which keep it valid: the same corners,
/// lines (contacts and free borders) and surfaces, no improper intersection (decided exactly), every contact edge
/// shared by all its surfaces, corners in place, lines on the input's lines, new points on the input's surfaces, flat
/// sides flat to the last bit, the input within a given distance. A step that would break any of it is refused and
/// changes nothing (pellerin2014 §3 rules S1–S6).
/// Keeps a reference to `inputs`, whose model has to be valid and conforming.
class GuardedMesh {
 public:
  GuardedMesh(const InputSurfaces& inputs, const GuardOptions& options);

  /// Vertices and triangles keep their numbers while they live and nobody calls renumber().
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(points_.size()); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangles_.size()); }
  bool is_alive_vertex(std::uint32_t v) const { return head_[v] != no_index; }
  bool is_alive(std::uint32_t t) const { return surface_of_[t] != no_index; }
  /// Alive, and not of the surroundings of a block.
  bool is_changeable(std::uint32_t t) const { return is_alive(t) && !is_held(t); }
  const Vec3& point(std::uint32_t v) const { return points_[v]; }
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  std::uint32_t surface_of(std::uint32_t t) const { return surface_of_[t]; }
  VertexKind kind(std::uint32_t v) const { return kind_[v]; }
  bool is_fixed(std::uint32_t v) const { return is_fixed_[v] != 0; }
  /// Its surface, line or corner.
  std::uint32_t owner(std::uint32_t v) const { return owner_[v]; }
  double quality(std::uint32_t t) const {
    return quality_of(points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]);
  }
  /// Steps done so far, and the step that last changed a triangle: what did not change need not be looked at again.
  std::uint32_t step_count() const { return steps_; }
  std::uint32_t changed_at(std::uint32_t t) const { return changed_at_[t]; }
  /// The latest step that changed a triangle around a vertex.
  std::uint32_t star_changed_at(std::uint32_t v) const {
    std::uint32_t latest = 0;
    visit_star(v, [&](std::uint32_t t) { latest = std::max(latest, changed_at_[t]); });
    return latest;
  }
  /// Wanted length of edges at a vertex; carried along, the guards do not look at it but for ShapeDemand::longest.
  double size_m(std::uint32_t v) const { return size_m_[v]; }
  void set_size_m(std::uint32_t v, double size_m) { size_m_[v] = size_m; }
  /// Calls visit(triangle) for the triangles around a vertex.
  template <class Visit>
  void visit_star(std::uint32_t v, Visit&& visit) const {
    for (std::uint32_t h = head_[v]; h != no_index; h = next_[h]) visit(h / 3);
  }
  /// The line an edge is part of, or no_index.
  std::uint32_t line_of_edge(std::uint32_t a, std::uint32_t b) const;
  /// Of a line vertex: the vertices before and after it, and where these and it lie along the line, ascending.
  std::array<std::uint32_t, 2> line_neighbours(std::uint32_t v) const { return {before_[v], after_[v]}; }
  std::array<double, 3> arcs_around(std::uint32_t v) const;

  /// Moves a surface vertex to the place of its surface near `target`.
  Verdict move_vertex(std::uint32_t v, const Vec3& target, const ShapeDemand& demand);
  /// Moves a line vertex along its line, between its neighbours.
  Verdict slide_vertex(std::uint32_t v, double arc_m, const ShapeDemand& demand);
  /// Takes a vertex away and gives its triangles to a neighbour: a surface vertex to any, a line vertex to the next
  /// on its line.
  Verdict collapse_edge(std::uint32_t gone, std::uint32_t kept, const ShapeDemand& demand);
  /// A new vertex in the middle of an edge, put onto the input. It becomes vertex_count() − 1.
  Verdict split_edge(std::uint32_t a, std::uint32_t b, const ShapeDemand& demand);
  /// Replaces an edge inside a surface by the other diagonal of its two triangles.
  Verdict flip_edge(std::uint32_t a, std::uint32_t b, const ShapeDemand& demand);

  /// Calls work(part) for the whole mesh, or, where that is large, at the same time for parts of it, each a mesh of
  /// its own: the triangles wholly inside a block of space, and as surroundings that cannot be changed those across its
  /// sides. What parts come to is put together, perhaps renumbered; it depends on the mesh alone, not on the schedule.
  /// Triangles at the sides of blocks count as changed: whoever works on in other blocks finds them to be looked at.
  /// What work returned, by part. The default of what it returns has to exist.
  template <class Work>
  auto in_blocks(const BlockOptions& options, Work&& work) {
    using Done = std::invoke_result_t<Work&, GuardedMesh&>;
    if (triangle_count() - free_.size() <= 3 * options.most_triangles) return std::vector<Done>{work(*this)};
    const BlockCut cut = cut_into_blocks(options);
    std::vector<std::optional<GuardedMesh>> parts(cut.blocks.size());
    std::vector<Done> done(cut.blocks.size());
    parallel_ranges(parts.size(), 1, [&](std::size_t b, std::size_t) {
      parts[b].emplace(GuardedMesh(*this, cut, b));
      done[b] = work(*parts[b]);
    });
    take_back(cut, parts);
    return done;
  }

  /// Numbers vertices and triangles anew, without the dead, along a curve that fills space: sweeps over them then find
  /// most of what they read in the caches. Does nothing to a part of a mesh: its parts are small.
  void renumber();

  /// Whether GuardOptions::is_cancelled was true once.
  bool is_stopped() const { return is_stopped_; }

  /// How often operations ended so, by Verdict.
  const std::array<std::uint64_t, verdict_count>& verdicts() const { return verdicts_; }
  /// The mesh as a soup of one patch per surface of the input, in its order, with its entities, regions and layers.
  TriangleSoup soup() const;
  /// Alive triangles in the order of soup().
  std::vector<std::uint32_t> triangles_in_order() const;

 private:
  struct Added {
    Triangle corners{};
    std::uint32_t parent = 0;  ///< index into removed_
    FloatBox box;
  };
  struct Removed {
    std::uint32_t triangle = 0;
    double quality = 0, shape = 0;  ///< shape: where the demand needs it
    Vec3 normal;                    ///< twice the area long
  };
  struct SurfaceTurn {
    std::uint32_t surface = 0;
    Vec3 normal;
    double least_cos = 1;
  };
  struct SampleMove {
    std::uint32_t sample = 0, added = 0;
  };
  /// What no step changes.
  struct Frame {
    std::vector<std::uint32_t> first_corner_line, corner_lines;
    std::vector<int> flat_turn;  ///< per flat surface
    /// Per line of three and more surfaces: 2 surface + (1 if its triangles run along the line), around it.
    std::vector<std::vector<std::uint32_t>> radial;
    std::vector<FloatBox> pieces;         ///< boxes of the parts that hang together; empty if all does
    std::vector<std::uint32_t> piece_of;  ///< per surface
  };
  struct BlockCut {
    std::vector<SpaceBlock> blocks;                    ///< of triangles
    std::vector<std::vector<std::uint32_t>> vertices;  ///< per block: whose triangles are all inside it, ascending
    std::vector<std::uint32_t> block_of, number;       ///< per vertex: its block, or no_index, and place in `vertices`
  };
  /// Of a part of a mesh: where its vertices, triangles and samples come from, by their numbers here; new ones follow.
  struct Origin {
    FloatBox box;
    std::vector<std::uint32_t> vertices, triangles, samples;
    std::uint32_t own_vertices = 0, own_triangles = 0;  ///< those after them are the surroundings
    /// A vertex here by its number there, where the new ones begin at `first_new`.
    std::uint32_t number_outside(std::uint32_t v, std::uint32_t first_new) const {
      if (v < vertices.size()) return vertices[v];
      return v == no_index ? no_index : first_new + v - static_cast<std::uint32_t>(vertices.size());
    }
  };

  GuardedMesh(const GuardedMesh& whole, const BlockCut& cut, std::size_t block);
  BlockCut cut_into_blocks(const BlockOptions& options) const;
  void take_back(const BlockCut& cut, const std::vector<std::optional<GuardedMesh>>& parts);
  /// Gives a part's own triangles and vertices back to the mesh it is of, whose first new ones they become.
  void give_back(GuardedMesh& whole, std::uint32_t first_vertex, std::uint32_t first_triangle) const;
  bool is_held(std::uint32_t t) const {
    return origin_ && t >= origin_->own_triangles && t < origin_->triangles.size();
  }
  bool leaves_block();

  void find_kinds();
  void place_samples();
  void find_pieces();
  void note_radial_orders();
  Verdict noted(Verdict verdict) {
    ++verdicts_[static_cast<std::size_t>(verdict)];
    return verdict;
  }
  void begin_change();
  void remove(std::uint32_t t, const ShapeDemand& demand);  // measures it: call before any point moves
  void add(const Triangle& corners, std::uint32_t parent);
  bool is_removed(std::uint32_t t) const { return removed_mark_[t] == change_; }
  std::uint32_t new_mark();

  /// Judges removed_ against added_ with points and lines already as they would be. `is_inside_surface`: the union of
  /// the triangles stays the same but for its interior.
  Verdict judge(const ShapeDemand& demand, bool is_inside_surface);
  bool keeps_shape(const ShapeDemand& demand) const;
  bool keeps_direction();
  bool has_new_ear() const;
  bool is_ear(const Triangle& t) const;
  bool keeps_samples();
  bool keeps_apart();
  /// Something that hangs together with nothing of this lies near and is so small that it may lie between the old
  /// triangles and the new, touching neither.
  bool jumps_over_piece(FloatBox around) const;
  bool keeps_radial_order();
  bool has_radial_order(std::uint32_t line, std::uint32_t a, std::uint32_t b);
  void commit();
  template <class Accepted>
  Verdict try_move(std::uint32_t v, const Vec3& to, const ShapeDemand& demand, Accepted&& accepted);
  void link_triangle(std::uint32_t t);
  void unlink_triangle(std::uint32_t t);
  void link_all();
  void fill_grid();
  FloatBox box_of(const Triangle& t) const;

  void link_line(std::uint32_t a, std::uint32_t b);
  bool is_in_line_order(std::uint32_t line, std::uint32_t a, std::uint32_t b) const;
  /// Arc positions of an edge's ends, in line order, ascending.
  std::array<double, 2> arcs_of_edge(std::uint32_t line, std::uint32_t a, std::uint32_t b) const;
  bool line_stays_near(std::uint32_t line, std::uint32_t a, std::uint32_t b) const;
  bool grows_long(std::uint32_t gone, std::uint32_t kept, double longest) const;
  bool has_edge(std::uint32_t a, std::uint32_t b) const;

  const InputSurfaces& inputs_;
  GuardOptions options_;
  double cos_turn_ = 0;
  std::shared_ptr<Frame> frame_ = std::make_shared<Frame>();
  std::optional<Origin> origin_;  ///< of a part of another mesh

  std::vector<Vec3> points_;
  std::vector<VertexKind> kind_;
  std::vector<char> is_fixed_;
  std::vector<std::uint32_t> owner_;
  std::vector<double> arc_m_, size_m_;
  std::vector<std::uint32_t> before_, after_;  ///< line vertices
  std::vector<std::uint32_t> place_;           ///< surface vertices: the input triangle they lie on
  std::vector<std::uint32_t> head_;            ///< per vertex: first of its triangle corners 3 t + k
  std::vector<std::uint32_t> next_;            ///< per triangle corner

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> surface_of_, source_, first_sample_, changed_at_;
  std::uint32_t steps_ = 0;
  std::vector<std::uint32_t> free_;
  TriangleGrid grid_;
  bool is_grid_filled_ = false;  ///< from when the first step needs it

  std::vector<std::uint32_t> line_edges_;
  std::vector<Vec3> samples_;  ///< points of the input that have to stay near
  std::vector<std::uint32_t> next_sample_;

  // The change at hand.
  std::uint32_t change_ = 0, mark_ = 0;
  bool is_stopped_ = false;
  std::vector<Removed> removed_;
  std::vector<std::uint32_t> removed_mark_, vertex_mark_, seen_mark_, candidates_;
  std::vector<Added> added_;
  std::vector<SurfaceTurn> turns_;
  std::vector<SampleMove> sample_moves_;
  std::vector<std::array<std::uint32_t, 2>> inherited_;  ///< surface, source
  std::vector<Vec3> leaf_points_;
  std::vector<Triangle> leaf_triangles_;
  std::vector<std::uint32_t> leaf_half_edges_, leaf_words_;

  std::array<std::uint64_t, verdict_count> verdicts_{};
};

}  // namespace strataflow
