#include "kernels/quads/map/map_reduction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/id.h"
#include "kernels/quads/map/exact_elimination.h"

namespace strataflow {

namespace {

using Term = ExactElimination::Term;
using Outcome = ExactElimination::Outcome;

/// Real and imaginary part of i^turns · z as signed scalars: part[axis] = sign · z[source].
struct Turned {
  std::array<std::uint32_t, 2> source{};
  std::array<std::int64_t, 2> sign{};
  explicit Turned(int turns) {
    switch (turns & 3) {
      case 0:
        source = {0, 1}, sign = {1, 1};
        break;
      case 1:
        source = {1, 0}, sign = {-1, 1};
        break;
      case 2:
        source = {0, 1}, sign = {-1, -1};
        break;
      default:
        source = {1, 0}, sign = {1, -1};
        break;
    }
  }
};

/// The charts and the places: a spanning forest over triangles, its cut graph without dead ends.
struct Charts {
  const FeatureMesh& mesh;
  const FeatureLayout& layout;
  std::vector<std::uint8_t> chart, is_cut;  ///< per triangle; per half-edge
  std::vector<std::uint8_t> turn;           ///< per half-edge, between common charts
  std::vector<std::uint32_t> piece;         ///< per triangle
  std::vector<std::uint32_t> seeds;         ///< per piece: its first triangle
  std::vector<std::uint32_t> place_of;
  std::uint32_t places = 0;

  Charts(const FeatureMesh& m, const FeatureLayout& l, const std::vector<std::uint8_t>& turns) : mesh(m), layout(l) {
    const auto count = static_cast<std::uint32_t>(layout.triangle_count());
    chart.assign(count, 0);
    is_cut.assign(3 * count, 1);
    piece.assign(count, no_index);
    std::vector<std::uint32_t> queue;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
      if (piece[seed] != no_index) continue;
      piece[seed] = static_cast<std::uint32_t>(seeds.size());
      seeds.push_back(seed);
      queue.assign(1, seed);
      for (std::size_t next = 0; next < queue.size(); ++next)
        for (std::uint32_t h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
          const std::uint32_t g = layout.opposite[h];
          if (g == no_index || piece[g / 3] != no_index) continue;
          // V = i^chart U: our chart = i^turns[h] · theirs, so theirs follows from ours.
          chart[g / 3] = static_cast<std::uint8_t>((chart[h / 3] + turns[h]) & 3);
          piece[g / 3] = piece[seed];
          is_cut[h] = is_cut[g] = 0;
          queue.push_back(g / 3);
        }
    }
    turn.assign(3 * count, 0);
    for (std::uint32_t h = 0; h < 3 * count; ++h)
      if (const std::uint32_t g = layout.opposite[h]; g != no_index)
        turn[h] = static_cast<std::uint8_t>((turns[h] + chart[h / 3] + 4 - chart[g / 3]) & 3);
    prune();
    number_places();
  }

  std::uint32_t origin(std::uint32_t h) const { return mesh.triangles[h / 3][h % 3]; }

  /// Dead ends of the cut graph whose charts agree across the last edge are no cuts.
  void prune() {
    std::vector<std::uint32_t> degree(mesh.points.size(), 0), out(is_cut.size(), no_index),
        last(mesh.points.size(), no_index);
    // Cut half-edges leaving each point, as linked lists; boundary edges count for both their ends.
    const auto leave = [&](std::uint32_t point, std::uint32_t h) {
      out[h] = last[point];
      last[point] = h;
    };
    for (std::uint32_t h = 0; h < is_cut.size(); ++h) {
      if (!is_cut[h]) continue;
      ++degree[origin(h)];
      if (layout.opposite[h] == no_index) ++degree[origin(next_half_edge(h))];
      leave(origin(h), h);
    }
    std::vector<std::uint32_t> stack;
    for (std::uint32_t p = 0; p < degree.size(); ++p)
      if (degree[p] == 1) stack.push_back(p);
    while (!stack.empty()) {
      const std::uint32_t p = stack.back();
      stack.pop_back();
      if (degree[p] != 1) continue;
      std::uint32_t h = last[p];
      while (h != no_index && !is_cut[h]) h = out[h];
      if (h == no_index || layout.opposite[h] == no_index || turn[h] != 0) continue;
      is_cut[h] = is_cut[layout.opposite[h]] = 0;
      --degree[p];
      const std::uint32_t end = origin(next_half_edge(h));
      if (--degree[end] == 1) stack.push_back(end);
    }
  }

