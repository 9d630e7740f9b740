#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// One site near another, with their distance when the lists were made.
struct NearSite {
  std::uint32_t site = 0;
  double distance = 0;
};

/// For each site the other sites by distance, for moving sites: lists are made anew only once sites have moved far, and
/// say until then how much of a distance can be trusted (the neighbour lists of Verlet 1967). Whoever needs sites
/// beyond a list's end asks for all within a radius.
class SiteNeighbours {
 public:
  /// `list_width`: how many others each list holds; two rings of neighbours make most searches end inside it.
  explicit SiteNeighbours(std::size_t list_width = on_surfaces);
  static constexpr std::size_t on_surfaces = 24, in_volumes = 64;
  ~SiteNeighbours();
  SiteNeighbours(SiteNeighbours&&) noexcept;
  SiteNeighbours& operator=(SiteNeighbours&&) noexcept;

  /// Takes over the sites' positions; at least one.
  void move_to(const std::vector<Vec3>& sites);

  const std::vector<Vec3>& sites() const { return sites_; }

  /// The nearest other sites when the list was made, ascending by (distance, id). Two sites' distance is now at least
  /// `NearSite::distance − slack()`.
  std::span<const NearSite> near(std::uint32_t site) const {
    return {lists_.data() + std::size_t{site} * width_, width_};
  }
  double slack() const { return slack_; }

  /// Whether near(site) holds every other site.
  bool lists_hold_all() const { return width_ + 1 == sites_.size(); }

  /// Every other site that may be within `radius` of `site` now, ascending by (distance when listed, id).
  void find_within(std::uint32_t site, double radius, std::vector<NearSite>& found) const;

  /// Some site near x: where a search for the nearest starts.
  std::uint32_t find_nearest_listed(const Vec3& x) const;

 private:
  void make_lists();

  struct Tree;
  std::vector<Vec3> sites_;
  std::unique_ptr<Tree> tree_;
  std::size_t list_width_;
  std::size_t width_ = 0;
  std::vector<NearSite> lists_;
  double slack_ = 0;
  double spacing_ = 0;  ///< mean distance to the nearest other site
};

}  // namespace strataflow
