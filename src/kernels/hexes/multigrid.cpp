#include "kernels/hexes/multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/unset_vector.h"

namespace strataflow {
namespace {

constexpr std::size_t grain = 2048;  // rows: those of coarse levels are long; shorter loops are not worth a thread

/// Which nodes are joined strongly.
struct NodeGraph {
  std::vector<std::uint32_t> first, others;
  std::uint32_t size() const { return static_cast<std::uint32_t>(first.size()) - 1; }
};

std::vector<std::uint32_t> node_of_unknown(const SoftModes& modes) {
  std::vector<std::uint32_t> node(modes.of_unknown.size());
  for (std::uint32_t n = 0; n + 1 < modes.first.size(); ++n)
    for (std::uint32_t i = modes.first[n]; i < modes.first[n + 1]; ++i) node[i] = n;
  return node;
}

NodeGraph strong_graph(const SparseRows& matrix, const SoftModes& modes) {
  constexpr double strong_ratio = 0.02;  // of the diagonal's
  const std::vector<std::uint32_t> node = node_of_unknown(modes);
  std::vector<double> diagonal(matrix.size(), 0);
  for (std::uint32_t i = 0; i < matrix.size(); ++i)
    for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k)
      if (matrix.columns[k] == i) diagonal[i] = matrix.values[k];
  const auto count = static_cast<std::uint32_t>(modes.first.size() - 1);
  std::vector<std::vector<std::uint32_t>> parts((count + grain - 1) / grain);
  NodeGraph graph;
  graph.first.assign(count + 1, 0);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& part = parts[begin / grain];
    for (std::size_t n = begin; n < end; ++n) {
      const auto from = static_cast<std::ptrdiff_t>(part.size());
      for (std::uint32_t i = modes.first[n]; i < modes.first[n + 1]; ++i)
        for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) {
          const std::uint32_t j = matrix.columns[k];
          if (node[j] == n || !(std::abs(matrix.values[k]) > strong_ratio * std::sqrt(diagonal[i] * diagonal[j])))
            continue;
          part.push_back(node[j]);
        }
      std::sort(part.begin() + from, part.end());
      part.erase(std::unique(part.begin() + from, part.end()), part.end());
      graph.first[n + 1] = static_cast<std::uint32_t>(part.size() - static_cast<std::size_t>(from));
    }
  });
  for (std::uint32_t n = 0; n < count; ++n) graph.first[n + 1] += graph.first[n];
  graph.others.reserve(graph.first.back());
  for (const auto& part : parts) graph.others.insert(graph.others.end(), part.begin(), part.end());
  return graph;
}

/// Groups of nodes: per node its group, groups numbered from 0.
struct Groups {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};

Groups pairs(const NodeGraph& graph) {
  Groups groups{std::vector<std::uint32_t>(graph.size(), no_index), 0};
  for (std::uint32_t n = 0; n < graph.size(); ++n) {
    if (groups.of[n] != no_index) continue;
    groups.of[n] = groups.count;
    for (std::uint32_t k = graph.first[n]; k < graph.first[n + 1]; ++k)
      if (groups.of[graph.others[k]] == no_index) {
        groups.of[graph.others[k]] = groups.count;
        break;
      }
    ++groups.count;
  }
  return groups;
}

/// Nodes with all around them; what is left over joins a group beside it.
Groups stars(const NodeGraph& graph) {
  Groups groups{std::vector<std::uint32_t>(graph.size(), no_index), 0};
  const auto around = [&](std::uint32_t n, auto&& visit) {
    for (std::uint32_t k = graph.first[n]; k < graph.first[n + 1]; ++k) visit(graph.others[k]);
  };
  for (std::uint32_t n = 0; n < graph.size(); ++n) {
    bool is_alone = groups.of[n] == no_index;
    around(n, [&](std::uint32_t other) { is_alone = is_alone && groups.of[other] == no_index; });
    if (!is_alone) continue;
    groups.of[n] = groups.count;
    around(n, [&](std::uint32_t other) { groups.of[other] = groups.count; });
    ++groups.count;
  }
  const std::vector<std::uint32_t> of_stars = groups.of;
  for (std::uint32_t n = 0; n < graph.size(); ++n)
    if (groups.of[n] == no_index)
      around(n, [&](std::uint32_t other) {
        if (groups.of[n] == no_index) groups.of[n] = of_stars[other];
      });
  for (std::uint32_t n = 0; n < graph.size(); ++n)
    if (groups.of[n] == no_index) groups.of[n] = groups.count++;
  return groups;
}

