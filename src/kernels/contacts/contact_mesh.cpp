#include "kernels/contacts/contact_mesh.h"

#include <algorithm>
#include <cmath>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/building/weld_points.h"
#include "model/box3.h"

namespace strataflow {

namespace {

bool has_repeat(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

int index_of(const Triangle& t, std::uint32_t vertex) {
  return t[0] == vertex ? 0 : t[1] == vertex ? 1 : t[2] == vertex ? 2 : -1;
}

Triangle replaced(Triangle t, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t& v : t)
    if (v == from) v = to;
  return t;
}

/// Between u and v but for rounding: what is collinear in a projection need not be so in space.
bool is_between(const Vec3& u, const Vec3& v, const Vec3& p) {
  const Vec3 uv = v - u, up = p - u;
  const double along = dot(up, uv), whole = dot(uv, uv);
  return along > 0 && along < whole && length(cross(up, uv)) <= 1e-9 * whole;
}

}  // namespace

ContactMesh::ContactMesh(const TriangleSoup& soup)
    : patch_entity_(soup.patch_entity), moves_(soup.entities.size(), 0), entity_triangles_(soup.entities.size()) {
  const WeldedPoints welded = weld_points(soup.points);
  weld_ = welded.id;
  points_.reserve(welded.source.size());
  Box3 box;
  for (const std::uint32_t source : welded.source) {
    points_.push_back(soup.points[source]);
    box.take(points_.back());
  }
  diagonal_m_ = box.diagonal_m();
  head_.assign(points_.size(), no_index);
  merged_into_.assign(points_.size(), no_index);
  for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
    const Triangle& t = soup.triangles[i];
    const Triangle tri{weld_[t[0]], weld_[t[1]], weld_[t[2]]};
    if (has_repeat(tri)) continue;
    const auto id = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back({no_index, no_index, no_index});
    patch_.push_back(soup.triangle_patch[i]);
    plane_.push_back(0);
    source_.push_back(i);
    next_piece_.push_back(no_index);
    next_.resize(3 * triangles_.size(), no_index);
    entity_triangles_[entity_of(id)].push_back(id);
    put_triangle(id, tri);
    renew_plane(id);
  }
  touched_.clear();
}

std::uint32_t ContactMesh::current(std::uint32_t vertex) const {
  while (merged_into_[vertex] != no_index) vertex = merged_into_[vertex];
  return vertex;
}

void ContactMesh::link(std::uint32_t corner, std::uint32_t vertex) {
  triangles_[corner / 3][corner % 3] = vertex;
  next_[corner] = head_[vertex];
  head_[vertex] = corner;
}

void ContactMesh::unlink(std::uint32_t corner) {
  std::uint32_t* place = &head_[triangles_[corner / 3][corner % 3]];
  while (*place != corner) place = &next_[*place];
  *place = next_[corner];
}

void ContactMesh::put_triangle(std::uint32_t t, const Triangle& tri) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (triangles_[t][k] == tri[k]) continue;
    if (triangles_[t][k] != no_index) unlink(3 * t + k);
    link(3 * t + k, tri[k]);
  }
  touched_.push_back(t);
}

void ContactMesh::remove_triangle(std::uint32_t t) {
  for (std::uint32_t k = 0; k < 3; ++k) unlink(3 * t + k);
  triangles_[t] = {no_index, no_index, no_index};
}

std::uint32_t ContactMesh::copy_triangle(std::uint32_t from, const Triangle& tri) {
  const auto id = static_cast<std::uint32_t>(triangles_.size());
  triangles_.push_back({no_index, no_index, no_index});
  next_.resize(3 * triangles_.size(), no_index);
  patch_.push_back(patch_[from]);
  plane_.push_back(plane_[from]);
  source_.push_back(source_[from]);
  next_piece_.push_back(next_piece_[from]);
  next_piece_[from] = id;
  entity_triangles_[entity_of(from)].push_back(id);
  put_triangle(id, tri);
  return id;
}

void ContactMesh::renew_plane(std::uint32_t t) {
  const Triangle& tri = triangles_[t];
  const Vec3 &a = points_[tri[0]], &b = points_[tri[1]], &c = points_[tri[2]];
  Plane plane;
  plane.axis = static_cast<std::int8_t>(projection_axis(a, b, c));
  if (plane.axis >= 0) plane.sign = static_cast<std::int8_t>(orientation_2d(a, b, c, plane.axis));
  plane_[t] = static_cast<std::uint32_t>(planes_.size());
  planes_.push_back(plane);
}

