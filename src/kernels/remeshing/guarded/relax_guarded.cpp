#include "kernels/remeshing/guarded/relax_guarded.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "base/seed.h"

namespace strataflow {

namespace {

constexpr double sine_20_deg = 0.3420201433256687, sine_30_deg = 0.5;
constexpr double longest_share = 4.0 / 3, shortest_share = 3.0 / 4;
constexpr double poor_shape = 0.8;  ///< triangles below it are collapsed or split to raise the mean
constexpr double needle = 3e-4;     ///< quality below which no step takes a triangle: 0.017°
constexpr int most_sweeps = 16;

struct MeasuredEdge {
  double length = 0;  ///< as a share of its size
  std::uint32_t a = 0, b = 0;
};

template <class Wanted>
std::vector<MeasuredEdge> edges_where(const GuardedMesh& mesh, std::uint32_t since, Wanted&& wanted) {
  std::vector<MeasuredEdge> edges;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.is_changeable(t) || mesh.changed_at(t) < since) continue;
    const Triangle& corners = mesh.triangle(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = std::min(corners[k], corners[(k + 1) % 3]),
                          b = std::max(corners[k], corners[(k + 1) % 3]);
      const double share = length(mesh.point(b) - mesh.point(a)) / (0.5 * (mesh.size_m(a) + mesh.size_m(b)));
      if (wanted(share)) edges.push_back({share, a, b});
    }
  }
  return edges;
}

template <class Before>
void sort_unique(std::vector<MeasuredEdge>& edges, Before&& before) {
  std::sort(edges.begin(), edges.end(), [&](const MeasuredEdge& x, const MeasuredEdge& y) {
    if (x.length != y.length) return before(x.length, y.length);
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [](const MeasuredEdge& x, const MeasuredEdge& y) { return x.a == y.a && x.b == y.b; }),
              edges.end());
}

Vec3 star_centroid(const GuardedMesh& mesh, std::uint32_t v) {
  Vec3 sum;
  double whole = 0;
  const Vec3& p = mesh.point(v);
  mesh.visit_star(v, [&](std::uint32_t t) {
    const Triangle& c = mesh.triangle(t);
    const Vec3 &x = mesh.point(c[0]), &y = mesh.point(c[1]), &z = mesh.point(c[2]);
    const double area = length(cross(y - x, z - x));
    sum = sum + area * ((x - p) + (y - p) + (z - p));
    whole += area;
  });
  return whole > 0 ? p + (1 / (3 * whole)) * sum : p;
}

/// A triangle around a vertex without it: the edge opposite of it.
struct Opposite {
  Vec3 a, b;
  double length = 0;
};

void find_opposite(const GuardedMesh& mesh, std::uint32_t v, std::vector<Opposite>& star) {
  star.clear();
  mesh.visit_star(v, [&](std::uint32_t t) {
    const Triangle& c = mesh.triangle(t);
    const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
    const Vec3 &a = mesh.point(c[(k + 1) % 3]), &b = mesh.point(c[(k + 2) % 3]);
    star.push_back({a, b, length(b - a)});
  });
}

/// shape_of as share · twice the area / (longest edge · all edges).
constexpr double shape_share = 2 * std::numbers::sqrt3;

/// What the triangles around a vertex lack of the best shape, altogether, if it were at p.
double shape_loss(const std::vector<Opposite>& star, const Vec3& p) {
  double sum = 0;
  for (const Opposite& o : star) {
    const Vec3 pa = o.a - p, pb = o.b - p;
    const double x = length(pa), z = length(pb), longest = std::max({x, o.length, z});
    sum += longest > 0 ? 1 - shape_share * length(cross(pa, pb)) / (longest * (x + o.length + z)) : 1;
  }
  return sum;
}

/// The way on which shape_loss grows fastest, as fast as it does.
Vec3 shape_loss_slope(const std::vector<Opposite>& star, const Vec3& p) {
  Vec3 sum;
  for (const Opposite& o : star) {
    const Vec3 pa = o.a - p, pb = o.b - p, n = cross(pa, pb);
    const double x = length(pa), z = length(pb), area = length(n), longest = std::max({x, o.length, z}),
                 edges = x + o.length + z;
    if (!(area > 0)) continue;  // any way makes it better
    const Vec3 by_x = (-1 / x) * pa, by_z = (-1 / z) * pb;
    Vec3 relative = (1 / (area * area)) * cross(o.a - o.b, n) - (1 / edges) * (by_x + by_z);
    if (longest != o.length) relative = relative - (1 / longest) * (longest == x ? by_x : by_z);
    sum = sum - (shape_share * area / (longest * edges)) * relative;
  }
  return sum;
}

