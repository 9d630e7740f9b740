#include "kernels/quality/hausdorff_distance.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 256;
constexpr std::size_t first_batch = 64;  ///< triangles searched before the largest distance is shared; then twice as many
constexpr std::uint64_t first_limit = 32;  ///< samples in one triangle, at first; what they do not settle gets eightfold

struct Sample {
  Vec3 point;
  double distance_m = 0;
  std::uint32_t nearest = no_index;
};

struct Piece {
  std::array<Sample, 3> corner;
  double bound_m = 0;
  std::uint32_t depth = 0;
};

double bound_of(const std::array<Sample, 3>& corner, const NearestTriangle& other) {
  double farthest = 0, longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    farthest = std::max(farthest, corner[k].distance_m);
    longest = std::max(longest, length(corner[k].point - corner[(k + 1) % 3].point));
  }
  // Any point is within longest / √3 of a corner, and the distance changes no faster than the point moves.
  double bound = farthest + longest / std::numbers::sqrt3;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t nearest = corner[k].nearest;
    if ((k > 0 && nearest == corner[0].nearest) || (k > 1 && nearest == corner[1].nearest)) continue;
    double squared = 0;
    for (const Sample& sample : corner) squared = std::max(squared, other.squared_m2(sample.point, nearest));
    bound = std::min(bound, std::sqrt(squared));
  }
  return std::max(bound, farthest);
}

struct Found {
  double distance_m = 0, bound_m = 0;
  Vec3 at;
  std::uint64_t samples = 0;
};

/// Where to split a piece: between corners `from` and `to`, `share` of the way.
struct Split {
  std::size_t from = 0, to = 1;
  double share = 0.5;
};

Split longest_edge(const Piece& piece) {
  Split split;
  double longest_m = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge_m = length(piece.corner[(k + 1) % 3].point - piece.corner[k].point);
    if (edge_m > longest_m) {
      longest_m = edge_m;
      split = {k, (k + 1) % 3};
    }
  }
  return split;
}

/// Where an edge leaves what lies within `enough_m` of the triangle nearest to one of its ends: halves that each belong
/// to one triangle come about at once where both meshes are flat. Every fourth time the longest edge, so that pieces
/// shrink whatever happens.
Split split_of(const Piece& piece, double enough_m, const NearestTriangle& other) {
  if (piece.depth % 4 == 3) return longest_edge(piece);
  const double enough = enough_m * enough_m;
  Split split;
  double longest_m = 0;
  for (std::size_t from = 0; from < 3; ++from) {
    const Sample& start = piece.corner[from];
    for (std::size_t k = 1; k < 3; ++k) {
      const std::size_t to = (from + k) % 3;
      if (!(other.squared_m2(piece.corner[to].point, start.nearest) > enough)) continue;
      const Vec3 edge = piece.corner[to].point - start.point;
      double low = 0, high = 1;  // convex along the edge, and low enough at its start
      for (int halving = 0; halving < 20; ++halving) {
        const double share = 0.5 * (low + high);
        (other.squared_m2(start.point + share * edge, start.nearest) > enough ? high : low) = share;
      }
      if (low * length(edge) > longest_m) {
        longest_m = low * length(edge);
        split = {from, to, low};
      }
    }
  }
  if (!(longest_m > 0)) return longest_edge(piece);
  return split;
}

