#include "kernels/quality/match_cell_faces.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "base/internal_error.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/quality/cell_shape.h"

namespace strataflow {

namespace {

constexpr std::uint32_t faces_per_cell = 6;
constexpr std::size_t example_limit = 10;

/// The face `slot` of `cell` turned so that its smallest vertex comes first; nothing when it has no area left.
std::optional<CellFace> face_of(const VolumeMesh& mesh, std::uint32_t cell, std::uint32_t slot) {
  const auto faces = shape_of(mesh.cell_types[cell]).faces;
  if (slot >= faces.size()) return std::nullopt;
  const std::uint32_t* vertices = &mesh.cell_vertices[mesh.cell_offsets[cell]];
  std::array<std::uint32_t, 4> cycle{};
  std::size_t count = 0;
  for (const std::uint8_t local : faces[slot])
    if (local != no_local_vertex && (count == 0 || cycle[count - 1] != vertices[local]))
      cycle[count++] = vertices[local];
  while (count > 1 && cycle[count - 1] == cycle[0]) --count;
  if (count < 3 || (count == 4 && (cycle[0] == cycle[2] || cycle[1] == cycle[3]))) return std::nullopt;
  const std::size_t first =
      static_cast<std::size_t>(std::min_element(cycle.begin(), cycle.begin() + count) - cycle.begin());
  CellFace face;
  face.cell = cell;
  for (std::size_t i = 0; i < count; ++i) face.vertices[i] = cycle[(first + i) % count];
  return face;
}

/// A face within the bucket of its smallest vertex. The other vertices ascend; a triangle's third is `no_index`.
struct BucketFace {
  std::array<std::uint32_t, 3> others;
  std::uint32_t opposite;  ///< the vertex across a quadrilateral from its smallest
  bool turns_up;           ///< the second vertex of the cycle is smaller than the last
  CellFace face;

  explicit BucketFace(const CellFace& seen) : face(seen) {
    const auto& v = seen.vertices;
    others = {v[1], v[2], v[3]};
    opposite = seen.is_triangle() ? no_index : v[2];
    turns_up = seen.is_triangle() ? v[1] < v[2] : v[1] < v[3];
    std::sort(others.begin(), others.end());
  }
  friend bool operator<(const BucketFace& a, const BucketFace& b) {
    return std::tie(a.others, a.face.cell, a.opposite, a.turns_up) <
           std::tie(b.others, b.face.cell, b.opposite, b.turns_up);
  }
};

void note_nonconforming(FaceMatching& matching, const CellFace& face) {
  ++matching.nonconforming_faces;
  if (matching.nonconforming_examples.size() < example_limit) matching.nonconforming_examples.push_back(face);
}

/// Sorts the faces of one smallest vertex into inner, boundary and nonconforming ones.
void match_bucket(std::vector<BucketFace>& bucket, std::vector<const BucketFace*>& single, FaceMatching& matching) {
  std::sort(bucket.begin(), bucket.end());
  single.clear();
  for (std::size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
    while (end < bucket.size() && bucket[end].others == bucket[begin].others) ++end;
    const BucketFace& first = bucket[begin];
    if (end - begin == 1) {
      matching.boundary_faces.push_back(first.face);
      single.push_back(&first);
    } else if (end - begin == 2 && first.opposite == bucket[begin + 1].opposite &&
               first.turns_up != bucket[begin + 1].turns_up) {
      ++matching.inner_faces;
    } else {
      note_nonconforming(matching, first.face);
    }
  }
  const auto is_single_triangle = [&](std::uint32_t i, std::uint32_t j) {
    const std::array<std::uint32_t, 3> wanted{i, j, no_index};
    const auto found = std::lower_bound(single.begin(), single.end(), wanted,
                                        [](const BucketFace* face, const auto& key) { return face->others < key; });
    return found != single.end() && (*found)->others == wanted;
  };
  for (const BucketFace* quad : single) {
    if (quad->face.is_triangle()) continue;
    const auto [i, j, k] = quad->others;  // whichever diagonal is cut, one of the triangles has the smallest vertex
    if (is_single_triangle(i, j) || is_single_triangle(i, k) || is_single_triangle(j, k))
      note_nonconforming(matching, quad->face);
  }
}

}  // namespace

FaceMatching match_cell_faces(const VolumeMesh& mesh, const std::vector<char>* is_kept) {
  STRATAFLOW_ASSERT(mesh.cell_count() < std::numeric_limits<std::uint32_t>::max() / faces_per_cell, "too many cells");
  const auto cell_count = static_cast<std::uint32_t>(mesh.cell_count());
  // A counting sort by smallest vertex: linear, and no face is stored, only cell · 6 + slot.
  std::vector<std::uint32_t> smallest(std::size_t{cell_count} * faces_per_cell, no_index);
  parallel_ranges(cell_count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      if (is_kept && !(*is_kept)[cell]) continue;
      for (std::uint32_t slot = 0; slot < faces_per_cell; ++slot)
        if (const auto face = face_of(mesh, static_cast<std::uint32_t>(cell), slot))
          smallest[cell * faces_per_cell + slot] = face->vertices[0];
    }
  });
  std::vector<std::uint32_t> bucket_begin(mesh.points.size() + 1, 0);
  for (const std::uint32_t vertex : smallest)
    if (vertex != no_index) ++bucket_begin[vertex + 1];
  for (std::size_t vertex = 0; vertex < mesh.points.size(); ++vertex) bucket_begin[vertex + 1] += bucket_begin[vertex];
  std::vector<std::uint32_t> face_ids(bucket_begin.back());
  std::vector<std::uint32_t> next(bucket_begin.begin(), bucket_begin.end() - 1);
  for (std::uint32_t id = 0; id < smallest.size(); ++id)
    if (smallest[id] != no_index) face_ids[next[smallest[id]]++] = id;

  constexpr std::size_t grain = 2048;
  const auto parts = parallel_map((mesh.points.size() + grain - 1) / grain, [&](std::size_t block) {
    FaceMatching part;
    std::vector<BucketFace> bucket;
    std::vector<const BucketFace*> single;
    for (std::size_t vertex = block * grain; vertex < std::min(mesh.points.size(), (block + 1) * grain); ++vertex) {
      bucket.clear();
      for (std::uint32_t i = bucket_begin[vertex]; i < bucket_begin[vertex + 1]; ++i)
        bucket.emplace_back(*face_of(mesh, face_ids[i] / faces_per_cell, face_ids[i] % faces_per_cell));
      match_bucket(bucket, single, part);
    }
    return part;
  });
  FaceMatching matching;
  for (const FaceMatching& part : parts) {
    matching.inner_faces += part.inner_faces;
    matching.boundary_faces.insert(matching.boundary_faces.end(), part.boundary_faces.begin(),
                                   part.boundary_faces.end());
    matching.nonconforming_faces += part.nonconforming_faces;
    for (const CellFace& face : part.nonconforming_examples)
      if (matching.nonconforming_examples.size() < example_limit) matching.nonconforming_examples.push_back(face);
  }
  return matching;
}

}  // namespace strataflow
