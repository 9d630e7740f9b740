#pragma once
#include <cstdint>
#include <vector>

#include "kernels/remeshing/guarded/guarded_mesh.h"

namespace strataflow {

/// Steps over the whole of a GuardedMesh. All are serial, in orders that end in an index, and return how many single
/// steps were done. With `since` they look only where GuardedMesh::changed_at says something changed from that step on.

/// Splits edges longer than 4/3 of their size, the longest first, until none is left or all are refused.
std::uint64_t split_long_edges(GuardedMesh& mesh);
/// Collapses edges shorter than 4/5 of their size, the shortest first.
std::uint64_t collapse_short_edges(GuardedMesh& mesh);
/// Flips edges where that makes the smaller of the smallest angles larger (Delaunay, on a plane).
std::uint64_t flip_edges(GuardedMesh& mesh, std::uint32_t since = 0);
/// Flips edges where that brings the numbers of triangles at the four vertices nearer to six, or three on a line.
std::uint64_t even_valences(GuardedMesh& mesh, std::uint32_t since = 0);
/// Moves vertices to where their triangles would be most nearly equilateral, line vertices also to between their
/// neighbours.
std::uint64_t even_out(GuardedMesh& mesh, std::uint32_t since = 0);
/// Moves surface vertices by up to `share` of their size, each in a direction of its own that depends on its number
/// alone. A regular grid of right-angled triangles is a place of rest for every other step here, but not a good mesh.
std::uint64_t shake(GuardedMesh& mesh, double share);
/// Steps from every vertex towards its target, as far as the guards allow, with flips in between; `targets` is per
/// vertex. A vertex of a line takes the nearest place of its line. Rounds end when nothing moves.
std::uint64_t move_towards(GuardedMesh& mesh, const std::vector<Vec3>& targets, int rounds);
/// Tries flips, collapses, moves and splits at each triangle with an angle below 30°, the worst first, and keeps what
/// makes the sum of shortfalls smaller.
std::uint64_t mend_bad_triangles(GuardedMesh& mesh, std::uint32_t since = 0);

}  // namespace strataflow