/// Searches one triangle for points farther than `beaten_m` by more than `error_m`, where they may lie farthest first:
/// with few samples left the bound is then as low as they can make it.
Found search(const Piece& whole, double beaten_m, double error_m, std::uint64_t most_samples,
             const NearestTriangle& other) {
  Found found{beaten_m, 0, {}, 0};
  const auto is_lower = [](const Piece& a, const Piece& b) { return a.bound_m < b.bound_m; };
  std::vector<Piece> heap{whole};
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), is_lower);
    const Piece piece = heap.back();
    heap.pop_back();
    const Split split = split_of(piece, found.distance_m + 0.5 * error_m, other);
    const Sample &a = piece.corner[split.from], &b = piece.corner[split.to];
    const Vec3 middle = a.point + split.share * (b.point - a.point);
    const bool has_room = middle != a.point && middle != b.point;  // between doubles
    if (piece.bound_m <= found.distance_m + error_m || found.samples >= most_samples || !has_room) {
      found.bound_m = piece.bound_m;  // the others' are no higher
      break;
    }
    const NearestTriangle::Hit hit = other.nearest(middle, a.nearest);
    const Sample sample{middle, std::sqrt(hit.squared_m2), hit.triangle};
    ++found.samples;
    if (sample.distance_m > found.distance_m) {
      found.distance_m = sample.distance_m;
      found.at = middle;
    }
    std::array<Piece, 2> halves{piece, piece};
    halves[0].corner[split.to] = sample;
    halves[1].corner[split.from] = sample;
    for (Piece& half : halves) {
      half.bound_m = std::min(piece.bound_m, bound_of(half.corner, other));
      ++half.depth;
      heap.push_back(half);
      std::push_heap(heap.begin(), heap.end(), is_lower);
    }
  }
  return found;
}

DirectedDistance directed(const TriangleMesh& mesh, const NearestTriangle& other, double error_m,
                          std::uint64_t budget, const std::function<bool()>& is_cancelled) {
  std::vector<char> is_used(mesh.points.size(), 0);  // only vertices of triangles count
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) is_used[v] = 1;
  std::vector<Sample> at_vertex(mesh.points.size());
  parallel_ranges(mesh.points.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t guess = no_index;  // neighbours in the list are often neighbours in space
    for (std::size_t v = begin; v < end; ++v) {
      if (is_used[v] == 0) continue;
      const NearestTriangle::Hit hit = other.nearest(mesh.points[v], guess);
      guess = hit.triangle;
      at_vertex[v] = {mesh.points[v], std::sqrt(hit.squared_m2), hit.triangle};
    }
  });
  DirectedDistance result;
  const auto take = [&](double distance_m, const Vec3& at) {
    if (distance_m <= result.distance_m) return;
    result.distance_m = distance_m;
    result.at = at;
  };
  for (std::size_t v = 0; v < at_vertex.size(); ++v) {
    if (is_used[v] == 0) continue;
    if (result.samples++ == 0) result.at = at_vertex[v].point;
    take(at_vertex[v].distance_m, at_vertex[v].point);
  }

  struct Candidate {
    double bound_m = 0;
    std::uint32_t triangle = 0;
  };
  const auto corners = [&](std::uint32_t t) {
    const auto [i, j, k] = mesh.triangles[t];
    return std::array<Sample, 3>{at_vertex[i], at_vertex[j], at_vertex[k]};
  };
  std::vector<Candidate> candidates = parallel_map(
      mesh.triangles.size(),
      [&](std::size_t t) {
        const auto triangle = static_cast<std::uint32_t>(t);
        return Candidate{bound_of(corners(triangle), other), triangle};
      },
      grain);
  std::uint64_t spent = 0;
  for (std::uint64_t limit = first_limit; !candidates.empty(); limit *= 8) {
    sort_total_order(candidates, [](const Candidate& a, const Candidate& b) {
      return a.bound_m != b.bound_m ? a.bound_m > b.bound_m : a.triangle < b.triangle;
    });
    for (std::size_t begin = 0, batch = first_batch; begin < candidates.size(); begin += batch, batch *= 2) {
      if (spent >= budget || candidates[begin].bound_m <= result.distance_m + error_m) break;
      if (is_cancelled && is_cancelled()) return result;  // who asked throws it away
      // Neighbours one after the other: they look at the same part of the other mesh.
      const std::span now(candidates.data() + begin, std::min(batch, candidates.size() - begin));
      std::sort(now.begin(), now.end(), [](const Candidate& a, const Candidate& b) { return a.triangle < b.triangle; });
      const double beaten_m = result.distance_m;
      const std::uint64_t each = std::min(limit, std::max<std::uint64_t>(1, (budget - spent) / now.size()));
      const std::vector<Found> found = parallel_map(
          now.size(),
          [&](std::size_t i) {
            return search({corners(now[i].triangle), now[i].bound_m}, beaten_m, error_m, each, other);
          },
          16);
      for (std::size_t i = 0; i < now.size(); ++i) {
        spent += found[i].samples;
        now[i].bound_m = found[i].bound_m;
        take(found[i].distance_m, found[i].at);
      }
    }
    if (spent >= budget) break;
    std::erase_if(candidates, [&](const Candidate& settled) {
      if (settled.bound_m > result.distance_m + error_m && limit < (std::uint64_t{1} << 40)) return false;
      result.bound_m = std::max(result.bound_m, settled.bound_m);
      return true;
    });
  }
  result.samples += spent;
  for (const Candidate& open : candidates) result.bound_m = std::max(result.bound_m, open.bound_m);
  result.bound_m = std::max(result.bound_m, result.distance_m);
  return result;
}

