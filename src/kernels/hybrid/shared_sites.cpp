#include "kernels/hybrid/shared_sites.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/quality/nearest_triangle.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/voronoi/sample_sites.h"

namespace strataflow {

namespace {

/// Sheets that face each other turn at most this far: cos 45°.
constexpr double least_cosine = 0.7;

/// Where the line through a sample pierces a triangle.
struct Sheet {
  double at_m = 0;  ///< along the line
  std::uint32_t triangle = 0;
  bool is_along = false;  ///< the line leaves through its positive side
  friend auto operator<=>(const Sheet&, const Sheet&) = default;
};

/// What a sample came to.
struct Drawn {
  Vec3 site;
  bool is_kept = false, is_on_box = true;
  std::vector<std::uint32_t> stack;
};

class StackFinder {
 public:
  StackFinder(const StructuralModel& model, const SharedSitesOptions& options)
      : model_(model), options_(options), nearest_({model.points, model.triangles}) {
    std::vector<FloatBox> boxes;
    for (const Triangle& t : model.triangles) {
      Box3 box;
      for (const std::uint32_t v : t) box.take(model.points[v]);
      boxes.push_back(enclosing(box));
    }
    tree_ = BoundingVolumeTree(boxes);
  }

  Drawn draw(const Vec3& sample) const {
    Drawn drawn;
    const std::uint32_t own = nearest_.nearest(sample).triangle;
    if (own == no_index) return drawn;
    const double reach = options_.thin_ratio * options_.surface_edge_length_m[model_.triangle_surface[own]];
    // Farther than the stack may be thick, so that every sheet of a stack sees who else is near.
    const std::vector<Sheet> sheets = sheets_along(sample, own, 3 * reach);
    const auto [first, last] = stack_around(sheets, own, reach);
    // The sheet that stands for the stack: of the lowest surface; of one surface, the one farther along a direction
    // that no model is drawn along.
    const Vec3 direction{0.36, 0.48, 0.8};
    const Vec3 normal = normal_of(own);
    const auto rank = [&](const Sheet& sheet) {
      return std::tuple(model_.triangle_surface[sheet.triangle], sheet.at_m * dot(normal, direction));
    };
    Vec3 sum;
    std::size_t lowest = first;
    for (std::size_t i = first; i <= last; ++i) {
      if (rank(sheets[i]) < rank(sheets[lowest])) lowest = i;
      sum = sum + (sample + sheets[i].at_m * normal);
      if (last > first) drawn.stack.push_back(model_.triangle_surface[sheets[i].triangle]);
      drawn.is_on_box = drawn.is_on_box && is_box(sheets[i].triangle);
    }
    drawn.is_kept = sheets[lowest].triangle == own;
    drawn.stack = sorted_unique(std::move(drawn.stack));
    drawn.site = (1.0 / static_cast<double>(last - first + 1)) * sum;
    return drawn;
  }

 private:
  const Vec3& corner(std::uint32_t triangle, std::size_t k) const {
    return model_.points[model_.triangles[triangle][k]];
  }
  Vec3 normal_of(std::uint32_t triangle) const {
    const Vec3 n = cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
    const double size = length(n);
    return size > 0 ? (1 / size) * n : Vec3{};
  }
  bool is_box(std::uint32_t triangle) const {
    return model_.entities[model_.surfaces[model_.triangle_surface[triangle]].entity].role == Role::boundary;
  }

  /// The sheets within reach on the line through a sample on `own`, in order along its normal.
  std::vector<Sheet> sheets_along(const Vec3& sample, std::uint32_t own, double reach) const {
    const Vec3 normal = normal_of(own);
    std::vector<Sheet> sheets{{0, own, true}};
    if (!(reach > 0)) return sheets;
    Box3 box;
    box.take(sample - reach * normal);
    box.take(sample + reach * normal);
    tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
      if (t == own) return;
      const Vec3 a = corner(t, 0), ab = corner(t, 1) - a, ac = corner(t, 2) - a;
      const Vec3 n = cross(ab, ac);
      const double along = dot(n, normal), size = length(n);
      if (!(std::abs(along) > least_cosine * size)) return;
      const double at = dot(n, a - sample) / along;
      if (!(std::abs(at) <= reach)) return;
      const Vec3 from_a = sample + at * normal - a;
      const double u = dot(cross(from_a, ac), n) / (size * size), v = dot(cross(ab, from_a), n) / (size * size);
      if (u >= 0 && v >= 0 && u + v <= 1) sheets.push_back({at, t, along > 0});
    });
    std::sort(sheets.begin(), sheets.end());
    return sheets;
  }

  /// Whether one region lies between two sheets that follow one another.
  bool face_each_other(const Sheet& low, const Sheet& high) const {
    const auto& below = model_.surfaces[model_.triangle_surface[low.triangle]];
    const auto& above = model_.surfaces[model_.triangle_surface[high.triangle]];
    const std::uint32_t region = low.is_along ? below.region_plus : below.region_minus;
    return region != universe && region == (high.is_along ? above.region_minus : above.region_plus);
  }

  /// Merges sheets that follow one another, the nearest first, into stacks no thicker than `reach`. First and last of
  /// the stack that holds `own`.
  std::array<std::size_t, 2> stack_around(const std::vector<Sheet>& sheets, std::uint32_t own, double reach) const {
    struct Gap {
      double width_m;
      std::size_t below;
    };
    std::vector<Gap> gaps;
    for (std::size_t i = 0; i + 1 < sheets.size(); ++i)
      if (face_each_other(sheets[i], sheets[i + 1])) gaps.push_back({sheets[i + 1].at_m - sheets[i].at_m, i});
    std::sort(gaps.begin(), gaps.end(),
              [](const Gap& a, const Gap& b) { return std::tie(a.width_m, a.below) < std::tie(b.width_m, b.below); });
    std::vector<std::array<std::size_t, 2>> stack(sheets.size());
    for (std::size_t i = 0; i < sheets.size(); ++i) stack[i] = {i, i};
    for (const Gap& gap : gaps) {
      const std::size_t first = stack[gap.below][0], last = stack[gap.below + 1][1];
      if (sheets[last].at_m - sheets[first].at_m > reach) continue;
      for (std::size_t i = first; i <= last; ++i) stack[i] = {first, last};
    }
    std::size_t place = 0;
    while (sheets[place].triangle != own) ++place;
    return stack[place];
  }

  const StructuralModel& model_;
  const SharedSitesOptions& options_;
  NearestTriangle nearest_;
  BoundingVolumeTree tree_;
};

}  // namespace

SharedSites draw_shared_sites(const StructuralModel& model, std::size_t count, const SharedSitesOptions& options) {
  const std::vector<Vec3> samples = sample_sites(model.points, model.triangles, options.crowding, count, options.seed);
  const StackFinder finder(model, options);
  std::vector<Drawn> drawn = parallel_map(
      samples.size(), [&](std::size_t i) { return finder.draw(samples[i]); }, 64);
  SharedSites shared;
  for (Drawn& one : drawn) {
    if (!one.is_kept) continue;
    shared.sites.push_back(one.site);
    shared.is_on_box.push_back(one.is_on_box);
    shared.across_layers += !one.stack.empty();
    shared.stacks.push_back(std::move(one.stack));
  }
  return shared;
}

}  // namespace strataflow
