#include "kernels/hexes/upright_system.h"

#include <algorithm>

#include "graph/parallel/parallel_map.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {

std::vector<double> UprightSystem::expanded(const std::vector<double>& unknowns) const {
  std::vector<double> values(first.size() - 1, 0);
  for (std::size_t p = 0; p < values.size(); ++p)
    for (std::uint32_t s = first[p]; s < first[p + 1]; ++s) values[p] += shares[s].weight * unknowns[shares[s].unknown];
  return values;
}

UprightSystem substitute(std::size_t point_count, const std::vector<UprightConstraint>& constraints) {
  std::vector<std::uint32_t> constraint_of(point_count, no_index);
  for (std::uint32_t c = 0; c < constraints.size(); ++c) constraint_of[constraints[c].point] = c;
  UprightSystem system;
  // Constraints hang on points that may hang on others. Depth first, masters before those that follow them; a
  // constraint that leads back to itself is dropped.
  enum : char { unseen, open, done };
  std::vector<char> state(point_count, unseen);
  std::vector<std::vector<UprightSystem::Share>> of_point(point_count);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t start = 0; start < point_count; ++start) {
    if (state[start] == unseen) stack.push_back(start);
    while (!stack.empty()) {
      const std::uint32_t p = stack.back();
      if (state[p] == done) {
        stack.pop_back();
        continue;
      }
      bool is_free = constraint_of[p] == no_index;
      if (!is_free) {
        const UprightConstraint& c = constraints[constraint_of[p]];
        bool is_waiting = false;
        for (const std::uint32_t master : {c.org, c.dest}) {
          if (state[master] == open && master != p && state[p] == unseen) is_free = true;
          if (master == p) is_free = true;
          if (state[master] == unseen) is_waiting = true;
        }
        if (is_free) ++system.dropped;
        if (!is_free && is_waiting) {
          state[p] = open;
          for (const std::uint32_t master : {c.org, c.dest})
            if (state[master] == unseen) stack.push_back(master);
          continue;
        }
        if (!is_free) {
          for (const auto& [master, weight] : {std::pair{c.org, c.weight}, std::pair{c.dest, 1 - c.weight}})
            for (const UprightSystem::Share& share : of_point[master]) {
              if (weight == 0) continue;
              auto same = std::find_if(of_point[p].begin(), of_point[p].end(),
                                       [&](const auto& s) { return s.unknown == share.unknown; });
              if (same == of_point[p].end())
                of_point[p].push_back({share.unknown, weight * share.weight});
              else
                same->weight += weight * share.weight;
            }
        }
      }
      if (is_free) {
        of_point[p] = {{system.unknown_count++, 1.0}};
        system.point_of.push_back(p);
      }
      state[p] = done;
      stack.pop_back();
    }
  }
  system.first.assign(1, 0);
  for (const auto& shares : of_point) {
    system.shares.insert(system.shares.end(), shares.begin(), shares.end());
    system.first.push_back(static_cast<std::uint32_t>(system.shares.size()));
  }
  return system;
}

std::vector<TetGradients> tet_gradients(const LabelledTets& tets) {
  return parallel_map(
      tets.tets.size(),
      [&](std::size_t t) {
        const Tet& tet = tets.tets[t];
        TetGradients result;
        const Vec3& a = tets.points[tet[0]];
        const double determinant = dot(tets.points[tet[1]] - a, cross(tets.points[tet[2]] - a, tets.points[tet[3]] - a));
        for (std::size_t k = 0; k < 4; ++k) {
          const auto& [p, q, r] = face_corners[k];
          const Vec3& base = tets.points[tet[p]];
          result.gradient[k] = (-1 / determinant) * cross(tets.points[tet[q]] - base, tets.points[tet[r]] - base);
        }
        result.volume_m3 = determinant / 6;
        return result;
      },
      1024);
}

}  // namespace strataflow
