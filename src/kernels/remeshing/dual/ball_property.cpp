#include "kernels/remeshing/dual/ball_property.h"

#include <algorithm>
#include <array>

#include "graph/parallel/sort_total_order.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

class BallChecking {
 public:
  BallChecking(const StructuralModel& model, const RestrictedDiagram& diagram, const CellComponents& components)
      : model_(model), diagram_(diagram), components_(components) {}

  std::vector<BallFailure> run() {
    check_components();
    check_borders();
    check_corners();
    check_lines();
    std::sort(failures_.begin(), failures_.end());
    failures_.erase(std::unique(failures_.begin(), failures_.end()), failures_.end());
    return std::move(failures_);
  }

 private:
  void fail(std::uint32_t site, std::uint32_t surface, BallCheck check) { failures_.push_back({site, surface, check}); }

  void check_components() {
    std::vector<std::uint32_t> surfaces;
    for (std::uint32_t site = 0; site + 1 < components_.site_surfaces.size(); ++site) {
      const std::uint32_t begin = components_.site_surfaces[site], end = components_.site_surfaces[site + 1];
      surfaces.clear();
      for (std::uint32_t c = begin; c < end; ++c) {
        surfaces.push_back(components_.surfaces[c].surface);
        if (components_.surfaces[c].euler != 1) fail(site, surfaces.back(), BallCheck::not_a_disc);
      }
      check_sheets(site, begin, end);
      std::sort(surfaces.begin(), surfaces.end());
      for (std::size_t k = 1; k < surfaces.size(); ++k)
        if (surfaces[k] == surfaces[k - 1]) fail(site, surfaces[k], BallCheck::several_components);
    }
  }

  void check_sheets(std::uint32_t site, std::uint32_t begin, std::uint32_t end) {
    if (end < begin + 2) return;
    const std::uint32_t first_line = components_.site_lines[site];
    const std::uint32_t line_count = components_.site_lines[site + 1] - first_line;
    UnionFind sets(line_count + end - begin);
    for (std::uint32_t c = begin; c < end; ++c)
      for (const std::uint32_t line : components_.touched_by(c)) sets.unite(line - first_line, line_count + c - begin);
    for (std::uint32_t c = begin + 1; c < end; ++c)
      if (sets.find(line_count + c - begin) != sets.find(line_count)) {
        fail(site, components_.surfaces[c].surface, BallCheck::several_sheets);
        return;
      }
  }

  /// One chain, seen from one of its cells.
  struct Chain {
    std::uint32_t surface, site, other, slot, ends_on_lines;
  };

  void check_borders() {
    std::vector<Chain> chains;
    std::vector<std::array<std::uint32_t, 2>> arcs;  // site, surface
    for (std::uint32_t l = 0; l < components_.loop_component.size(); ++l) {
      const std::uint32_t c = components_.loop_component[l];
      const SurfaceComponent& where = components_.surfaces[c];
      if (l > 0 && components_.loop_component[l - 1] == c) fail(where.site, where.surface, BallCheck::several_borders);
      walk(where, components_.loop(l), chains, arcs);
    }
    std::sort(arcs.begin(), arcs.end());
    for (std::size_t k = 1; k < arcs.size(); ++k)
      if (arcs[k] == arcs[k - 1]) fail(arcs[k][0], arcs[k][1], BallCheck::several_arcs);
    sort_total_order(chains, [](const Chain& a, const Chain& b) {
      return std::array{a.surface, a.site, a.other, a.slot} < std::array{b.surface, b.site, b.other, b.slot};
    });
    for (std::size_t begin = 0, end; begin < chains.size(); begin = end) {
      std::uint32_t ends_on_lines = 0;
      for (end = begin; end < chains.size() && chains[end].surface == chains[begin].surface &&
                        chains[end].site == chains[begin].site && chains[end].other == chains[begin].other;
           ++end)
        ends_on_lines += chains[end].ends_on_lines;
      if (end - begin > 1) fail(chains[begin].site, chains[begin].surface, BallCheck::several_chains);
      if (ends_on_lines > 1) fail(chains[begin].site, chains[begin].surface, BallCheck::several_border_points);
    }
  }

