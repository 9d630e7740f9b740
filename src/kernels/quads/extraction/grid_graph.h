#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/extraction/grid_map.h"

namespace strataflow {

/// The points of a mesh whose map has whole coordinates, and the unit steps between them. A port is a way out of
/// a vertex along the grid: in the chart of `triangle`, towards i^direction.
struct GridGraph {
  enum class Place : std::uint8_t { point, edge, triangle };
  struct Vertex {
    Place place = Place::point;
    std::uint32_t element = 0;  ///< mesh point; the lower of the edge's half-edges; triangle
    GaussianInteger uv;         ///< in the chart of first_out[point], of that half-edge, of the triangle
  };
  struct Port {
    std::uint32_t vertex = 0;
    std::uint32_t triangle = 0;
    std::uint8_t direction = 0;
    bool keeps_left = false;  ///< along the boundary, with the domain to its right
  };
  std::vector<Vertex> vertices;              ///< at points, on edges, in triangles, ascending
  std::vector<std::uint32_t> first_port;     ///< per vertex, plus one
  std::vector<Port> ports;                   ///< counter-clockwise around each vertex; on the boundary from its start
  std::vector<std::uint32_t> partner;        ///< per port: the port at the other end of its step, or no_index outside
  std::vector<char> is_on_boundary;          ///< per vertex
  std::vector<std::uint32_t> at_point;       ///< per mesh point: its vertex or no_index
  std::vector<std::uint32_t> first_on_edge;  ///< per half-edge, plus one: vertices on it, from its origin
  std::vector<Vec3> positions;               ///< per vertex
};

/// Finds all vertices and follows all steps, exactly. Fails with geometry_failed when a step goes astray, or past
/// `vertex_limit` vertices.
Result<GridGraph> trace_grid(const FeatureMesh& mesh, const GridMap& map, std::size_t vertex_limit = 20'000'000);

}  // namespace strataflow
