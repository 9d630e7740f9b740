#include "kernels/cutting/identify_points.h"

#include <algorithm>
#include <numeric>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/adapters/cgal/exact_position.h"
#include "kernels/cutting/rounded_position.h"

namespace strataflow {

bool CutPoints::before(std::uint32_t a, std::uint32_t b) const {
  const Vec3 &p = position(a), &q = position(b);
  if (a == b || !(p == q)) return lexicographically_less(p, q);
  return compare(exact_position(*input_, definition(a)), exact_position(*input_, definition(b))) < 0;
}

std::vector<std::uint32_t> CutPoints::identify(const std::vector<PointDefinition>& definitions) {
  constexpr std::size_t grain = 256;
  // One of each definition.
  std::vector<std::uint32_t> order(definitions.size());
  std::iota(order.begin(), order.end(), 0u);
  sort_total_order(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto by = definitions[a] <=> definitions[b];
    return by != 0 ? by < 0 : a < b;
  });
  std::vector<std::uint32_t> unique_of(definitions.size());
  std::vector<std::uint32_t> first;
  for (const std::uint32_t i : order) {
    if (first.empty() || definitions[first.back()] != definitions[i]) first.push_back(i);
    unique_of[i] = static_cast<std::uint32_t>(first.size() - 1);
  }
  std::vector<Known> fresh(first.size());
  parallel_ranges(first.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PointDefinition& d = definitions[first[i]];
      const bool is_input = d.kind == PointDefinition::Kind::vertex;
      fresh[i] = is_input ? Known{(*input_)[d.vertices[0]], d, d.vertices[0]}
                          : Known{snapped_to_file(rounded_position(*input_, d), origin_), d, no_index};
    }
  });

  // Known and fresh ones together by position; where positions agree, exact arithmetic tells places apart.
  struct Entry {
    Vec3 position;
    std::uint32_t known;  ///< index into known_, or no_index
    std::uint32_t fresh;
  };
  std::vector<Entry> entries;
  entries.reserve(known_.size() + fresh.size());
  for (std::uint32_t k = 0; k < known_.size(); ++k) entries.push_back({known_[k].position, k, no_index});
  for (std::uint32_t f = 0; f < fresh.size(); ++f) entries.push_back({fresh[f].position, no_index, f});
  sort_total_order(entries, [](const Entry& a, const Entry& b) {
    if (!(a.position == b.position)) return lexicographically_less(a.position, b.position);
    return a.known != b.known ? a.known < b.known : a.fresh < b.fresh;  // known ones first
  });

  std::vector<Known> merged;
  merged.reserve(entries.size());
  std::vector<std::uint32_t> place_of_fresh(fresh.size());  // index into merged
  struct Met {
    ExactPosition exact;
    std::uint32_t merged;
  };
  std::vector<Met> met;
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin + 1;
    while (end < entries.size() && entries[end].position == entries[begin].position) ++end;
    met.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Known& candidate = entries[i].known != no_index ? known_[entries[i].known] : fresh[entries[i].fresh];
      std::size_t found = met.size();
      ExactPosition exact;
      if (end - begin > 1) {
        exact = exact_position(*input_, candidate.definition);
        for (found = 0; found < met.size() && compare(met[found].exact, exact) != 0;) ++found;
      }
      if (found == met.size()) {
        met.push_back({exact, static_cast<std::uint32_t>(merged.size())});
        merged.push_back(candidate);
      } else if (Known& same = merged[met[found].merged]; same.id == no_index && candidate.id != no_index) {
        same = candidate;  // an input point lies exactly there
      }
      if (entries[i].fresh != no_index) place_of_fresh[entries[i].fresh] = met[found].merged;
    }
    begin = end;
  }
  for (Known& point : merged)
    if (point.id == no_index) {
      point.id = count();
      added_.push_back(point);
    }
  std::vector<std::uint32_t> ids(definitions.size());
  for (std::size_t i = 0; i < definitions.size(); ++i) ids[i] = merged[place_of_fresh[unique_of[i]]].id;
  known_ = std::move(merged);
  return ids;
}

}  // namespace strataflow
