#pragma once
#include <cstdint>
#include <vector>

#include "kernels/remeshing/guarded/guarded_mesh.h"

namespace strataflow {

/// Steps over the whole of a GuardedMesh or of a part of one. All are serial, in orders that end in an index, and
/// return how many single steps were done. With `since` they look only where GuardedMesh::changed_at says something
/// changed from that step on.

/// Splits edges longer than 4/3 of their size, the longest first, until none is left or all are refused.
std::uint64_t split_long_edges(GuardedMesh& mesh, std::uint32_t since = 0);
/// Collapses edges shorter than 3/4 of their size, the shortest first.
std::uint64_t collapse_short_edges(GuardedMesh& mesh, std::uint32_t since = 0);
/// Flips edges where that makes the smaller of the smallest angles larger (Delaunay, on a plane).
std::uint64_t flip_edges(GuardedMesh& mesh, std::uint32_t since = 0);
/// Flips edges where that brings the numbers of triangles at the four vertices nearer to six, or three on a line.
std::uint64_t even_valences(GuardedMesh& mesh, std::uint32_t since = 0);
/// Moves vertices to where the mean shape of their triangles is better, one step each, if what they lack of the best
/// falls by more than this share.
std::uint64_t even_out(GuardedMesh& mesh, std::uint32_t since = 0, double least_gain = 1e-3);
/// Moves surface vertices by up to `share` of their size, each in a direction of its own that depends on its number
/// alone. A regular grid of right-angled triangles is a place of rest for every other step here, but not a good mesh.
std::uint64_t shake(GuardedMesh& mesh, double share);
/// Flips edges, and collapses or splits those of poor triangles, where that raises the mean shape of all triangles.
std::uint64_t raise_mean_shape(GuardedMesh& mesh, std::uint32_t since = 0);
/// Tries flips, collapses, moves and splits at each triangle with an angle below 30°, the worst first, and keeps what
/// makes the sum of shortfalls smaller.
std::uint64_t mend_bad_triangles(GuardedMesh& mesh, std::uint32_t since = 0);

}  // namespace strataflow
