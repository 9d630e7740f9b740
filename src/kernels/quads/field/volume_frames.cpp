#include "kernels/quads/field/volume_frames.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/id.h"
#include "graph/parallel/ordered_reduce.h"
#include "kernels/adapters/lbfgs/minimize.h"
#include "kernels/quads/field/spherical_harmonics.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 256;
constexpr std::array<std::array<std::size_t, 3>, 4> face_corners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};  // outward

struct Cells {
  std::vector<std::array<std::uint32_t, 4>> vertices;
  std::vector<std::array<std::uint32_t, 4>> neighbour;  ///< across the face facing corner k; no_index outside
};

Result<Cells> connect(const VolumeMesh& mesh) {
  const auto bad = [](std::size_t cell, const std::string& what) {
    return Failure{FailureCode::invalid_input, "cell " + std::to_string(cell) + " " + what,
                   "a frame field needs a valid tetrahedral mesh"};
  };
  Cells cells;
  struct Face {
    std::array<std::uint32_t, 3> key{};
    std::uint32_t cell = 0, side = 0;
  };
  std::vector<Face> faces;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.cell_types[c] != CellType::tetrahedron) return bad(c, "is no tetrahedron");
    std::array<std::uint32_t, 4> v{};
    for (std::size_t k = 0; k < 4; ++k) {
      v[k] = mesh.cell_vertices[mesh.cell_offsets[c] + k];
      if (v[k] >= mesh.points.size() || !is_finite(mesh.points[v[k]])) return bad(c, "has a point that is not there");
    }
    const Vec3& o = mesh.points[v[0]];
    if (!(dot(cross(mesh.points[v[1]] - o, mesh.points[v[2]] - o), mesh.points[v[3]] - o) > 0))
      return bad(c, "is inverted");
    for (std::uint32_t k = 0; k < 4; ++k) {
      std::array<std::uint32_t, 3> key{v[face_corners[k][0]], v[face_corners[k][1]], v[face_corners[k][2]]};
      std::sort(key.begin(), key.end());
      faces.push_back({key, static_cast<std::uint32_t>(c), k});
    }
    cells.vertices.push_back(v);
  }
  if (cells.vertices.empty())
    return Failure{FailureCode::invalid_input, "a mesh without cells", "a frame field needs a valid tetrahedral mesh"};
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tie(a.key, a.cell, a.side) < std::tie(b.key, b.cell, b.side);
  });
  cells.neighbour.assign(cells.vertices.size(), {no_index, no_index, no_index, no_index});
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    if (faces[i].key != faces[i + 1].key) continue;
    if (i + 2 < faces.size() && faces[i + 2].key == faces[i].key)
      return bad(faces[i].cell, "shares a face with two others");
    cells.neighbour[faces[i].cell][faces[i].side] = faces[i + 1].cell;
    cells.neighbour[faces[i + 1].cell][faces[i + 1].side] = faces[i].cell;
  }
  return cells;
}

Vec3 unit(const Vec3& v) { return (1 / length(v)) * v; }

/// A right-handed cross whose first arms are the given directions, made orthogonal.
VolumeFrame cross_from(std::vector<Vec3> directions) {
  const Vec3 u = directions.empty() ? Vec3{1, 0, 0} : directions[0];
  Vec3 v = directions.size() > 1 ? directions[1] - dot(directions[1], u) * u : Vec3{};
  if (!(length(v) > 1e-6)) {
    const Vec3 helper = std::abs(u.x) < 0.6 ? Vec3{1, 0, 0} : std::abs(u.y) < 0.6 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    v = helper - dot(helper, u) * u;
  }
  v = unit(v);
  return {u, v, cross(u, v)};
}

struct Coefficients {
  std::array<double, 5> second{};
  std::array<double, 9> fourth{};
};

/// Algorithm 1's f_k in 3D, 9 unknowns per cell.
struct VolumeDiffusion {
  const Cells& cells;
  const VolumeFrameOptions& options;
  std::vector<std::uint8_t> fixed;  ///< per direction, 3 per cell
  std::vector<double> before;

