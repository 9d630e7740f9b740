#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/id.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// All surfaces of a soup in one welded mesh that can be refined and moved: points of one position are one vertex, so
/// what is inserted into a shared edge is inserted into every surface there. A triangle lies in a *plane*: pieces of
/// one undeformed triangle keep its plane, and the edge between two of them is *soft* (free to be flipped, not part of
/// the geometry); every other edge is hard. Not thread-safe to change; safe to read from several threads.
class ContactMesh {
 public:
  /// Triangles with a repeated position are left out. Indices in `soup` must be in range.
  explicit ContactMesh(const TriangleSoup& soup);

  const Vec3& point(std::uint32_t vertex) const { return points_[vertex]; }
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  bool is_alive(std::uint32_t t) const { return triangles_[t][0] != no_index; }
  std::uint32_t entity_of(std::uint32_t t) const { return patch_entity_[patch_[t]]; }
  std::uint32_t plane_of(std::uint32_t t) const { return plane_[t]; }
  std::size_t vertex_count() const { return points_.size(); }
  double diagonal_m() const { return diagonal_m_; }
  /// Every triangle an entity ever had; ask is_alive.
  const std::vector<std::uint32_t>& triangles_of(std::uint32_t entity) const { return entity_triangles_[entity]; }
  /// Where an input point, or a vertex that was merged away, is now.
  std::uint32_t vertex_of_input(std::uint32_t input_point) const { return current(weld_[input_point]); }
  std::uint32_t current(std::uint32_t vertex) const;
  /// Grows whenever triangles of the entity leave their place (being split does not count).
  std::uint32_t moves_of(std::uint32_t entity) const { return moves_[entity]; }

  /// Calls visit(triangle) for every triangle at a vertex. The mesh must not change meanwhile.
  template <class Visit>
  void visit_triangles_at(std::uint32_t vertex, Visit&& visit) const {
    for (std::uint32_t corner = head_[vertex]; corner != no_index; corner = next_[corner]) visit(corner / 3);
  }
  /// Triangles of all entities at an edge, the newest first.
  std::vector<std::uint32_t> triangles_at(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t count_at(std::uint32_t a, std::uint32_t b, std::uint32_t entity) const;
  bool has_edge(std::uint32_t a, std::uint32_t b, std::uint32_t entity) const { return count_at(a, b, entity) > 0; }
  bool is_soft(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t apex(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    const Triangle& tri = triangles_[t];
    return tri[0] != a && tri[0] != b ? tri[0] : tri[1] != a && tri[1] != b ? tri[1] : tri[2];
  }
  Vec3 normal_m2(std::uint32_t t) const;  ///< twice the area long
  /// The unit normal of an entity at a vertex, averaged by area; zero where it cancels out.
  Vec3 unit_normal_at(std::uint32_t vertex, std::uint32_t entity) const;

  std::uint32_t add_vertex(const Vec3& p);
  /// Splits the edge in every triangle around it.
  void split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t vertex);
  void split_triangle(std::uint32_t t, std::uint32_t vertex);
  /// Everything at `from` moves to `into`; triangles that lose an edge vanish. More than `tolerance_m` is a move.
  void merge(std::uint32_t from, std::uint32_t into, double tolerance_m);
  /// Replaces the edge a–b of a triangle by a, chain …, b: a fan around the third corner. The triangle is deformed.
  void deform_edge(std::uint32_t t, std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& chain);
  /// Makes u–v an edge of `entity` inside one plane, flipping soft edges only. Vertices exactly on the way are put into
  /// `passed`, in order. False, and nothing changed since the last passed vertex, if the two are not in one plane.
  bool insert_segment(std::uint32_t u, std::uint32_t v, std::uint32_t entity, std::vector<std::uint32_t>& passed);
  /// Flips soft edges near what was inserted since the last call where that widens the smallest angle.
  void widen_angles();

  /// Pieces of a triangle since the last start_pieces of its entity: the next one, or no_index.
  void start_pieces(std::uint32_t entity);
  std::uint32_t next_piece(std::uint32_t t) const { return next_piece_[t]; }

  /// The mesh as a soup: one point per vertex and patch; properties are interpolated in the input triangles, records
  /// of the file follow the points they name.
  TriangleSoup soup_like(const TriangleSoup& input) const;

 private:
  struct Plane {
    std::int8_t axis = -1;  ///< seen along which axis; −1 if the triangle was degenerate
    std::int8_t sign = 0;   ///< orientation of its pieces seen so
  };
  void link(std::uint32_t corner, std::uint32_t vertex);
  void unlink(std::uint32_t corner);
  void put_triangle(std::uint32_t t, const Triangle& tri);
  void remove_triangle(std::uint32_t t);
  std::uint32_t copy_triangle(std::uint32_t from, const Triangle& tri);
  void renew_plane(std::uint32_t t);
  int side(const Plane& plane, std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool retriangulate(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& chain, const Plane& plane,
                     std::vector<Triangle>& out) const;
  double smallest_sine(const Triangle& t) const;
  /// From `u` toward `v` in the plane of `first`: see insert_segment. Returns the vertex reached, or no_index.
  std::uint32_t walk(std::uint32_t u, std::uint32_t v, std::uint32_t first);

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> patch_, plane_, source_, next_piece_;  // per triangle
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> head_, merged_into_;  // per vertex
  std::vector<std::uint32_t> next_;                // per corner 3 t + k: the next corner at the same vertex
  std::vector<std::uint32_t> weld_;
  std::vector<std::uint32_t> patch_entity_, moves_;
  std::vector<std::vector<std::uint32_t>> entity_triangles_;
  std::vector<std::uint32_t> touched_;
  double diagonal_m_ = 0;
};

}  // namespace strataflow