  void number_places() {
    const auto corners = static_cast<std::uint32_t>(is_cut.size());
    place_of.assign(corners, no_index);
    for (std::uint32_t seed = 0; seed < corners; ++seed) {
      if (place_of[seed] != no_index) continue;
      // Clockwise to a cut or once around, then back.
      std::uint32_t first = seed;
      while (!is_cut[first]) {
        first = next_half_edge(layout.opposite[first]);
        if (first == seed) break;
      }
      for (std::uint32_t c = first;;) {
        place_of[c] = places;
        const std::uint32_t incoming = previous_half_edge(c);
        if (is_cut[incoming]) break;
        c = layout.opposite[incoming];
        if (c == first) break;
      }
      ++places;
    }
  }
};

Failure contradiction(const std::string& what) {
  return {FailureCode::geometry_failed, what, "leave a feature out, ask for smaller quads, or let the boundary free"};
}

}  // namespace

std::vector<double> MapReduction::scalars(const std::vector<double>& x) const {
  std::vector<double> v(constant);
  for (std::size_t s = 0; s < v.size(); ++s)
    for (std::uint32_t i = first[s]; i < first[s + 1]; ++i) v[s] += entries[i].coefficient * x[entries[i].unknown];
  return v;
}

Result<MapReduction> reduce_map(const FeatureMesh& mesh, const FeatureLayout& layout,
                                const std::vector<std::uint8_t>& turns, const std::vector<MapAxis>& axes,
                                const std::vector<IntegerConstraint>& constraints, std::vector<std::uint32_t>* stuck) {
  const auto half_edges = static_cast<std::uint32_t>(3 * layout.triangle_count());
  const auto misfit = [](const std::string& what) {
    return Failure{FailureCode::invalid_input, what, "build the map from the field of the same mesh"};
  };
  if (turns.size() != half_edges || axes.size() != half_edges) return misfit("turns or axes are not one per half-edge");
  std::uint32_t auxiliaries = 0;
  for (const IntegerConstraint& constraint : constraints)
    for (const IntegerTerm& term : constraint.terms)
      if (term.corner >= half_edges) {
        if (term.corner - half_edges > half_edges) return misfit("a constraint names a corner that is not there");
        auxiliaries = std::max(auxiliaries, term.corner - half_edges + 1);
      }
  for (std::uint32_t h = 0; h < half_edges; ++h)
    if (const std::uint32_t g = layout.opposite[h]; g != no_index && ((turns[h] + turns[g]) & 3) != 0)
      return misfit("turns across edge " + std::to_string(h) + " do not match");

  Charts charts(mesh, layout, turns);
  MapReduction reduction;
  reduction.chart = charts.chart;
  reduction.place_of = charts.place_of;
  // Scalars of places, of auxiliaries, of translations across cuts: the youngest are eliminated first.
  std::vector<std::uint32_t> seam(half_edges, no_index);
  std::uint32_t variables = 2 * (charts.places + auxiliaries);
  for (std::uint32_t h = 0; h < half_edges; ++h) {
    if (!charts.is_cut[h] || layout.opposite[h] == no_index || layout.opposite[h] < h) continue;
    seam[h] = variables;
    variables += 2;
    ++reduction.cut_edges;
  }
  ExactElimination elimination(variables);
  const auto end_place = [&](std::uint32_t h) { return charts.place_of[next_half_edge(h)]; };
  const auto overflow = [&] {
    return Failure{FailureCode::geometry_failed, "the constraints of the map need numbers beyond 64 bits",
                   "ask for larger quads"};
  };

  // Feature edges along an axis: the other coordinate is the same at both ends.
  const auto constant_axis = [&](std::uint32_t h) -> std::uint32_t {
    return ((axes[h] == MapAxis::real ? 1u : 0u) + charts.chart[h / 3]) & 1u;
  };
  for (std::uint32_t h = 0; h < half_edges; ++h) {
    if (axes[h] == MapAxis::none) continue;
    const std::uint32_t s = constant_axis(h);
    const std::array<Term, 2> equal{{{2 * charts.place_of[h] + s, 1}, {2 * end_place(h) + s, -1}}};
    if (elimination.add(equal, 0) == Outcome::overflow) return overflow();
  }
  for (std::uint32_t h = 0; h < half_edges; ++h) {
    if (seam[h] == no_index) continue;
    const std::uint32_t g = layout.opposite[h];
    const Turned turned(charts.turn[h]);
    for (const auto& [ours, theirs] :
         {std::pair(charts.place_of[h], end_place(g)), std::pair(end_place(h), charts.place_of[g])})
      for (std::uint32_t axis = 0; axis < 2; ++axis) {
        const std::array<Term, 3> jump{
            {{2 * ours + axis, 1}, {2 * theirs + turned.source[axis], -turned.sign[axis]}, {seam[h] + axis, -1}}};
        if (elimination.add(jump, 0) == Outcome::overflow) return overflow();
      }
  }

  // Scalar terms of a constraint, in the common charts.
  const auto scalar_terms = [&](const IntegerConstraint& constraint, std::uint32_t axis) {
    std::vector<Term> terms;
    for (const IntegerTerm& term : constraint.terms) {
      const bool auxiliary = term.corner >= half_edges;
      const std::uint32_t base =
          2 * (auxiliary ? charts.places + term.corner - half_edges : charts.place_of[term.corner]);
      const Turned turned(auxiliary ? 0 : 4 - charts.chart[term.corner / 3]);
      const GaussianInteger c = term.coefficient;
      const auto add = [&](std::uint32_t part, std::int64_t factor) {
        if (factor != 0) terms.push_back({base + turned.source[part], factor * turned.sign[part]});
      };
      add(0, axis == 0 ? c.re : c.im);
      add(1, axis == 0 ? -c.im : c.re);
    }
    return terms;
  };
  const auto where = [&](const IntegerConstraint& constraint) {
    for (const IntegerTerm& term : constraint.terms)
      if (term.corner < half_edges) return name_point(mesh, mesh.triangles[term.corner / 3][term.corner % 3]);
    return std::string("an auxiliary unknown");
  };
  for (const IntegerConstraint& constraint : constraints)
    for (std::uint32_t axis = 0; axis < 2; ++axis) {
      const Outcome outcome =
          elimination.add(scalar_terms(constraint, axis), axis == 0 ? constraint.value.re : constraint.value.im);
      if (outcome == Outcome::overflow) return overflow();
      if (outcome == Outcome::contradiction)
        return contradiction("the integers of the map contradict each other at " + where(constraint));
    }

  // What may still slide as a whole is pinned, piece by piece: a shift by one along an axis of the common chart that no
  // constraint feels. Seams and features never do.
  for (std::uint32_t piece = 0; piece < charts.seeds.size(); ++piece)
    for (std::uint32_t axis = 0; axis < 2; ++axis) {
      bool feels = false;
      for (const IntegerConstraint& constraint : constraints)
        for (std::uint32_t part = 0; part < 2 && !feels; ++part) {
          std::int64_t sum = 0;
          for (const Term& term : scalar_terms(constraint, part)) {
            if (term.variable >= 2 * charts.places || term.variable % 2 != axis) continue;
            sum += term.coefficient;
          }
          bool inside = false;
          for (const IntegerTerm& term : constraint.terms)
            inside |= term.corner < half_edges && charts.piece[term.corner / 3] == piece;
          feels |= inside && sum != 0;
        }
      const std::array<Term, 1> pin{{{2 * charts.place_of[3 * charts.seeds[piece]] + axis, 1}}};
      if (!feels && elimination.add(pin, 0) == Outcome::overflow) return overflow();
    }

  // A feature edge whose free coordinate cannot change either has length zero.
  for (std::uint32_t h = 0; h < half_edges; ++h) {
    if (axes[h] == MapAxis::none) continue;
    const std::uint32_t s = 1 - constant_axis(h);
    if (elimination.resolve(2 * charts.place_of[h] + s) == elimination.resolve(2 * end_place(h) + s)) {
      if (stuck) stuck->push_back(h / 3);
      return contradiction(name_feature(mesh, layout, h) + " would get length zero between " +
                           name_point(mesh, charts.origin(h)) + " and " +
                           name_point(mesh, charts.origin(next_half_edge(h))));
    }
  }

  std::vector<std::uint32_t> number(variables, no_index);
  reduction.first = {0};
  for (std::uint32_t s = 0; s < 2 * charts.places; ++s) {
    const ExactElimination::Form form = elimination.resolve(s);
    if (elimination.overflowed()) return overflow();
    for (const auto& term : form.terms) {
      if (number[term.variable] == no_index) number[term.variable] = reduction.unknowns++;
      reduction.entries.push_back({number[term.variable], term.coefficient.value()});
    }
    reduction.constant.push_back(form.constant.value());
    reduction.first.push_back(static_cast<std::uint32_t>(reduction.entries.size()));
  }
  if (reduction.unknowns == 0) return contradiction("the constraints leave the map no freedom at all");
  return reduction;
}

}  // namespace strataflow