/// Where a surface vertex should go, along the way on which the loss falls fastest; itself where no step helps.
Vec3 shapelier_place(const std::vector<Opposite>& star, const Vec3& p, double least_gain) {
  Vec3 normal;
  double edge_m = 0;
  for (const Opposite& o : star) {
    const Vec3 n = cross(o.a - p, o.b - p);
    normal = normal + n;
    edge_m += std::sqrt(length(n));
  }
  const double square = dot(normal, normal);
  if (!(square > 0)) return p;
  edge_m /= static_cast<double>(star.size());
  Vec3 down = -1.0 * shape_loss_slope(star, p);
  down = down - (dot(down, normal) / square) * normal;
  const double slope = length(down);
  if (!(slope > 0)) return p;
  down = (edge_m / slope) * down;
  double least = shape_loss(star, p) * (1 - least_gain);
  Vec3 best = p;
  for (double step = 0.2; step > 0.01; step *= 0.5) {
    const Vec3 q = p + step * down;
    if (const double loss = shape_loss(star, q); loss < least) {
      least = loss;
      best = q;
    } else if (best != p) {
      break;
    }
  }
  return best;
}

/// The same of a line vertex: an arc position.
double shapelier_arc(const GuardedMesh& mesh, std::uint32_t v, const std::vector<Opposite>& star, double least_gain) {
  const auto [from, here, to] = mesh.arcs_around(v);
  const Vec3 p = mesh.point(v);
  double least = shape_loss(star, p) * (1 - least_gain), best = here;
  for (const int side : {0, 1})
    for (const double share : {0.2, 0.1, 0.05, 0.025}) {
      const Vec3 end = mesh.point(mesh.line_neighbours(v)[static_cast<std::size_t>(side)]);
      const double loss = shape_loss(star, p + share * (end - p));
      if (!(loss < least)) continue;
      least = loss;
      best = here + share * ((side == 0 ? from : to) - here);
    }
  return best;
}

/// Whether an edge is the longest of its triangle: only such an edge is worth a flip.
bool is_longest(const GuardedMesh& mesh, std::uint32_t t, std::size_t k) {
  const Triangle& c = mesh.triangle(t);
  const Vec3 &a = mesh.point(c[k]), &b = mesh.point(c[(k + 1) % 3]), &tip = mesh.point(c[(k + 2) % 3]);
  const Vec3 ab = b - a, at = tip - a, bt = tip - b;
  const double square = dot(ab, ab);
  return square >= dot(at, at) && square >= dot(bt, bt);
}

/// Sweeps over the living triangles that changed since `since`, trying step(triangle, k) on each edge k until one is
/// done; then over those that these sweeps changed, until none does or `sweeps` are over. The number of steps done.
template <class Step>
std::uint64_t sweep_edges(GuardedMesh& mesh, std::uint32_t since, int sweeps, Step&& step) {
  std::uint64_t done = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::uint64_t now = 0;
    const std::uint32_t start = mesh.step_count();
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!mesh.is_changeable(t) || mesh.changed_at(t) < since) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (step(t, k, since) == Verdict::done) {
          ++now;
          break;
        }
    }
    done += now;
    since = start + 1;
    if (now == 0) break;
  }
  return done;
}

}  // namespace

std::uint64_t split_long_edges(GuardedMesh& mesh, std::uint32_t since) {
  std::uint64_t done = 0;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    std::vector<MeasuredEdge> edges = edges_where(mesh, since, [](double share) { return share > longest_share; });
    sort_unique(edges, std::greater<>());
    std::uint64_t now = 0;
    for (const MeasuredEdge& edge : edges) now += mesh.split_edge(edge.a, edge.b, {.floor = needle}) == Verdict::done;
    done += now;
    if (now == 0) break;
  }
  return done;
}

std::uint64_t collapse_short_edges(GuardedMesh& mesh, std::uint32_t since) {
  std::uint64_t done = 0;
  const ShapeDemand demand{.floor = sine_20_deg, .longest = longest_share};
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    std::vector<MeasuredEdge> edges = edges_where(mesh, 0, [](double share) { return share < shortest_share; });
    // What was refused is refused again as long as nothing around it changes.
    if (since > 0)
      std::erase_if(edges, [&](const MeasuredEdge& edge) {
        return mesh.star_changed_at(edge.a) < since && mesh.star_changed_at(edge.b) < since;
      });
    sort_unique(edges, std::less<>());
    std::uint64_t now = 0;
    const std::uint32_t start = mesh.step_count() + 1;
    for (const MeasuredEdge& edge : edges) {
      if (!mesh.is_alive_vertex(edge.a) || !mesh.is_alive_vertex(edge.b)) continue;
      now += mesh.collapse_edge(edge.b, edge.a, demand) == Verdict::done ||
             mesh.collapse_edge(edge.a, edge.b, demand) == Verdict::done;
    }
    done += now;
    since = start;
    if (now == 0) break;
  }
  return done;
}

