#include "kernels/cutting/cut_triangles.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "base/id.h"
#include "base/seed.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/cutting/coplanar_pieces.h"
#include "kernels/cutting/cut_triangle.h"
#include "kernels/cutting/pair_contact.h"

namespace strataflow {

namespace {

constexpr std::size_t pair_grain = 256, triangle_grain = 64;

/// What all pairs share, flat. Points of segments are indices into `definitions` until they are identified.
struct Contacts {
  std::vector<PointDefinition> definitions;
  std::vector<PointOnTriangle> points;
  std::vector<SegmentOnTriangle> segments;
  std::vector<std::uint32_t> overlapping;  ///< triangles that may share area with another
};

void append(Contacts& all, Contacts&& more) {
  const auto base = static_cast<std::uint32_t>(all.definitions.size());
  all.definitions.insert(all.definitions.end(), more.definitions.begin(), more.definitions.end());
  for (PointOnTriangle p : more.points) {
    p.point += base;
    all.points.push_back(p);
  }
  for (SegmentOnTriangle s : more.segments) {
    for (std::uint32_t& end : s.ends) end += base;
    all.segments.push_back(s);
  }
  all.overlapping.insert(all.overlapping.end(), more.overlapping.begin(), more.overlapping.end());
}

Contacts find_contacts(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                       const std::vector<IntersectingPair>& pairs, const std::vector<char>& may_be_cut) {
  const auto cuttable = [&](std::uint32_t t) { return may_be_cut.empty() || may_be_cut[t]; };
  const std::size_t chunks = (pairs.size() + pair_grain - 1) / pair_grain;
  std::vector<Contacts> parts = parallel_map(chunks, [&](std::size_t chunk) {
    Contacts part;
    for (std::size_t i = chunk * pair_grain; i < std::min(pairs.size(), (chunk + 1) * pair_grain); ++i) {
      const std::uint32_t t = pairs[i].first, u = pairs[i].second;
      const PairContact contact = contact_of(points, triangles[t], triangles[u]);
      const auto base = static_cast<std::uint32_t>(part.definitions.size());
      for (const PairContact::Point& p : contact.points) {
        const auto at = static_cast<std::uint32_t>(part.definitions.size());
        if (cuttable(t)) part.points.push_back({t, at, p.in_first});
        if (cuttable(u)) part.points.push_back({u, at, p.in_second});
        part.definitions.push_back(p.definition);
      }
      if (cuttable(t))
        for (const PairContact::Segment& s : contact.in_first)
          part.segments.push_back({t, {base + s.from, base + s.to}, u, s.edge});
      if (cuttable(u))
        for (const PairContact::Segment& s : contact.in_second)
          part.segments.push_back({u, {base + s.from, base + s.to}, t, s.edge});
      if (contact.is_coplanar && contact.points.size() > 2) {
        part.overlapping.push_back(t);
        part.overlapping.push_back(u);
      }
    }
    return part;
  });
  Contacts all;
  for (Contacts& part : parts) append(all, std::move(part));
  return all;
}

template <class T>
void sort_unique(std::vector<T>& values) {
  sort_total_order(values, [](const T& a, const T& b) { return a < b; });  // equal ones are the same bits
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The part of a list sorted by triangle that belongs to one.
template <class T>
std::span<const T> of_triangle(const std::vector<T>& sorted, std::uint32_t triangle, std::size_t& cursor) {
  while (cursor < sorted.size() && sorted[cursor].triangle < triangle) ++cursor;
  const std::size_t begin = cursor;
  while (cursor < sorted.size() && sorted[cursor].triangle == triangle) ++cursor;
  return {sorted.data() + begin, cursor - begin};
}

/// Points and segments per touched triangle, in order of triangles.
std::vector<TriangleContents> group_by_triangle(const std::vector<PointOnTriangle>& points,
                                                const std::vector<SegmentOnTriangle>& segments) {
  std::vector<TriangleContents> contents;
  std::size_t point_cursor = 0, segment_cursor = 0;
  while (point_cursor < points.size()) {
    const std::uint32_t t = points[point_cursor].triangle;
    TriangleContents c{t, of_triangle(points, t, point_cursor), of_triangle(segments, t, segment_cursor)};
    // Corners alone cut nothing.
    const bool is_touched = !c.segments.empty() || std::any_of(c.points.begin(), c.points.end(),
                                                               [](const PointOnTriangle& p) { return p.place >= 3; });
    if (is_touched) contents.push_back(c);
  }
  return contents;
}

/// Adds the points where segments cross inside triangles.
void add_crossings(CutPoints& cut_points, const std::vector<Triangle>& triangles, Contacts& contacts) {
  const std::vector<TriangleContents> contents = group_by_triangle(contacts.points, contacts.segments);
  struct Found {
    std::uint32_t triangle;
    PointDefinition definition;
  };
  const std::size_t chunks = (contents.size() + triangle_grain - 1) / triangle_grain;
  const auto parts = parallel_map(chunks, [&](std::size_t chunk) {
    std::vector<Found> found;
    TriangleCutter cutter(cut_points, triangles);
    for (std::size_t i = chunk * triangle_grain; i < std::min(contents.size(), (chunk + 1) * triangle_grain); ++i)
      for (const SegmentCrossing& crossing : cutter.find_crossings(contents[i]))
        found.push_back({contents[i].triangle, crossing.definition});
    return found;
  });
  std::vector<PointDefinition> definitions;
  std::vector<std::uint32_t> owners;
  for (const auto& part : parts)
    for (const Found& f : part) {
      definitions.push_back(f.definition);
      owners.push_back(f.triangle);
    }
  if (definitions.empty()) return;
  const std::vector<std::uint32_t> ids = cut_points.identify(definitions);
  // A crossing may fall on a point the triangle has already, with its place.
  for (std::size_t i = 0; i < ids.size(); ++i) contacts.points.push_back({owners[i], ids[i], place_inside});
  sort_unique(contacts.points);
  contacts.points.erase(std::unique(contacts.points.begin(), contacts.points.end(),
                                    [](const PointOnTriangle& a, const PointOnTriangle& b) {
                                      return a.triangle == b.triangle && a.point == b.point;
                                    }),
                        contacts.points.end());
}

/// Sorts items that have a triangle each by where its corners are, so that their numbers decide between identical ones
/// only.
template <class TriangleOf>
void sort_by_position(std::vector<std::uint32_t>& items, const std::vector<Vec3>& points, TriangleOf&& triangle_of) {
  const auto less = [&](std::uint32_t a, std::uint32_t b) { return lexicographically_less(points[a], points[b]); };
  struct Key {
    Triangle corners;
    std::uint32_t item;
  };
  std::vector<Key> keys;
  for (const std::uint32_t item : items) {
    Triangle t = triangle_of(item);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end(), less), t.end());
    keys.push_back({t, item});
  }
  sort_total_order(keys, [&](const Key& a, const Key& b) {
    for (int k = 0; k < 3; ++k)
      if (a.corners[k] != b.corners[k]) return less(a.corners[k], b.corners[k]);
    return a.item < b.item;
  });
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = keys[i].item;
}

/// Numbers the areas between segments.
std::vector<std::uint32_t> number_pockets(const std::vector<ConstrainedTriangulation::Cell>& cells) {
  std::vector<std::uint32_t> pocket(cells.size(), no_index), stack;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < cells.size(); ++seed) {
    if (pocket[seed] != no_index) continue;
    pocket[seed] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t cell = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = cells[cell].neighbours[k];
        if (cells[cell].is_fixed[k] || other == no_index || pocket[other] != no_index) continue;
        pocket[other] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
  return pocket;
}

/// Per point from `first_new` on: the point at the same position that stands for it, an earlier one if there is one,
/// else itself. Earlier points differ from each other.
std::vector<std::uint32_t> find_same_positions(const std::vector<Vec3>& points, std::size_t first_new) {
  std::vector<std::uint32_t> sorted(points.size() - first_new), same(sorted.size());
  std::iota(sorted.begin(), sorted.end(), static_cast<std::uint32_t>(first_new));
  sort_total_order(sorted, [&](std::uint32_t a, std::uint32_t b) {
    return points[a] == points[b] ? a < b : lexicographically_less(points[a], points[b]);
  });
  // Few points are new: most of the others are told apart by their x alone.
  std::vector<char> is_taken(std::bit_ceil(16 * sorted.size() + 1), 0);
  const auto slot = [&](const Vec3& p) {
    return mix64(std::bit_cast<std::uint64_t>(p.x + 0.0)) & (is_taken.size() - 1);
  };
  for (const std::uint32_t i : sorted) is_taken[slot(points[i])] = 1;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    same[sorted[i] - first_new] =
        i > 0 && points[sorted[i - 1]] == points[sorted[i]] ? same[sorted[i - 1] - first_new] : sorted[i];
  parallel_ranges(first_new, 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_taken[slot(points[i])]) continue;
      auto at = std::lower_bound(sorted.begin(), sorted.end(), points[i],
                                 [&](std::uint32_t a, const Vec3& p) { return lexicographically_less(points[a], p); });
      for (; at != sorted.end() && points[*at] == points[i]; ++at)
        same[*at - first_new] = static_cast<std::uint32_t>(i);
    }
  });
  return same;
}

}  // namespace