std::vector<Triangle> triangles_of(const StructuralModel& model, const std::string& name) {
  std::vector<Triangle> triangles;
  for (const Surface& surface : model.surfaces)
    if (std::any_of(surface.all_entities.begin(), surface.all_entities.end(),
                    [&](std::uint32_t entity) { return model.entities[entity].name == name; }))
      triangles.insert(triangles.end(), model.triangles.begin() + surface.first_triangle,
                       model.triangles.begin() + surface.end_triangle);
  return triangles;
}

}  // namespace

Result<HausdorffDistance> hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second,
                                             const HausdorffOptions& options) {
  if (!(options.error_ratio > 0))
    return Failure{FailureCode::invalid_options, "error_ratio must be > 0", "give a share of the diagonal, like 1e-4"};
  if (first.triangles.empty() || second.triangles.empty())
    return Failure{FailureCode::invalid_input, "a mesh without triangles has no Hausdorff distance",
                   "compare two meshes that both have triangles"};
  Box3 box;
  for (const Triangle& t : first.triangles)
    for (const std::uint32_t v : t) box.take(first.points[v]);
  HausdorffDistance result;
  result.diagonal_m = box.diagonal_m();
  for (const Triangle& t : second.triangles)
    for (const std::uint32_t v : t) box.take(second.points[v]);
  const double error_m = options.error_ratio * box.diagonal_m();
  const std::uint64_t most = options.samples.value_or(std::numeric_limits<std::uint64_t>::max());
  result.forward = directed(first, NearestTriangle(second), error_m, most, options.is_cancelled);
  result.backward = directed(second, NearestTriangle(first), error_m, most, options.is_cancelled);
  if (options.is_cancelled && options.is_cancelled())
    return Failure{FailureCode::cancelled, "comparing was stopped", "run it again"};
  return result;
}

Result<std::vector<EntityDistance>> hausdorff_by_entity(const StructuralModel& first, const StructuralModel& second,
                                                        const HausdorffOptions& options) {
  std::vector<std::string> names;
  for (const StructuralModel* model : {&first, &second})
    for (const Entity& entity : model->entities)
      if (std::find(names.begin(), names.end(), entity.name) == names.end()) names.push_back(entity.name);
  std::vector<EntityDistance> distances;
  for (const std::string& name : names) {
    const std::vector<Triangle> a = triangles_of(first, name), b = triangles_of(second, name);
    if (a.empty() && b.empty()) continue;
    EntityDistance& one = distances.emplace_back();
    one.name = name;
    one.is_missing = a.empty() || b.empty();
    if (one.is_missing) continue;
    Result<HausdorffDistance> distance = hausdorff_distance({first.points, a}, {second.points, b}, options);
    if (!distance) return distance.failure();
    one.distance = *distance;
  }
  return distances;
}

}  // namespace strataflow