NodeGraph graph_of_groups(const NodeGraph& graph, const Groups& groups) {
  std::vector<std::uint32_t> first(groups.count + 1, 0), members(graph.size());
  for (const std::uint32_t g : groups.of) ++first[g + 1];
  for (std::uint32_t g = 0; g < groups.count; ++g) first[g + 1] += first[g];
  std::vector<std::uint32_t> next = first;
  for (std::uint32_t n = 0; n < graph.size(); ++n) members[next[groups.of[n]]++] = n;
  NodeGraph result;
  result.first.push_back(0);
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    const auto from = static_cast<std::ptrdiff_t>(result.others.size());
    for (std::uint32_t m = first[g]; m < first[g + 1]; ++m)
      for (std::uint32_t k = graph.first[members[m]]; k < graph.first[members[m] + 1]; ++k)
        if (groups.of[graph.others[k]] != g) result.others.push_back(groups.of[graph.others[k]]);
    std::sort(result.others.begin() + from, result.others.end());
    result.others.erase(std::unique(result.others.begin() + from, result.others.end()), result.others.end());
    result.first.push_back(static_cast<std::uint32_t>(result.others.size()));
  }
  return result;
}

Groups aggregates(const NodeGraph& graph) {
  constexpr std::size_t few_neighbours = 8;  // as tetrahedra have: stars of them would be small
  if (graph.others.size() > few_neighbours * graph.size()) return stars(graph);
  const Groups two = pairs(graph);
  const Groups many = stars(graph_of_groups(graph, two));
  Groups groups{two.of, many.count};
  for (std::uint32_t& g : groups.of) g = many.of[g];
  return groups;
}

/// The modes cut up by groups and made orthonormal in each: columns of the prolongation, and the modes on them.
SparseRows cut_modes(const SoftModes& modes, const Groups& groups, SoftModes& coarse) {
  constexpr double new_ratio = 1e-6;
  const auto size = static_cast<std::uint32_t>(modes.of_unknown.size());
  std::vector<std::uint32_t> first(groups.count + 1, 0), members(size);
  const std::vector<std::uint32_t> node = node_of_unknown(modes);
  for (std::uint32_t i = 0; i < size; ++i) ++first[groups.of[node[i]] + 1];
  for (std::uint32_t g = 0; g < groups.count; ++g) first[g + 1] += first[g];
  std::vector<std::uint32_t> next = first;
  for (std::uint32_t i = 0; i < size; ++i) members[next[groups.of[node[i]]]++] = i;
  std::vector<std::array<double, 2>> cut(size, {0, 0});
  coarse = {{0}, {}, modes.count};
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    std::uint32_t rank = 0;
    for (std::uint32_t mode = 0; mode < modes.count; ++mode) {
      double of_first = 0, all = 0, rest = 0;
      for (std::uint32_t m = first[g]; m < first[g + 1]; ++m) {
        const double value = modes.of_unknown[members[m]][mode];
        all += value * value;
        if (rank == 1) of_first += value * cut[members[m]][0];
      }
      for (std::uint32_t m = first[g]; m < first[g + 1]; ++m) {
        const double value = modes.of_unknown[members[m]][mode] - (rank == 1 ? of_first * cut[members[m]][0] : 0);
        cut[members[m]][rank] = value;
        rest += value * value;
      }
      const bool is_new = rest > new_ratio * all;
      for (std::uint32_t m = first[g]; m < first[g + 1]; ++m)
        cut[members[m]][rank] = is_new ? cut[members[m]][rank] / std::sqrt(rest) : 0;
      if (rank == 1) coarse.of_unknown.back()[mode] = of_first;
      if (!is_new) continue;
      coarse.of_unknown.push_back({0, 0});
      coarse.of_unknown.back()[mode] = std::sqrt(rest);
      ++rank;
    }
    coarse.first.push_back(static_cast<std::uint32_t>(coarse.of_unknown.size()));
  }
  SparseRows up;
  up.first.push_back(0);
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t g = groups.of[node[i]];
    for (std::uint32_t c = coarse.first[g]; c < coarse.first[g + 1]; ++c) {
      up.columns.push_back(c);
      up.values.push_back(cut[i][c - coarse.first[g]]);
    }
    up.first.push_back(static_cast<std::uint32_t>(up.columns.size()));
  }
  return up;
}