int ContactMesh::side(const Plane& plane, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return plane.sign * orientation_2d(points_[a], points_[b], points_[c], plane.axis);
}

std::vector<std::uint32_t> ContactMesh::triangles_at(std::uint32_t a, std::uint32_t b) const {
  std::vector<std::uint32_t> found;
  visit_triangles_at(a, [&](std::uint32_t t) {
    if (index_of(triangles_[t], b) >= 0) found.push_back(t);
  });
  return found;
}

std::uint32_t ContactMesh::count_at(std::uint32_t a, std::uint32_t b, std::uint32_t entity) const {
  std::uint32_t count = 0;
  visit_triangles_at(a, [&](std::uint32_t t) { count += index_of(triangles_[t], b) >= 0 && entity_of(t) == entity; });
  return count;
}

bool ContactMesh::is_soft(std::uint32_t a, std::uint32_t b) const {
  const auto around = triangles_at(a, b);
  return around.size() == 2 && plane_[around[0]] == plane_[around[1]];
}

Vec3 ContactMesh::normal_m2(std::uint32_t t) const {
  const Triangle& tri = triangles_[t];
  return cross(points_[tri[1]] - points_[tri[0]], points_[tri[2]] - points_[tri[0]]);
}

Vec3 ContactMesh::unit_normal_at(std::uint32_t vertex, std::uint32_t entity) const {
  Vec3 sum;
  double size = 0;
  visit_triangles_at(vertex, [&](std::uint32_t t) {
    if (entity_of(t) != entity) return;
    const Vec3 n = normal_m2(t);
    sum = sum + n;
    size += length(n);
  });
  const double norm = length(sum);
  return norm > 1e-6 * size ? (1 / norm) * sum : Vec3{};
}

std::uint32_t ContactMesh::add_vertex(const Vec3& p) {
  points_.push_back(p);
  head_.push_back(no_index);
  merged_into_.push_back(no_index);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

void ContactMesh::split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t vertex) {
  for (const std::uint32_t t : triangles_at(a, b)) {
    const Triangle tri = triangles_[t];
    if (index_of(tri, vertex) >= 0) {  // it lay on this edge already: a triangle without area
      remove_triangle(t);
      continue;
    }
    put_triangle(t, replaced(tri, b, vertex));
    copy_triangle(t, replaced(tri, a, vertex));
  }
}

void ContactMesh::split_triangle(std::uint32_t t, std::uint32_t vertex) {
  const Triangle tri = triangles_[t];
  for (const std::uint32_t corner : {tri[1], tri[2]}) copy_triangle(t, replaced(tri, corner, vertex));
  put_triangle(t, replaced(tri, tri[0], vertex));
}

void ContactMesh::merge(std::uint32_t from, std::uint32_t into, double tolerance_m) {
  if (from == into) return;
  const bool is_moved = length(points_[from] - points_[into]) > tolerance_m;
  std::vector<std::uint32_t> around;
  visit_triangles_at(from, [&](std::uint32_t t) { around.push_back(t); });
  for (const std::uint32_t t : around) {
    if (is_moved) ++moves_[entity_of(t)];
    if (index_of(triangles_[t], into) >= 0) {
      remove_triangle(t);
      continue;
    }
    put_triangle(t, replaced(triangles_[t], from, into));
    renew_plane(t);
  }
  merged_into_[from] = into;
}

void ContactMesh::deform_edge(std::uint32_t t, std::uint32_t a, std::uint32_t b,
                              const std::vector<std::uint32_t>& chain) {
  ++moves_[entity_of(t)];
  std::vector<std::uint32_t> way{a};
  way.insert(way.end(), chain.begin(), chain.end());
  way.push_back(b);
  const Triangle whole = triangles_[t];
  bool is_used = false;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    Triangle piece = whole;
    piece[index_of(whole, a)] = way[i];
    piece[index_of(whole, b)] = way[i + 1];
    if (has_repeat(piece)) continue;
    std::uint32_t id = t;
    if (is_used)
      id = copy_triangle(t, piece);
    else
      put_triangle(t, piece);
    renew_plane(id);
    is_used = true;
  }
  if (!is_used) remove_triangle(t);
}