Result<TriangleCut> cut_triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                  const std::vector<IntersectingPair>& pairs, const std::vector<char>& may_be_cut,
                                  const Vec3& origin) {
  const auto too_many = [] {
    return Failure{FailureCode::unsupported, "cutting makes more points or triangles than 32-bit indices can count",
                   "coarsen the surfaces, or cut fewer at a time"};
  };
  Contacts contacts = find_contacts(points, triangles, pairs, may_be_cut);
  if (contacts.definitions.size() >= no_index - points.size()) return too_many();

  CutPoints cut_points(points, origin);
  {
    const std::vector<std::uint32_t> ids = cut_points.identify(contacts.definitions);
    contacts.definitions = {};
    for (PointOnTriangle& p : contacts.points) p.point = ids[p.point];
    for (SegmentOnTriangle& s : contacts.segments) {
      for (std::uint32_t& end : s.ends) end = ids[end];
      if (s.ends[0] > s.ends[1]) std::swap(s.ends[0], s.ends[1]);
    }
  }
  sort_unique(contacts.points);
  sort_unique(contacts.segments);
  sort_unique(contacts.overlapping);
  add_crossings(cut_points, triangles, contacts);

  const std::vector<TriangleContents> contents = group_by_triangle(contacts.points, contacts.segments);
  std::vector<std::uint32_t> contents_of_overlapping;
  for (std::uint32_t i = 0; i < contents.size(); ++i)
    if (std::binary_search(contacts.overlapping.begin(), contacts.overlapping.end(), contents[i].triangle))
      contents_of_overlapping.push_back(i);
  std::vector<CutPieces> pieces(contents.size());
  parallel_ranges(contents.size(), triangle_grain, [&](std::size_t begin, std::size_t end) {
    TriangleCutter cutter(cut_points, triangles);
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_consistent = cutter.triangulate(contents[i]);
      STRATAFLOW_ASSERT(is_consistent, "the segments of a cut triangle contradict each other");
      pieces[i].triangles.reserve(cutter.cells().size());
      for (const auto& cell : cutter.cells())
        pieces[i].triangles.push_back(
            {cutter.point(cell.vertices[0]), cutter.point(cell.vertices[1]), cutter.point(cell.vertices[2])});
      if (std::binary_search(contents_of_overlapping.begin(), contents_of_overlapping.end(),
                             static_cast<std::uint32_t>(i)))
        pieces[i].pocket = number_pockets(cutter.cells());
    }
  });
  sort_by_position(contents_of_overlapping, points, [&](std::uint32_t i) { return triangles[contents[i].triangle]; });
  unify_coplanar_pieces(pieces, contents_of_overlapping);

  TriangleCut cut;
  cut.points.reserve(cut_points.count());
  cut.points = points;
  for (auto i = static_cast<std::uint32_t>(points.size()); i < cut_points.count(); ++i)
    cut.points.push_back(cut_points.position(i));
  const std::vector<std::uint32_t> same = find_same_positions(cut.points, points.size());

  std::size_t piece_count = 0;
  for (const CutPieces& p : pieces) piece_count += p.triangles.size();
  if (triangles.size() + piece_count >= no_index / 3) return too_many();
  cut.triangles.reserve(triangles.size() + piece_count);
  cut.source.reserve(triangles.size() + piece_count);
  cut.is_piece.reserve(triangles.size() + piece_count);
  std::uint32_t done = 0;
  const auto leave_until = [&](std::uint32_t end) {
    cut.triangles.insert(cut.triangles.end(), triangles.begin() + done, triangles.begin() + end);
    for (; done < end; ++done) cut.source.push_back(done);
    cut.is_piece.resize(cut.triangles.size(), 0);
  };
  for (std::size_t i = 0; i < contents.size(); ++i) {
    leave_until(contents[i].triangle);
    for (Triangle piece : pieces[i].triangles) {
      for (std::uint32_t& v : piece)
        if (v >= points.size()) v = same[v - points.size()];
      if (piece[0] == piece[1] || piece[1] == piece[2] || piece[2] == piece[0]) {
        ++cut.collapsed_count;
        continue;
      }
      cut.triangles.push_back(piece);
      cut.source.push_back(done);
      cut.is_piece.push_back(1);
    }
    ++done;
  }
  leave_until(static_cast<std::uint32_t>(triangles.size()));
  cut.cut_triangle_count = contents.size();
  return cut;
}

}  // namespace strataflow
