#include "kernels/hybrid/facing_triangles.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "kernels/hybrid/thin_cell.h"

namespace strataflow {

namespace {

/// A side of a triangle, seen from the region it looks at.
struct Side {
  std::uint32_t region = 0;
  Triangle sites{};  ///< ascending
  std::uint32_t triangle = 0;
  bool is_positive = false;
  friend auto operator<=>(const Side&, const Side&) = default;
};

/// The corners, turned so that the normal points to the side.
Triangle towards(const StructuralModel& model, const Side& side) {
  Triangle corners = model.triangles[side.triangle];
  if (!side.is_positive) std::swap(corners[1], corners[2]);
  return corners;
}

struct Match {
  double squared_height_m2 = std::numeric_limits<double>::infinity();
  std::uint32_t first = 0, second = 0;  ///< sides
  FacingPair pair;
};

enum class Fit : std::uint8_t { good, flat, inverted, turned };

/// The best way to put the corners of two sides face to face.
Fit best_match(const StructuralModel& model, const std::vector<std::uint32_t>& point_site, const Side& low,
               const Side& high, Match& match) {
  const Triangle bottom = towards(model, low), seen = towards(model, high);
  const Triangle opposite{seen[0], seen[2], seen[1]};
  Fit fit = Fit::turned;
  for (std::size_t turn = 0; turn < 3; ++turn) {
    const Triangle top{opposite[turn], opposite[(turn + 1) % 3], opposite[(turn + 2) % 3]};
    double squared = 0;
    bool fits = true;
    for (std::size_t k = 0; k < 3; ++k) {
      fits = fits && point_site[bottom[k]] == point_site[top[k]];
      const Vec3 link = model.points[top[k]] - model.points[bottom[k]];
      squared += dot(link, link);
    }
    if (!fits || top == bottom) continue;
    const ThinCellState state = state_of(cell_between(bottom, top), model.points);
    const Fit found = state == ThinCellState::sound  ? Fit::good
                      : state == ThinCellState::flat ? Fit::flat
                                                     : Fit::inverted;
    fit = std::min(fit, found);
    if (found != Fit::good) continue;
    if (squared < match.squared_height_m2) {
      match.squared_height_m2 = squared;
      match.pair = {low.region, bottom, top, {low.triangle, high.triangle}};
    }
  }
  return fit;
}

}  // namespace

std::vector<FacingPair> find_facing_triangles(const StructuralModel& model,
                                              const std::vector<std::uint32_t>& point_site, FacingCounts& counts) {
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
    Triangle sites;
    for (std::size_t k = 0; k < 3; ++k) sites[k] = point_site[model.triangles[t][k]];
    std::sort(sites.begin(), sites.end());
    if (sites[2] == no_index) continue;
    const Surface& surface = model.surfaces[model.triangle_surface[t]];
    if (surface.region_minus != universe) sides.push_back({surface.region_minus, sites, t, false});
    if (surface.region_plus != universe) sides.push_back({surface.region_plus, sites, t, true});
  }
  std::sort(sides.begin(), sides.end());
  constexpr std::size_t most_alike = 16;  // sheets in one cell; more are no layers
  std::vector<FacingPair> pairs;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].region == sides[begin].region && sides[end].sites == sides[begin].sites)
      ++end;
    if (end - begin < 2 || end - begin > most_alike) continue;
    std::vector<Match> matches;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = i + 1; j < end; ++j) {
        if (sides[i].triangle == sides[j].triangle) continue;
        Match match;
        match.first = static_cast<std::uint32_t>(i - begin);
        match.second = static_cast<std::uint32_t>(j - begin);
        const Fit fit = best_match(model, point_site, sides[i], sides[j], match);
        if (fit == Fit::good) matches.push_back(match);
        if (fit == Fit::turned) ++counts.turned;
        if (fit == Fit::inverted) ++counts.inverted;
        if (fit == Fit::flat) ++counts.flat;
      }
    std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
      return std::tie(a.squared_height_m2, a.first, a.second) < std::tie(b.squared_height_m2, b.first, b.second);
    });
    std::uint32_t taken = 0;
    for (const Match& match : matches) {
      const std::uint32_t both = 1u << match.first | 1u << match.second;
      if ((taken & both) != 0) continue;
      taken |= both;
      pairs.push_back(match.pair);
      ++counts.pairs;
    }
    if (!matches.empty())
      for (std::size_t i = begin; i < end; ++i) counts.unequal += (taken >> (i - begin) & 1) == 0;
  }
  std::sort(pairs.begin(), pairs.end(), [](const FacingPair& a, const FacingPair& b) {
    return std::tie(a.region, a.triangles) < std::tie(b.region, b.triangles);
  });
  return pairs;
}

}  // namespace strataflow