bool ContactMesh::retriangulate(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& chain,
                                const Plane& plane, std::vector<Triangle>& out) const {
  // Chain lies left of a → b. The corner that sees the base under the widest angle leaves the others outside its
  // circle (Anglada 1997).
  struct Part {
    std::uint32_t a, b;
    std::size_t begin, end;
  };
  std::vector<Part> parts{{a, b, 0, chain.size()}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.begin == part.end) continue;
    std::size_t best = part.end;
    double best_cosine = 2;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (side(plane, part.a, part.b, chain[i]) <= 0) continue;
      const Vec3 u = points_[part.a] - points_[chain[i]], v = points_[part.b] - points_[chain[i]];
      const double cosine = dot(u, v) / std::sqrt(dot(u, u) * dot(v, v));
      if (cosine < best_cosine) {
        best_cosine = cosine;
        best = i;
      }
    }
    if (best == part.end) return false;
    out.push_back({part.a, part.b, chain[best]});
    parts.push_back({part.a, chain[best], part.begin, best});
    parts.push_back({chain[best], part.b, best + 1, part.end});
  }
  return true;
}

std::uint32_t ContactMesh::walk(std::uint32_t u, std::uint32_t v, std::uint32_t first) {
  const Plane plane = planes_[plane_[first]];
  if (plane.axis < 0) return no_index;
  const int k = index_of(triangles_[first], u);
  std::uint32_t right = triangles_[first][(k + 1) % 3], left = triangles_[first][(k + 2) % 3];
  for (const std::uint32_t ahead : {right, left})
    if (side(plane, u, ahead, v) == 0 && is_between(points_[u], points_[v], points_[ahead])) return ahead;
  if (!(side(plane, u, right, v) > 0 && side(plane, u, left, v) < 0)) return no_index;
  std::vector<std::uint32_t> crossed{first}, on_right{right}, on_left{left};
  std::uint32_t goal = no_index;
  while (goal == no_index) {
    const auto around = triangles_at(right, left);
    if (around.size() != 2 || plane_[around[0]] != plane_[around[1]]) return no_index;
    const std::uint32_t t = around[0] == crossed.back() ? around[1] : around[0];
    if (crossed.size() > triangles_.size()) return no_index;
    crossed.push_back(t);
    const std::uint32_t c = apex(t, right, left);
    const int where = c == v ? 0 : side(plane, u, v, c);
    if (where == 0) {
      if (c != v && !is_between(points_[u], points_[v], points_[c])) return no_index;  // v lies in another plane
      goal = c;
    } else if (where > 0) {
      on_left.push_back(left = c);
    } else {
      on_right.push_back(right = c);
    }
  }
  std::vector<Triangle> made;
  // Left of goal → u lies what is right of u → goal.
  if (!retriangulate(u, goal, on_left, plane, made) ||
      !retriangulate(goal, u, {on_right.rbegin(), on_right.rend()}, plane, made) || made.size() != crossed.size())
    return no_index;
  for (std::size_t i = 0; i < made.size(); ++i) put_triangle(crossed[i], made[i]);
  return goal;
}

bool ContactMesh::insert_segment(std::uint32_t u, std::uint32_t v, std::uint32_t entity,
                                 std::vector<std::uint32_t>& passed) {
  while (u != v && !has_edge(u, v, entity)) {
    std::vector<std::uint32_t> around;
    visit_triangles_at(u, [&](std::uint32_t t) {
      if (entity_of(t) == entity) around.push_back(t);
    });
    std::uint32_t reached = no_index;
    for (std::size_t i = 0; i < around.size() && reached == no_index; ++i) reached = walk(u, v, around[i]);
    if (reached == no_index) return false;
    u = reached;
    if (u != v) passed.push_back(u);
  }
  return true;
}

double ContactMesh::smallest_sine(const Triangle& t) const {
  const double area2 = length(cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]));
  std::array<double, 3> side_m{};
  for (int k = 0; k < 3; ++k) side_m[k] = length(points_[t[(k + 1) % 3]] - points_[t[k]]);
  std::sort(side_m.begin(), side_m.end());
  return area2 / (side_m[1] * side_m[2]);
}