  static Vec3 direction(const std::vector<double>& x, std::size_t i) { return {x[3 * i], x[3 * i + 1], x[3 * i + 2]}; }
  std::vector<Coefficients> coefficients(const std::vector<double>& x) const {
    return parallel_map(
        cells.vertices.size(),
        [&](std::size_t c) {
          Coefficients sum;
          for (std::size_t i = 3 * c; i < 3 * c + 3; ++i) {
            const auto second = harmonics_2(direction(x, i));
            const auto fourth = harmonics_4(direction(x, i));
            for (std::size_t m = 0; m < 5; ++m) sum.second[m] += second[m];
            for (std::size_t m = 0; m < 9; ++m) sum.fourth[m] += fourth[m];
          }
          return sum;
        },
        grain);
  }
  double smoothness(const std::vector<Coefficients>& c) const {
    const double weight = options.lambda * options.lambda;
    return ordered_reduce(
        c.size(), 0.0,
        [&](std::size_t cell) {
          double sum = 0;
          for (const std::uint32_t other : cells.neighbour[cell]) {
            if (other == no_index || other < cell) continue;
            for (std::size_t m = 0; m < 5; ++m) sum += weight * std::pow(c[cell].second[m] - c[other].second[m], 2);
            for (std::size_t m = 0; m < 9; ++m) sum += std::pow(c[cell].fourth[m] - c[other].fourth[m], 2);
          }
          return sum;
        },
        [](double a, double b) { return a + b; });
  }
  bool is_regularised(std::size_t cell) const { return fixed[3 * cell] || fixed[3 * cell + 1] || fixed[3 * cell + 2]; }

  double operator()(const std::vector<double>& x, std::vector<double>& gradient) const {
    const auto c = coefficients(x);
    const double local = ordered_reduce(
        fixed.size(), 0.0,
        [&](std::size_t i) {
          if (fixed[i]) return 0.0;
          const Vec3 u = direction(x, i), moved = u - direction(before, i);
          const double off = dot(u, u) - 1;
          return (is_regularised(i / 3) ? off * off / options.unit_penalty : 0.0) + dot(moved, moved) / options.time;
        },
        [](double a, double b) { return a + b; });
    parallel_ranges(cells.vertices.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t cell = begin; cell < end; ++cell) {
        Coefficients slope;
        for (const std::uint32_t other : cells.neighbour[cell]) {
          if (other == no_index) continue;
          for (std::size_t m = 0; m < 5; ++m)
            slope.second[m] += 2 * options.lambda * options.lambda * (c[cell].second[m] - c[other].second[m]);
          for (std::size_t m = 0; m < 9; ++m) slope.fourth[m] += 2 * (c[cell].fourth[m] - c[other].fourth[m]);
        }
        for (std::size_t i = 3 * cell; i < 3 * cell + 3; ++i) {
          Vec3 g;
          if (!fixed[i]) {
            const Vec3 u = direction(x, i);
            const auto second = harmonics_2_gradient(u);
            const auto fourth = harmonics_4_gradient(u);
            for (std::size_t m = 0; m < 5; ++m) g = g + slope.second[m] * second[m];
            for (std::size_t m = 0; m < 9; ++m) g = g + slope.fourth[m] * fourth[m];
            if (is_regularised(cell)) g = g + 4 * (dot(u, u) - 1) / options.unit_penalty * u;
            g = g + 2 / options.time * (u - direction(before, i));
          }
          for (int axis = 0; axis < 3; ++axis) gradient[3 * i + static_cast<std::size_t>(axis)] = g[axis];
        }
      }
    });
    return smoothness(c) + local;
  }
};

double determinant(const VolumeFrame& f) { return dot(cross(f[0], f[1]), f[2]); }

/// How the directions of a neighbour correspond to ours: ours[i] = sign[i] · theirs[of[i]].
struct Matching {
  std::array<std::uint8_t, 3> of{0, 1, 2};
  std::array<std::int8_t, 3> sign{1, 1, 1};
  friend bool operator==(const Matching&, const Matching&) = default;
};

/// The rotation of the cube group (24 elements) that brings their frame nearest to ours.
Matching match(const VolumeFrame& ours, const VolumeFrame& theirs) {
  static constexpr std::array<std::array<std::uint8_t, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  Matching best;
  double most = -10;
  for (std::size_t o = 0; o < 6; ++o)
    for (int signs = 0; signs < 8; ++signs) {
      const int flips = (signs & 1) + (signs >> 1 & 1) + (signs >> 2 & 1);
      if ((flips + (o >= 3)) % 2) continue;  // no mirror images
      Matching candidate;
      candidate.of = orders[o];
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        candidate.sign[i] = signs >> i & 1 ? -1 : 1;
        sum += candidate.sign[i] * dot(ours[i], theirs[candidate.of[i]]);
      }
      if (sum > most + 1e-12) {
        most = sum;
        best = candidate;
      }
    }
  return best;
}

/// First `inner`, then `outer`: ours to a second frame, the second to a third.
Matching then(const Matching& outer, const Matching& inner) {
  Matching result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.of[i] = inner.of[outer.of[i]];
    result.sign[i] = static_cast<std::int8_t>(outer.sign[i] * inner.sign[outer.of[i]]);
  }
  return result;
}