SparseRows transposed(const SparseRows& matrix, std::uint32_t columns) {
  SparseRows result;
  result.first.assign(columns + 1, 0);
  for (const std::uint32_t c : matrix.columns) ++result.first[c + 1];
  for (std::uint32_t c = 0; c < columns; ++c) result.first[c + 1] += result.first[c];
  result.columns.resize(matrix.columns.size());
  result.values.resize(matrix.columns.size());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < matrix.size(); ++i)
    for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) {
      const std::uint32_t at = next[matrix.columns[k]]++;
      result.columns[at] = i;
      result.values[at] = matrix.values[k];
    }
  return result;
}

/// Fills a matrix, whose `first` has lengths of rows, with the entries of its parts of `each` rows.
void append_rows(std::vector<SparseRows>& parts, std::size_t each, SparseRows& rows) {
  for (std::size_t i = 1; i < rows.first.size(); ++i) rows.first[i] += rows.first[i - 1];
  rows.columns.resize(rows.first.back());
  rows.values.resize(rows.first.back());
  parallel_ranges(parts.size(), 1, [&](std::size_t p, std::size_t) {
    const auto at = static_cast<std::ptrdiff_t>(rows.first[p * each]);
    std::copy(parts[p].columns.begin(), parts[p].columns.end(), rows.columns.begin() + at);
    std::copy(parts[p].values.begin(), parts[p].values.end(), rows.values.begin() + at);
    parts[p] = {};
  });
}

/// a · b; with `inverse` instead b − share · diag(inverse) · a · b, which smooths b's columns.
SparseRows product(const SparseRows& a, const SparseRows& b, std::uint32_t columns,
                   const std::vector<double>* inverse = nullptr, double share = 0) {
  const std::size_t rows = a.size(), each = std::max<std::size_t>(1024, rows / 48 + 1);
  std::vector<SparseRows> parts((rows + each - 1) / each);
  SparseRows result;
  result.first.assign(rows + 1, 0);
  parallel_ranges(rows, each, [&](std::size_t begin, std::size_t end) {
    SparseRows& part = parts[begin / each];
    std::vector<std::uint32_t> place(columns, no_index);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t from = part.columns.size();
      const auto add = [&](std::uint32_t row, double factor) {
        for (std::uint32_t k = b.first[row]; k < b.first[row + 1]; ++k) {
          std::uint32_t& at = place[b.columns[k]];
          if (at == no_index) {
            at = static_cast<std::uint32_t>(part.columns.size());
            part.columns.push_back(b.columns[k]);
            part.values.push_back(0);
          }
          part.values[at] += factor * b.values[k];
        }
      };
      if (inverse) add(static_cast<std::uint32_t>(i), 1);
      for (std::uint32_t k = a.first[i]; k < a.first[i + 1]; ++k)
        add(a.columns[k], inverse ? -share * (*inverse)[i] * a.values[k] : a.values[k]);
      for (std::size_t k = from; k < part.columns.size(); ++k) place[part.columns[k]] = no_index;
      result.first[i + 1] = static_cast<std::uint32_t>(part.columns.size() - from);
    }
  });
  append_rows(parts, each, result);
  return result;
}