void ContactMesh::widen_angles() {
  std::size_t flips_left = 50 * touched_.size() + 100;
  while (!touched_.empty() && flips_left > 0) {
    const std::uint32_t t = touched_.back();
    touched_.pop_back();
    if (!is_alive(t) || planes_[plane_[t]].axis < 0) continue;
    const Plane plane = planes_[plane_[t]];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3], c = triangles_[t][(k + 2) % 3];
      const auto around = triangles_at(a, b);
      if (around.size() != 2 || plane_[around[0]] != plane_[around[1]]) continue;
      const std::uint32_t other = around[0] == t ? around[1] : around[0];
      const std::uint32_t d = apex(other, a, b);
      if (side(plane, a, d, c) <= 0 || side(plane, d, b, c) <= 0 || !triangles_at(c, d).empty()) continue;
      const Triangle one{a, d, c}, two{d, b, c};
      const double before = std::min(smallest_sine(triangles_[t]), smallest_sine(triangles_[other]));
      if (!(std::min(smallest_sine(one), smallest_sine(two)) > before * (1 + 1e-9))) continue;
      put_triangle(t, one);
      put_triangle(other, two);
      --flips_left;
      break;
    }
  }
  touched_.clear();
}

void ContactMesh::start_pieces(std::uint32_t entity) {
  for (const std::uint32_t t : entity_triangles_[entity]) next_piece_[t] = no_index;
}

TriangleSoup ContactMesh::soup_like(const TriangleSoup& input) const {
  TriangleSoup out;
  out.local_origin = input.local_origin;
  out.patch_entity = input.patch_entity;
  out.patch_other_entities = input.patch_other_entities;
  out.entities = input.entities;
  out.regions = input.regions;
  out.layers = input.layers;
  for (const PointProperty& property : input.properties)
    out.properties.push_back({property.name, property.unit, property.width, {}});

  // Triangles in the order of the ones they come from.
  std::vector<std::uint32_t> order;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    if (is_alive(t)) order.push_back(t);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t s, std::uint32_t t) { return source_[s] < source_[t]; });

  std::vector<std::uint32_t> first(points_.size(), no_index), next, patch;  // the points of a vertex, one per patch
  const auto find = [&](std::uint32_t vertex, std::uint32_t p) {
    std::uint32_t at = first[vertex];
    while (at != no_index && patch[at] != p) at = next[at];
    return at;
  };
  for (const std::uint32_t t : order) {
    Triangle tri{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = triangles_[t][k];
      tri[k] = find(v, patch_[t]);
      if (tri[k] != no_index) continue;
      tri[k] = static_cast<std::uint32_t>(out.points.size());
      next.push_back(first[v]);
      patch.push_back(patch_[t]);
      first[v] = tri[k];
      out.points.push_back(points_[v]);
      if (out.properties.empty()) continue;
      const Triangle& from = input.triangles[source_[t]];
      const Vec3 &a = input.points[from[0]], &b = input.points[from[1]], &c = input.points[from[2]];
      const Vec3 n = cross(b - a, c - a);
      const double area = dot(n, n);
      std::array<double, 3> share{dot(cross(b - points_[v], c - points_[v]), n) / area,
                                  dot(cross(c - points_[v], a - points_[v]), n) / area, 0};
      for (double& s : share) s = area > 0 ? std::clamp(s, 0.0, 1.0) : 0.0;
      share[1] = std::min(share[1], 1 - share[0]);
      share[2] = 1 - share[0] - share[1];
      for (int corner = 0; corner < 3; ++corner)  // a value of a corner stays as it is, to the bit
        if (input.points[from[corner]] == points_[v])
          share = {double(corner == 0), double(corner == 1), double(corner == 2)};
      for (std::size_t p = 0; p < input.properties.size(); ++p)
        for (std::uint32_t w = 0; w < input.properties[p].width; ++w) {
          double value = 0;
          for (int corner = 0; corner < 3; ++corner)
            if (share[corner] > 0)
              value +=
                  share[corner] * input.properties[p].values[std::size_t{from[corner]} * input.properties[p].width + w];
          out.properties[p].values.push_back(value);
        }
    }
    out.triangles.push_back(tri);
    out.triangle_patch.push_back(patch_[t]);
  }

  std::vector<std::uint32_t> patch_of_point(input.points.size(), no_index);
  for (std::size_t i = 0; i < input.triangles.size(); ++i)
    for (const std::uint32_t p : input.triangles[i]) patch_of_point[p] = input.triangle_patch[i];
  const auto now_at = [&](std::uint32_t p) {
    return patch_of_point[p] == no_index ? no_index : find(vertex_of_input(p), patch_of_point[p]);
  };
  for (const std::uint32_t stone : input.border_stones)
    if (now_at(stone) != no_index) out.border_stones.push_back(now_at(stone));
  for (const auto& [a, b] : input.border_starts)
    if (now_at(a) != no_index && now_at(b) != no_index) out.border_starts.push_back({now_at(a), now_at(b)});
  return out;
}

}  // namespace strataflow
