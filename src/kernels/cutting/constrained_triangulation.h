#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/id.h"
#include "kernels/cutting/points_in_triangle.h"

namespace strataflow {

/// Triangulation of one triangle with points in it and segments that must be edges, Delaunay where the segments and
/// exactness allow (euler1999 §2.3.7). Every decision about what lies where is exact.
class ConstrainedTriangulation {
 public:
  struct Cell {
    std::array<std::uint32_t, 3> vertices;    ///< counter-clockwise as the triangle's corners
    std::array<std::uint32_t, 3> neighbours;  ///< across the edge from corner k to the next; no_index outside
    std::array<char, 3> is_fixed;             ///< the edge is a segment
  };

  /// Triangulates all points of `points` (at different positions, each where its place says) with `segments` between
  /// them. Segments cross nowhere and pass through no point but their ends. Returns false if they do: our bug.
  bool build(const PointsInTriangle& points, const std::vector<std::array<std::uint32_t, 2>>& segments);

  const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Edge {
    std::uint32_t cell;
    int k;
  };
  void split_edges_of_the_triangle();
  bool insert_inside(std::uint32_t point);
  bool insert_segment(std::uint32_t from, std::uint32_t to);
  bool locate(std::uint32_t point, std::uint32_t& cell, int& on_edge) const;
  bool contains(std::uint32_t cell, std::uint32_t point, int& on_edge) const;
  Edge across(std::uint32_t cell, int k) const;
  void split_cell(std::uint32_t cell, std::uint32_t point);
  void split_edge(std::uint32_t cell, int k, std::uint32_t point);
  void flip(std::uint32_t cell, int k);
  bool is_convex(std::uint32_t cell, int k) const;
  void legalize();
  void link(std::uint32_t cell, int k, std::uint32_t neighbour, std::uint32_t old_of_neighbour);
  void note(std::uint32_t cell) {
    for (const std::uint32_t v : cells_[cell].vertices) cell_at_[v] = cell;
  }
  bool find_edge(std::uint32_t from, std::uint32_t to, std::uint32_t& cell, int& k) const;
  template <class Visit>
  bool around(std::uint32_t vertex, Visit&& visit) const;

  const PointsInTriangle* points_ = nullptr;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> cell_at_;                 ///< per point: a cell that has it
  std::vector<std::array<std::uint32_t, 2>> suspect_;  ///< edges to look at again, by their points
  std::vector<std::array<std::uint32_t, 2>> crossed_;
  std::vector<std::uint32_t> on_edge_[3];
  mutable std::uint32_t hint_ = 0;
};

}  // namespace strataflow