/// Inner edges around which the matchings do not close, as curves between the points where they meet or end.
std::vector<Polyline> singular_curves(const VolumeMesh& mesh, const Cells& cells,
                                      const std::vector<VolumeFrame>& frames) {
  struct EdgeUse {
    std::array<std::uint32_t, 2> ends{};
    std::uint32_t cell = 0;
  };
  std::vector<EdgeUse> uses;
  for (std::uint32_t c = 0; c < cells.vertices.size(); ++c)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        uses.push_back({{std::min(cells.vertices[c][i], cells.vertices[c][j]),
                         std::max(cells.vertices[c][i], cells.vertices[c][j])},
                        c});
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& a, const EdgeUse& b) { return std::tie(a.ends, a.cell) < std::tie(b.ends, b.cell); });
  std::vector<std::array<std::uint32_t, 2>> singular;
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin;
    while (end < uses.size() && uses[end].ends == uses[begin].ends) ++end;
    // Around the edge from cell to cell, entering each by one of the two faces that hold it.
    const auto ends = uses[begin].ends;
    const std::uint32_t first = uses[begin].cell;
    std::uint32_t cell = first, previous = no_index;
    Matching around;
    bool closed = false;
    for (std::size_t step = 0; step <= end - begin; ++step) {
      std::uint32_t next = no_index;
      bool leaves = false;
      for (std::size_t k = 0; k < 4 && !leaves; ++k) {
        const std::uint32_t facing = cells.vertices[cell][k];
        if (facing == ends[0] || facing == ends[1]) continue;
        const std::uint32_t other = cells.neighbour[cell][k];
        if (other != no_index && other == previous) continue;
        next = other;
        leaves = true;
      }
      if (next == no_index) break;  // an edge of the boundary
      around = then(around, match(frames[cell], frames[next]));
      previous = cell;
      cell = next;
      if (cell == first) {
        closed = true;
        break;
      }
    }
    if (closed && !(around == Matching{})) singular.push_back(ends);
    begin = end;
  }

  std::map<std::uint32_t, std::vector<std::uint32_t>> at;  // point → singular edges, ordered
  for (std::uint32_t e = 0; e < singular.size(); ++e)
    for (const std::uint32_t p : singular[e]) at[p].push_back(e);
  std::vector<std::uint8_t> used(singular.size(), 0);
  std::vector<Polyline> curves;
  const auto walk = [&](std::uint32_t from, std::uint32_t edge) {
    Polyline curve;
    curve.name = "singular_" + std::to_string(curves.size());
    curve.points.push_back(mesh.points[from]);
    std::uint32_t p = from;
    while (!used[edge]) {
      used[edge] = 1;
      p = singular[edge][0] == p ? singular[edge][1] : singular[edge][0];
      if (p == from) {
        curve.is_closed = true;
        break;
      }
      curve.points.push_back(mesh.points[p]);
      const auto& here = at[p];
      if (here.size() != 2) break;
      edge = here[0] == edge ? here[1] : here[0];
    }
    curves.push_back(std::move(curve));
  };
  for (const auto& [p, edges] : at)
    if (edges.size() != 2)
      for (const std::uint32_t e : edges)
        if (!used[e]) walk(p, e);
  for (std::uint32_t e = 0; e < singular.size(); ++e)
    if (!used[e]) walk(singular[e][0], e);
  return curves;
}

/// Per cell the directions its frame must have: normals of its boundary faces. At a sharp edge of the boundary a cell
/// that sees both faces is needed, or the frames cut the corner (S33): where none has both, all around the edge take both.
std::vector<std::vector<Vec3>> boundary_directions(const VolumeMesh& mesh, const Cells& cells) {
  std::vector<std::vector<Vec3>> normals(cells.vertices.size());
  const auto add = [](std::vector<Vec3>& to, const Vec3& n) {
    const bool parallel = std::any_of(to.begin(), to.end(), [&](const Vec3& m) { return std::abs(dot(m, n)) > 0.996; });
    const bool flat = to.size() == 2 && std::abs(dot(cross(to[0], to[1]), n)) < 0.05;
    if (to.size() < 3 && !parallel && !flat) to.push_back(n);
  };
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  struct Side {
    Edge edge;
    std::uint32_t cell;
    Vec3 normal;
  };
  std::vector<Side> sides;
  for (std::uint32_t c = 0; c < cells.vertices.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      if (cells.neighbour[c][k] != no_index) continue;
      std::array<std::uint32_t, 3> at{};
      for (std::size_t i = 0; i < 3; ++i) at[i] = cells.vertices[c][face_corners[k][i]];
      const Vec3& a = mesh.points[at[0]];
      const Vec3 n = unit(cross(mesh.points[at[1]] - a, mesh.points[at[2]] - a));
      add(normals[c], n);
      for (std::size_t i = 0; i < 3; ++i) sides.push_back({std::minmax(at[i], at[(i + 1) % 3]), c, n});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& x, const Side& y) { return x.edge != y.edge ? x.edge < y.edge : x.cell < y.cell; });
  constexpr double sharp = 0.866;  // normals 30° apart
  std::vector<Side> corners;       // edges of two faces, of the first of them, in turn
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i - 1].edge == sides[i].edge && sides[i - 1].cell != sides[i].cell &&
        dot(sides[i - 1].normal, sides[i].normal) < sharp)
      corners.insert(corners.end(), {sides[i - 1], sides[i]});
  for (std::uint32_t c = 0; c < cells.vertices.size() && !corners.empty(); ++c)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Edge edge = std::minmax(cells.vertices[c][i], cells.vertices[c][j]);
        auto at = std::lower_bound(corners.begin(), corners.end(), edge,
                                   [](const Side& s, const Edge& e) { return s.edge < e; });
        for (; at != corners.end() && at->edge == edge; ++at) add(normals[c], at->normal);
      }
  return normals;
}

}  // namespace