std::uint64_t flip_edges(GuardedMesh& mesh, std::uint32_t since) {
  const ShapeDemand demand{.must_raise_worst = true};
  return sweep_edges(mesh, since, most_sweeps, [&](std::uint32_t t, std::size_t k, std::uint32_t) {
    return is_longest(mesh, t, k) ? mesh.flip_edge(mesh.triangle(t)[k], mesh.triangle(t)[(k + 1) % 3], demand)
                                  : Verdict::shape;
  });
}

std::uint64_t even_valences(GuardedMesh& mesh, std::uint32_t since) {
  // Triangles of one surface at a vertex, less what there should be: six, three on a line, by angle at a corner.
  const auto excess = [&](std::uint32_t v, std::uint32_t surface) {
    int count = 0;
    double angle = 0;
    mesh.visit_star(v, [&](std::uint32_t t) {
      if (mesh.surface_of(t) != surface) return;
      ++count;
      if (mesh.kind(v) == VertexKind::surface) return;
      const Triangle& c = mesh.triangle(t);
      const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      const Vec3 a = mesh.point(c[(k + 1) % 3]) - mesh.point(v), b = mesh.point(c[(k + 2) % 3]) - mesh.point(v);
      angle += std::atan2(length(cross(a, b)), dot(a, b));
    });
    return count - (mesh.kind(v) == VertexKind::surface
                        ? 6
                        : std::max(1, static_cast<int>(std::lround(angle * (3 / std::numbers::pi)))));
  };
  const ShapeDemand demand{.floor = sine_20_deg};
  return sweep_edges(mesh, since, 4, [&](std::uint32_t t, std::size_t k, std::uint32_t recent) {
    const Triangle& c = mesh.triangle(t);
    const std::uint32_t a = c[k], b = c[(k + 1) % 3], s = mesh.surface_of(t);
    if (mesh.line_of_edge(a, b) != no_index) return Verdict::fixed;
    std::uint32_t other = no_index;
    mesh.visit_star(a, [&](std::uint32_t u) {
      if (u != t)
        for (const std::uint32_t w : mesh.triangle(u))
          if (w == b) other = u;
    });
    // The triangle of the lower number speaks for the edge.
    if (other == no_index || (other < t && mesh.changed_at(other) >= recent)) return Verdict::fixed;
    std::uint32_t d = no_index;
    for (const std::uint32_t w : mesh.triangle(other))
      if (w != a && w != b) d = w;
    const int ea = excess(a, s), eb = excess(b, s), ec = excess(c[(k + 2) % 3], s), ed = excess(d, s);
    if (2 * (ec + ed - ea - eb) + 4 >= 0) return Verdict::fixed;
    return mesh.flip_edge(a, b, demand);
  });
}

std::uint64_t even_out(GuardedMesh& mesh, std::uint32_t since, double least_gain) {
  std::uint64_t done = 0;
  const ShapeDemand demand{.floor = sine_30_deg};
  std::vector<Opposite> star;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive_vertex(v) || mesh.is_fixed(v) || mesh.star_changed_at(v) < since) continue;
    find_opposite(mesh, v, star);
    if (mesh.kind(v) == VertexKind::surface) {
      if (const Vec3 place = shapelier_place(star, mesh.point(v), least_gain); place != mesh.point(v))
        done += mesh.move_vertex(v, place, demand) == Verdict::done;
    } else if (const double arc = shapelier_arc(mesh, v, star, least_gain); arc != mesh.arcs_around(v)[1]) {
      done += mesh.slide_vertex(v, arc, demand) == Verdict::done;
    }
  }
  return done;
}

std::uint64_t raise_mean_shape(GuardedMesh& mesh, std::uint32_t since) {
  const ShapeDemand demand{.floor = sine_30_deg, .must_raise_mean = true, .longest = 1.8};
  std::uint64_t done = sweep_edges(mesh, since, 4, [&](std::uint32_t t, std::size_t k, std::uint32_t) {
    return is_longest(mesh, t, k) ? mesh.flip_edge(mesh.triangle(t)[k], mesh.triangle(t)[(k + 1) % 3], demand)
                                  : Verdict::shape;
  });
  done += sweep_edges(mesh, since, 2, [&](std::uint32_t t, std::size_t k, std::uint32_t) {
    const Triangle c = mesh.triangle(t);
    if (shape_of(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2])) > poor_shape) return Verdict::fixed;
    const std::uint32_t a = c[k], b = c[(k + 1) % 3];
    for (const auto& [gone, kept] : {std::pair{a, b}, std::pair{b, a}})
      if (mesh.collapse_edge(gone, kept, demand) == Verdict::done) return Verdict::done;
    return mesh.split_edge(a, b, demand);
  });
  return done;
}

