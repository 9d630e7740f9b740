#include "kernels/voronoi/site_neighbours.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {
constexpr double movement_allowed = 0.15;    // of the spacing, before lists are made anew
constexpr std::size_t leaf_size = 10;

struct PointCloud {
  const std::vector<Vec3>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

bool nearer(const NearSite& a, const NearSite& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.site < b.site;
}
}  // namespace

struct SiteNeighbours::Tree {
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud, 3, std::uint32_t>;
  std::vector<Vec3> points;  ///< the sites when the lists were made
  PointCloud cloud;
  Index index;
  explicit Tree(const std::vector<Vec3>& sites)
      : points(sites), cloud{points}, index(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size)) {}
};

SiteNeighbours::SiteNeighbours(std::size_t list_width) : list_width_(list_width) {}
SiteNeighbours::~SiteNeighbours() = default;
SiteNeighbours::SiteNeighbours(SiteNeighbours&&) noexcept = default;
SiteNeighbours& SiteNeighbours::operator=(SiteNeighbours&&) noexcept = default;

void SiteNeighbours::move_to(const std::vector<Vec3>& sites) {
  const bool is_same_set = tree_ && sites.size() == tree_->points.size();
  sites_ = sites;
  if (is_same_set) {
    double farthest = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) farthest = std::max(farthest, length(sites[i] - tree_->points[i]));
    slack_ = 2 * farthest * (1 + 1e-12);
    if (farthest <= movement_allowed * spacing_) return;
  }
  make_lists();
}

void SiteNeighbours::make_lists() {
  slack_ = 0;
  tree_ = std::make_unique<Tree>(sites_);
  const std::size_t count = sites_.size();
  width_ = std::min(list_width_, count - 1);
  lists_.resize(count * width_);
  if (width_ == 0) return;
  parallel_ranges(count, 256, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> ids(width_ + 1);
    std::vector<double> squares(width_ + 1);
    std::vector<NearSite> found;
    for (std::size_t i = begin; i < end; ++i) {
      const double query[3]{sites_[i].x, sites_[i].y, sites_[i].z};
      const std::size_t some = tree_->index.knnSearch(query, width_ + 1, ids.data(), squares.data());
      found.clear();
      for (std::size_t j = 0; j < some; ++j)
        if (ids[j] != i) found.push_back({ids[j], std::sqrt(squares[j])});
      // Among many sites at one place the search may not return the site itself: then one too many is found.
      std::sort(found.begin(), found.end(), nearer);
      std::copy_n(found.begin(), width_, lists_.begin() + static_cast<std::ptrdiff_t>(i * width_));
    }
  });
  spacing_ = ordered_reduce(count, 0.0, [&](std::size_t i) { return lists_[i * width_].distance; },
                            [](double a, double b) { return a + b; }) /
             static_cast<double>(count);
}

void SiteNeighbours::find_within(std::uint32_t site, double radius, std::vector<NearSite>& found) const {
  found.clear();
  const Vec3& at = tree_->points[site];
  const double query[3]{at.x, at.y, at.z};
  const double reach = (radius + slack_) * (1 + 1e-9);
  std::vector<std::pair<std::uint32_t, double>> matches;
  nanoflann::SearchParams in_any_order;
  in_any_order.sorted = false;
  tree_->index.radiusSearch(query, reach * reach, matches, in_any_order);
  for (const auto& [id, square] : matches)
    if (id != site) found.push_back({id, std::sqrt(square)});
  std::sort(found.begin(), found.end(), nearer);
}

std::uint32_t SiteNeighbours::find_nearest_listed(const Vec3& x) const {
  const double query[3]{x.x, x.y, x.z};
  std::uint32_t nearest = 0;
  double square = 0;
  tree_->index.knnSearch(query, 1, &nearest, &square);
  return nearest;
}

}  // namespace strataflow