Result<VolumeFrames> compute_volume_frames(const VolumeMesh& mesh, const VolumeFrameOptions& options,
                                           const std::vector<VolumeFrame>& start) {
  const Result<Cells> connected = connect(mesh);
  if (!connected) return connected.failure();
  const Cells& cells = *connected;
  const std::size_t count = cells.vertices.size();
  if (!start.empty() && start.size() != count)
    return Failure{FailureCode::invalid_input, "the start has other cells than the mesh", "give one frame per cell"};

  // Boundary normals first, then crosses from cell to cell.
  std::vector<VolumeFrame> frames(count);
  std::vector<std::uint8_t> known(count, 0);
  std::vector<std::uint32_t> queue;
  VolumeDiffusion diffusion{cells, options, std::vector<std::uint8_t>(3 * count, 0), {}};
  const std::vector<std::vector<Vec3>> fixed_to = boundary_directions(mesh, cells);
  for (std::uint32_t c = 0; c < count; ++c) {
    const std::vector<Vec3>& normals = fixed_to[c];
    if (normals.empty()) continue;
    frames[c] = cross_from(normals);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      frames[c][i] = normals[i];
      diffusion.fixed[3 * c + i] = 1;
    }
    known[c] = 1;
    queue.push_back(c);
  }
  if (queue.empty()) {
    frames[0] = cross_from({});
    known[0] = 1;
    queue.push_back(0);
  }
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const std::uint32_t other : cells.neighbour[queue[next]])
      if (other != no_index && !known[other]) {
        known[other] = 1;
        frames[other] = cross_from({frames[queue[next]][0], frames[queue[next]][1]});
        queue.push_back(other);
      }
  if (!start.empty())
    for (std::size_t c = 0; c < count; ++c)
      for (std::size_t i = 0; i < 3; ++i)
        if (!diffusion.fixed[3 * c + i] && length(start[c][i]) > 0) frames[c][i] = unit(start[c][i]);

  std::vector<double> x(9 * count), gradient(9 * count);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis) x[9 * c + 3 * i + static_cast<std::size_t>(axis)] = frames[c][i][axis];
  const Objective objective = [&](const std::vector<double>& at, std::vector<double>& slope) {
    return diffusion(at, slope);
  };
  VolumeFrames result;
  while (result.iterations < options.iterations) {
    if (options.is_cancelled && options.is_cancelled()) break;
    diffusion.before = x;
    std::vector<double> w = x;
    minimize(w, objective,
             {.iterations = static_cast<std::size_t>(options.inner), .is_cancelled = options.is_cancelled});
    double change = 0;
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const Vec3 u = VolumeDiffusion::direction(w, i);
      const double size = length(u);
      if (diffusion.fixed[i] || !(size > 1e-12)) continue;
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
        change += (w[k] / size - x[k]) * (w[k] / size - x[k]);
        x[k] = w[k] / size;
      }
    }
    ++result.iterations;
    if (std::sqrt(change) <= options.settled_ratio * std::sqrt(static_cast<double>(count))) break;
  }
  result.energy = diffusion.smoothness(diffusion.coefficients(x));
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t i = 0; i < 3; ++i) frames[c][i] = VolumeDiffusion::direction(x, 3 * c + i);
    if (determinant(frames[c]) < 0) frames[c][2] = -1 * frames[c][2];
    result.smallest_determinant = std::min(result.smallest_determinant, determinant(frames[c]));
  }
  result.singular = singular_curves(mesh, cells, frames);
  result.frames = std::move(frames);
  return result;
}

}  // namespace strataflow