std::uint64_t shake(GuardedMesh& mesh, double share) {
  std::uint64_t done = 0;
  const ShapeDemand demand{.floor = sine_20_deg};
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive_vertex(v) || mesh.kind(v) != VertexKind::surface) continue;
    RandomStream random(mix64(v));
    Vec3 step;
    for (int axis = 0; axis < 3; ++axis) step[axis] = share * mesh.size_m(v) * (2 * random.unit() - 1);
    done += mesh.move_vertex(v, mesh.point(v) + step, demand) == Verdict::done;
  }
  return done;
}

std::uint64_t mend_bad_triangles(GuardedMesh& mesh, std::uint32_t since) {
  struct Bad {
    double quality = 0;
    std::uint32_t triangle = 0;
    Triangle corners{};
  };
  std::vector<Bad> bad;
  const auto has_changed = [&](std::uint32_t t) {
    for (const std::uint32_t v : mesh.triangle(t))
      if (mesh.star_changed_at(v) >= since) return true;
    return false;
  };
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.is_changeable(t))
      if (const double q = mesh.quality(t); q < sine_30_deg && has_changed(t)) bad.push_back({q, t, mesh.triangle(t)});
  std::sort(bad.begin(), bad.end(), [](const Bad& x, const Bad& y) {
    return x.quality != y.quality ? x.quality < y.quality : x.triangle < y.triangle;
  });
  const ShapeDemand better{.floor = needle, .must_improve = true, .longest = 1.8};
  const auto mend = [&](const Bad& b) {
    std::array<std::uint32_t, 3> by_length{0, 1, 2};  // edge k runs from corner k
    const auto edge_length = [&](std::uint32_t k) {
      return length(mesh.point(b.corners[(k + 1) % 3]) - mesh.point(b.corners[k]));
    };
    std::stable_sort(by_length.begin(), by_length.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return edge_length(i) < edge_length(j); });
    for (std::size_t i = 3; i-- > 0;)
      if (mesh.flip_edge(b.corners[by_length[i]], b.corners[(by_length[i] + 1) % 3], better) == Verdict::done)
        return true;
    for (const std::uint32_t k : by_length) {
      const std::uint32_t u = b.corners[k], v = b.corners[(k + 1) % 3];
      if (mesh.collapse_edge(u, v, better) == Verdict::done || mesh.collapse_edge(v, u, better) == Verdict::done)
        return true;
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = b.corners[k];
      if (mesh.is_fixed(v)) continue;
      const Vec3 p = mesh.point(v);
      if (mesh.kind(v) == VertexKind::surface) {
        // To where the triangle would be equilateral, and to the middle of its neighbours.
        const Vec3 &x = mesh.point(b.corners[(k + 1) % 3]), &y = mesh.point(b.corners[(k + 2) % 3]);
        const Vec3 along = y - x, middle = 0.5 * (x + y);
        const double square = dot(along, along);
        Vec3 up = p - middle - (dot(p - middle, along) / square) * along;
        if (const double height = length(up); height > 0) up = (0.8660254037844386 * std::sqrt(square) / height) * up;
        for (const Vec3& target : {star_centroid(mesh, v), middle + up})
          for (const double share : {1.0, 0.5, 0.25, 0.1})
            if (mesh.move_vertex(v, p + share * (target - p), better) == Verdict::done) return true;
      } else {
        const auto [from, here, to] = mesh.arcs_around(v);
        const double start = here, back = from, on = to;
        for (const double share : {0.5, 0.25, 0.1})
          if (mesh.slide_vertex(v, start + share * (on - start), better) == Verdict::done ||
              mesh.slide_vertex(v, start + share * (back - start), better) == Verdict::done)
            return true;
      }
    }
    return mesh.split_edge(b.corners[by_length[2]], b.corners[(by_length[2] + 1) % 3], better) == Verdict::done;
  };
  std::uint64_t done = 0;
  for (const Bad& b : bad)
    if (mesh.is_alive(b.triangle) && mesh.triangle(b.triangle) == b.corners && mesh.quality(b.triangle) == b.quality)
      done += mend(b);
  return done;
}

}  // namespace strataflow