  void walk(const SurfaceComponent& where, std::span<const std::uint32_t> loop, std::vector<Chain>& chains,
            std::vector<std::array<std::uint32_t, 2>>& arcs) {
    const std::size_t size = loop.size();
    const auto is_line = [&](std::size_t k) { return components_.is_on_line(loop[k % size]); };
    const auto other = [&](std::size_t k) { return diagram_.edges[loop[k % size]].site(); };
    const auto starts = [&](std::size_t k) {  // a chain or an arc
      const std::size_t before = k + size - 1;
      if (is_line(k) || is_line(before)) return is_line(k) != is_line(before);
      const std::uint32_t slot = loop[before % size];
      return next_in_piece(diagram_, components_.slot_piece[slot], slot) == loop[k % size];
    };
    bool starts_anywhere = false;
    for (std::size_t k = 0; k < size; ++k) {
      if (!starts(k)) continue;
      starts_anywhere = true;
      if (is_line(k)) {
        arcs.push_back({where.site, where.surface});
        continue;
      }
      std::size_t end = k + 1;
      while (!starts(end)) ++end;
      chains.push_back(
          {where.surface, where.site, other(k), loop[k], (is_line(k + size - 1) ? 1u : 0u) + (is_line(end) ? 1u : 0u)});
    }
    if (!starts_anywhere)
      fail(where.site, where.surface, is_line(0) ? BallCheck::closed_line : BallCheck::closed_chain);
  }

  void check_corners() {
    std::vector<std::array<std::uint32_t, 5>> corners;  // surface, three sites, slot
    for (std::uint32_t piece = 0; piece < diagram_.piece_count(); ++piece) {
      const std::uint32_t site = diagram_.piece_site[piece];
      for (std::uint32_t slot = diagram_.piece_begin[piece]; slot < diagram_.piece_begin[piece + 1]; ++slot) {
        const PieceEdge after = diagram_.edges[slot], before = diagram_.edges[previous_in_piece(diagram_, piece, slot)];
        if (after.is_triangle_edge() || before.is_triangle_edge() || after.site() < site || before.site() < site)
          continue;
        corners.push_back({components_.surfaces[components_.piece_component[piece]].surface, site,
                           std::min(after.site(), before.site()), std::max(after.site(), before.site()), slot});
      }
    }
    sort_total_order(corners, [](const auto& a, const auto& b) { return a < b; });
    for (std::size_t k = 1; k < corners.size(); ++k)
      if (std::equal(corners[k].begin(), corners[k].begin() + 4, corners[k - 1].begin()))
        for (std::size_t i = 1; i < 4; ++i) fail(corners[k][i], corners[k][0], BallCheck::repeated_corner);
  }

  void check_lines() {
    for (std::uint32_t l = 0; l < components_.lines.size(); ++l)
      if (components_.corners_of(l).size() > 1)
        fail(components_.lines[l].site, model_.lines[components_.lines[l].line].surfaces[0],
             BallCheck::several_corners);
  }

  const StructuralModel& model_;
  const RestrictedDiagram& diagram_;
  const CellComponents& components_;
  std::vector<BallFailure> failures_;
};

}  // namespace

std::string_view to_string(BallCheck check) {
  switch (check) {
    case BallCheck::several_components:
      return "several_components";
    case BallCheck::not_a_disc:
      return "not_a_disc";
    case BallCheck::several_borders:
      return "several_borders";
    case BallCheck::several_chains:
      return "several_chains";
    case BallCheck::closed_chain:
      return "closed_chain";
    case BallCheck::repeated_corner:
      return "repeated_corner";
    case BallCheck::several_arcs:
      return "several_arcs";
    case BallCheck::closed_line:
      return "closed_line";
    case BallCheck::several_border_points:
      return "several_border_points";
    case BallCheck::several_corners:
      return "several_corners";
    case BallCheck::several_sheets:
      return "several_sheets";
  }
  return "unknown";
}

std::vector<BallFailure> check_ball_property(const StructuralModel& model, const RestrictedDiagram& diagram,
                                             const CellComponents& components) {
  return BallChecking(model, diagram, components).run();
}

}  // namespace strataflow