std::vector<double> inverse_of_sums(const SparseRows& matrix) {
  return parallel_map(
      matrix.size(),
      [&](std::size_t i) {
        double sum = 0;
        for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) sum += std::abs(matrix.values[k]);
        return sum > 0 ? 1 / sum : 0.0;
      },
      grain);
}

double row_times(const SparseRows& matrix, std::size_t i, const std::vector<double>& v) {
  double sum = 0;
  for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) sum += matrix.values[k] * v[matrix.columns[k]];
  return sum;
}

}  // namespace

SparseRows symmetric_rows(std::uint32_t size, const std::vector<MatrixEntry>& lower) {
  // Bands of rows get the entries of both triangles, list by list: in each row they keep the order given.
  struct Item {
    std::uint32_t row, column;
    double value;
  };
  constexpr std::size_t list = 1 << 16, most_bands = 64;
  const std::size_t band_rows = std::max<std::size_t>(1024, size / most_bands + 1),
                    bands = (size + band_rows - 1) / band_rows, lists = (lower.size() + list - 1) / list;
  const auto visit = [&](std::size_t begin, std::size_t end, auto&& take) {
    for (std::size_t e = begin; e < end; ++e) {
      const MatrixEntry& entry = lower[e];
      take(Item{entry.row, entry.column, entry.value});
      if (entry.row != entry.column) take(Item{entry.column, entry.row, entry.value});
    }
  };
  std::vector<std::size_t> next(lists * bands, 0), band_first(bands + 1, 0);
  parallel_ranges(lower.size(), list, [&](std::size_t begin, std::size_t end) {
    visit(begin, end, [&](const Item& item) { ++next[begin / list * bands + item.row / band_rows]; });
  });
  std::size_t total = 0;
  for (std::size_t band = 0; band < bands; ++band) {
    for (std::size_t l = 0; l < lists; ++l) total += std::exchange(next[l * bands + band], total);
    band_first[band + 1] = total;
  }
  UnsetVector<Item> items(total);
  parallel_ranges(lower.size(), list, [&](std::size_t begin, std::size_t end) {
    visit(begin, end, [&](const Item& item) { items[next[begin / list * bands + item.row / band_rows]++] = item; });
  });
  std::vector<SparseRows> parts(bands);
  SparseRows rows;
  rows.first.assign(size + 1, 0);
  parallel_ranges(size, band_rows, [&](std::size_t begin, std::size_t end) {
    const std::size_t band = begin / band_rows;
    std::vector<std::size_t> start(end - begin + 1, 0);
    for (std::size_t e = band_first[band]; e < band_first[band + 1]; ++e) ++start[items[e].row - begin + 1];
    for (std::size_t i = 0; i < end - begin; ++i) start[i + 1] += start[i];
    UnsetVector<Item> own(start.back());
    std::vector<std::size_t> place(start.begin(), start.end() - 1);
    for (std::size_t e = band_first[band]; e < band_first[band + 1]; ++e) own[place[items[e].row - begin]++] = items[e];
    for (std::size_t i = begin; i < end; ++i) {
      Item* const from = own.data() + start[i - begin];
      Item* last = from;
      for (const Item* it = from; it != own.data() + start[i - begin + 1]; ++it) {
        Item* same = from;
        while (same != last && same->column != it->column) ++same;
        if (same == last)
          *last++ = *it;
        else
          same->value += it->value;
      }
      std::sort(from, last, [](const Item& a, const Item& b) { return a.column < b.column; });
      for (const Item* it = from; it != last; ++it) {
        parts[band].columns.push_back(it->column);
        parts[band].values.push_back(it->value);
      }
      rows.first[i + 1] = static_cast<std::uint32_t>(last - from);
    }
  });
  append_rows(parts, band_rows, rows);
  return rows;
}

void multiply(const SparseRows& matrix, const std::vector<double>& v, std::vector<double>& result) {
  result.resize(matrix.size());
  parallel_ranges(matrix.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[i] = row_times(matrix, i, v);
  });
}

