#include "kernels/adapters/cgal/constrained_delaunay.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <exception>
#include <map>
#include <string>

#include "base/id.h"

namespace strataflow {

namespace {

template <class Kernel, class Tag>
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>,
                                         CGAL::Constrained_triangulation_face_base_2<Kernel>>,
    Tag>;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Arranged = CGAL::Constrained_triangulation_plus_2<Delaunay<Exact, CGAL::Exact_intersections_tag>>;
using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulated = Delaunay<Filtered, CGAL::No_constraint_intersection_tag>;

}  // namespace

SegmentArrangement arrange_segments(std::span<const Vec3> points, std::span<const PlaneSegment> segments) {
  SegmentArrangement result;
  result.points.assign(points.begin(), points.end());
  result.place_of.resize(points.size());
  Arranged arranged;
  std::vector<Arranged::Vertex_handle> vertex(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::size_t before = arranged.number_of_vertices();
    vertex[i] = arranged.insert(Exact::Point_2(points[i].x, points[i].y));
    if (arranged.number_of_vertices() > before) vertex[i]->info() = i;
    result.place_of[i] = vertex[i]->info();
  }
  // The triangulation wants every constraint once.
  std::map<PlaneSegment, std::vector<std::uint32_t>> users;
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const std::uint32_t a = result.place_of[segments[s][0]], b = result.place_of[segments[s][1]];
    if (a != b) users[{std::min(a, b), std::max(a, b)}].push_back(s);
  }
  std::vector<Arranged::Constraint_id> constraint(segments.size());
  for (const auto& [ends, who] : users) {
    const auto id = arranged.insert_constraint(vertex[ends[0]], vertex[ends[1]]);
    for (const std::uint32_t s : who) constraint[s] = id;
  }
  // Crossings are numbered by position: the order in which they were found depends on pointers.
  std::map<std::pair<double, double>, std::uint32_t> crossing_at;
  const auto rounded = [](const Arranged::Vertex_handle& v) {
    return std::pair(CGAL::to_double(CGAL::exact(v->point().x())) + 0.0,
                     CGAL::to_double(CGAL::exact(v->point().y())) + 0.0);
  };
  for (auto v = arranged.finite_vertices_begin(); v != arranged.finite_vertices_end(); ++v) v->info() = no_index;
  for (std::uint32_t i = 0; i < points.size(); ++i) vertex[i]->info() = result.place_of[i];
  for (auto v = arranged.finite_vertices_begin(); v != arranged.finite_vertices_end(); ++v)
    if (v->info() == no_index) crossing_at[rounded(v)] = 0;
  for (auto& [position, index] : crossing_at) {
    index = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back({position.first, position.second, 0});
  }
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    if (result.place_of[segments[s][0]] == result.place_of[segments[s][1]]) continue;
    std::vector<std::uint32_t> chain;
    for (auto v = arranged.vertices_in_constraint_begin(constraint[s]);
         v != arranged.vertices_in_constraint_end(constraint[s]); ++v)
      chain.push_back((*v)->info() != no_index ? (*v)->info() : crossing_at.at(rounded(*v)));
    if (chain.front() != result.place_of[segments[s][0]]) std::reverse(chain.begin(), chain.end());
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      if (chain[i] != chain[i + 1]) result.pieces.push_back({chain[i], chain[i + 1], s});
  }
  return result;
}

Result<std::vector<Triangle>> constrained_delaunay(std::span<const Vec3> points,
                                                   std::span<const PlaneSegment> segments) {
  const auto failed = [](const std::string& what) {
    return Failure{FailureCode::geometry_failed, "constrained triangulation: " + what,
                   "report this network: its segments should have been cut where they meet"};
  };
  Triangulated triangulated;
  std::vector<Triangulated::Vertex_handle> vertex(points.size());
  Triangulated::Face_handle near;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    vertex[i] = triangulated.insert(Filtered::Point_2(points[i].x, points[i].y), near);
    vertex[i]->info() = i;
    near = vertex[i]->face();
    if (triangulated.number_of_vertices() != i + 1)
      return failed("point " + std::to_string(i) + " lies on another one");
  }
  try {
    for (const PlaneSegment& s : segments) triangulated.insert_constraint(vertex[s[0]], vertex[s[1]]);
  } catch (const std::exception&) {
    return failed("two segments cross");
  }
  if (triangulated.number_of_vertices() != points.size()) return failed("two segments cross");
  std::vector<Triangle> triangles;
  for (auto f = triangulated.finite_faces_begin(); f != triangulated.finite_faces_end(); ++f) {
    Triangle t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace strataflow
