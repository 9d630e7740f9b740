#include "kernels/topology/building/build_surfaces.h"

#include "base/id.h"

namespace strataflow {

namespace {
bool runs_upward(const std::vector<Triangle>& triangles, std::uint32_t h) {
  return triangles[h / 3][h % 3] < triangles[h / 3][(h % 3 + 1) % 3];
}
}  // namespace

SurfacePartition build_surfaces(const EdgeTable& edges, const std::vector<Triangle>& triangles,
                                const std::vector<std::uint32_t>& triangle_label) {
  SurfacePartition out;
  out.is_feature.resize(edges.edge_count());
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) out.is_feature[e] = is_feature_edge(edges, e, triangle_label);
  out.surface_of.assign(triangles.size(), no_index);
  out.is_flipped.assign(triangles.size(), 0);
  std::vector<std::uint32_t> members;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (out.surface_of[seed] != no_index) continue;
    const std::uint32_t surface = out.surface_count++;
    bool coherent = true;
    std::size_t flipped = 0;
    members.assign(1, seed);
    out.surface_of[seed] = surface;
    for (std::size_t next = 0; next < members.size(); ++next) {
      const std::uint32_t t = members[next];
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t h = 3 * t + k, e = edges.edge_of[h];
        if (out.is_feature[e]) continue;
        const auto around = edges.around(e);
        const std::uint32_t other = around[0] == h ? around[1] : around[0], u = other / 3;
        // Coherent neighbours run along their shared edge in opposite directions.
        const char wanted =
            static_cast<char>(out.is_flipped[t] ^ (runs_upward(triangles, h) == runs_upward(triangles, other)));
        if (out.surface_of[u] == no_index) {
          out.surface_of[u] = surface;
          out.is_flipped[u] = wanted;
          flipped += static_cast<std::size_t>(wanted);
          members.push_back(u);
        } else if (out.is_flipped[u] != wanted) {
          coherent = false;
        }
      }
    }
    if (!coherent) out.non_orientable.push_back(surface);
    if (2 * flipped > members.size())
      for (const std::uint32_t t : members) out.is_flipped[t] ^= 1;
  }
  return out;
}

}  // namespace strataflow