SoftModes constant_mode(std::uint32_t size) {
  SoftModes modes{{}, std::vector<std::array<double, 2>>(size, {1, 0}), 1};
  modes.first.resize(size + 1);
  for (std::uint32_t i = 0; i <= size; ++i) modes.first[i] = i;
  return modes;
}

Multigrid::Multigrid(SparseRows matrix, SoftModes modes) {
  constexpr std::uint32_t small = 600;  // factorised
  constexpr std::size_t most_levels = 20;
  constexpr double smoothing_share = 4.0 / 3;
  levels_.push_back({std::move(matrix), {}, {}, {}});
  for (;;) {
    Level& level = levels_.back();
    level.inverse = inverse_of_sums(level.matrix);
    const std::uint32_t size = level.matrix.size();
    if (size <= small || levels_.size() == most_levels) break;
    const Groups groups = aggregates(strong_graph(level.matrix, modes));
    SoftModes coarse;
    const SparseRows cut = cut_modes(modes, groups, coarse);
    const auto count = static_cast<std::uint32_t>(coarse.of_unknown.size());
    if (count > 0.8 * size) break;  // nothing hangs together
    level.up = product(level.matrix, cut, count, &level.inverse, smoothing_share);
    level.down = transposed(level.up, count);
    SparseRows next = product(level.down, product(level.matrix, level.up, count), count);
    modes = std::move(coarse);
    levels_.push_back({std::move(next), {}, {}, {}});
  }
  const SparseRows& last = levels_.back().matrix;
  if (last.size() > 4 * small) return;
  std::vector<MatrixEntry> lower;
  for (std::uint32_t i = 0; i < last.size(); ++i)
    for (std::uint32_t k = last.first[i]; k < last.first[i + 1]; ++k)
      if (last.columns[k] <= i) lower.push_back({i, last.columns[k], last.values[k]});
  Result<SymmetricSystem> factor = SymmetricSystem::factorize(last.size(), lower);
  if (factor) coarsest_.emplace(std::move(*factor));
}

std::vector<double> Multigrid::operator()(const std::vector<double>& b) const {
  std::vector<Work> work;
  return (*this)(b, work);
}

const std::vector<double>& Multigrid::operator()(const std::vector<double>& b, std::vector<Work>& work) const {
  work.resize(levels_.size());
  work.front().residual = b;
  cycle(0, work);
  return work.front().x;
}

/// Two Chebyshev steps over the upper eigenvalues, the coarser level, two more.
void Multigrid::cycle(std::size_t index, std::vector<Work>& work) const {
  constexpr double low = 0.1, high = 1, middle = 0.5 * (high + low), half = 0.5 * (high - low), sigma = middle / half,
                   turn = 1 / (2 * sigma - 1 / sigma), keep = turn / sigma, pull = 2 * turn / half;
  const Level& level = levels_[index];
  const bool is_last = index + 1 == levels_.size();
  auto& [residual, x, first, second] = work[index];
  if (is_last && coarsest_) {
    x = coarsest_->solve(residual);
    return;
  }
  const std::size_t size = residual.size();
  const auto ranges = [&](auto&& item) {
    parallel_ranges(size, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) item(i);
    });
  };
  for (std::vector<double>* values : {&x, &first, &second}) values->resize(size);
  const auto smooth = [&](bool is_first) {
    ranges([&](std::size_t i) { first[i] = level.inverse[i] * residual[i] / middle; });
    ranges([&](std::size_t i) {
      residual[i] -= row_times(level.matrix, i, first);
      second[i] = keep * first[i] + pull * level.inverse[i] * residual[i];
      x[i] = (is_first ? 0 : x[i]) + first[i] + second[i];
    });
  };
  smooth(true);
  if (!is_last) {
    ranges([&](std::size_t i) { residual[i] -= row_times(level.matrix, i, second); });
    multiply(level.down, residual, work[index + 1].residual);
    cycle(index + 1, work);
    multiply(level.up, work[index + 1].x, first);
    ranges([&](std::size_t i) {
      residual[i] -= row_times(level.matrix, i, first);
      x[i] += first[i];
    });
    smooth(false);
  }
}

}  // namespace strataflow
