#include "kernels/contacts/find_contacts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "base/option_field.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/contacts/contact_mesh.h"
#include "kernels/contacts/surface_search.h"

namespace strataflow {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// How one edge of a border lies to one entity.
struct Nearness {
  std::uint32_t entity = no_index;
  double max_m = 0;                    ///< of its ends and its middle
  double ahead_m = 0;                  ///< of the middle's impact, along the border's outward direction
  double facing = 0;                   ///< |cosine| of outward direction and the entity's normal
  std::array<double, 3> distance_m{};  ///< of its first end, its middle, its second end
};

/// Everything near the edges of borders.
class Surroundings {
 public:
  explicit Surroundings(const TriangleSoup& soup) : soup_(soup), sheets_(soup.entities.size()) {
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
      sheets_[soup.patch_entity[soup.triangle_patch[t]]].triangles.push_back(t);
    for (Sheet& sheet : sheets_) {
      std::vector<FloatBox> boxes(sheet.triangles.size());
      parallel_ranges(boxes.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          Box3 box;
          for (const std::uint32_t p : soup.triangles[sheet.triangles[i]]) box.take(soup.points[p]);
          boxes[i] = enclosing(box);
        }
      });
      sheet.tree = BoundingVolumeTree(boxes);
    }
  }

  /// Entities within the distance of both ends and the middle of edge `i`, ascending; only `wanted`, if any.
  std::vector<Nearness> near(const Border& border, std::size_t i, double distance_m, double sag_ratio,
                             std::uint32_t wanted) const {
    const Vec3 &a = soup_.points[border.points[i]], &b = soup_.points[border.points[(i + 1) % border.points.size()]];
    distance_m += sag_ratio * length(b - a);
    const std::array<Vec3, 3> samples{a, 0.5 * (a + b), b};
    const Vec3 out = outward(border, i);
    std::vector<Nearness> result;
    for (std::uint32_t entity = 0; entity < sheets_.size(); ++entity) {
      if (entity == border.entity || (wanted != no_index && entity != wanted)) continue;
      Nearness n{entity, 0, 0, 0, {}};
      for (int s = 0; s < 3; ++s) {
        const Impact impact = nearest(sheets_[entity], samples[s], distance_m);
        n.distance_m[s] = impact.distance_m;
        n.max_m = std::max(n.max_m, impact.distance_m);
        if (!(impact.distance_m <= distance_m)) break;
        if (s != 1) continue;
        n.ahead_m = dot(out, impact.point - samples[s]);
        const Triangle& tri = soup_.triangles[impact.triangle];
        const Vec3 normal =
            cross(soup_.points[tri[1]] - soup_.points[tri[0]], soup_.points[tri[2]] - soup_.points[tri[0]]);
        const double size = length(normal);
        n.facing = size > 0 ? std::abs(dot(out, normal)) / size : 0;
      }
      if (n.max_m <= distance_m) result.push_back(n);
    }
    return result;
  }

 private:
  /// The triangles of one entity.
  struct Sheet {
    std::vector<std::uint32_t> triangles;
    BoundingVolumeTree tree;
  };

  /// The nearest place, of equal ones that of the lowest triangle; infinitely far if none is within the limit.
  Impact nearest(const Sheet& sheet, const Vec3& p, double limit_m) const {
    Impact best{no_index, {}, infinite};
    const double margin = 1 + 1e-12;  // a rounded distance must not hide an equal one
    double limit_m2 = margin * limit_m * limit_m;
    sheet.tree.visit_nearest(p, limit_m2, [&](std::uint32_t place) {
      const std::uint32_t t = sheet.triangles[sheet.tree.item_at(place)];
      const Triangle& tri = soup_.triangles[t];
      const Vec3 q = nearest_on_triangle(p, soup_.points[tri[0]], soup_.points[tri[1]], soup_.points[tri[2]]);
      const double d = length(q - p);
      if (d < best.distance_m || (d == best.distance_m && t < best.triangle)) best = {t, q, d};
      return limit_m2 = std::min(limit_m2, margin * best.distance_m * best.distance_m);
    });
    return best;
  }

  Vec3 outward(const Border& border, std::size_t i) const {
    const Vec3 &a = soup_.points[border.points[i]], &b = soup_.points[border.points[(i + 1) % border.points.size()]];
    const Triangle& t = soup_.triangles[border.triangles[i]];
    const Vec3 middle = (1.0 / 3) * (soup_.points[t[0]] + soup_.points[t[1]] + soup_.points[t[2]]);
    const Vec3 along = b - a, in = middle - a;
    const Vec3 out = (dot(in, along) / dot(along, along)) * along - in;
    const double size = length(out);
    return size > 0 ? (1 / size) * out : Vec3{};
  }

  const TriangleSoup& soup_;
  std::vector<Sheet> sheets_;  ///< per entity
};

const Nearness* find(const std::vector<Nearness>& near, std::uint32_t entity) {
  for (const Nearness& n : near)
    if (n.entity == entity) return &n;
  return nullptr;
}

/// The edges [first, first + count) of a border as a contact.
void add_contact(const TriangleSoup& soup, const Border& border, const std::vector<std::vector<Nearness>>& near,
                 std::size_t first, std::size_t count, std::uint32_t controller, FoundContacts& found) {
  BorderOnSurface contact;
  contact.entity = border.entity;
  contact.controller = controller;
  contact.is_closed = border.is_closed && count == border.edge_count();
  ContactGap gap;
  double ahead_m = 0;
  const std::size_t size = border.points.size();
  for (std::size_t i = first; i < first + count + (contact.is_closed ? 0 : 1); ++i)
    contact.points.push_back(border.points[i % size]);
  for (std::size_t i = first; i < first + count; ++i) {
    const Nearness& n = *find(near[i % border.edge_count()], controller);
    ahead_m += n.ahead_m;
    const Vec3 &a = soup.points[border.points[i % size]], &b = soup.points[border.points[(i + 1) % size]];
    for (int s = 0; s < 3; ++s)
      if (n.distance_m[s] > gap.max_gap_m) {
        gap.max_gap_m = n.distance_m[s];
        gap.where = s == 0 ? a : s == 2 ? b : 0.5 * (a + b);
      }
  }
  gap.overshoots = ahead_m < 0;
  found.constraints.borders.push_back(std::move(contact));
  found.gaps.push_back(gap);
}

/// The free edges of entities, to measure stones against.
struct FreeEdges {
  const TriangleSoup& soup;
  const std::vector<Border>& borders;
  double distance_m(std::uint32_t entity, const Vec3& p) const {
    double best = infinite;
    for (const Border& border : borders)
      if (border.entity == entity)
        for (std::size_t i = 0; i < border.edge_count(); ++i)
          best = std::min(best, length(nearest_on_segment(p, soup.points[border.points[i]],
                                                          soup.points[border.points[(i + 1) % border.points.size()]]) -
                                       p));
    return best;
  }
};

bool lies_near_all(const std::vector<std::vector<Nearness>>& near, std::uint32_t entity, double facing, double& max_m) {
  max_m = 0;
  double sum = 0;
  for (const auto& edge : near) {
    const Nearness* n = find(edge, entity);
    if (!n) return false;
    max_m = std::max(max_m, n->max_m);
    sum += n->facing;
  }
  return sum >= facing * static_cast<double>(near.size());
}

bool conforms(const ContactMesh& mesh, const Border& border, std::size_t edge, std::uint32_t entity) {
  const std::size_t i = edge % border.edge_count();
  return mesh.has_edge(mesh.vertex_of_input(border.points[i]),
                       mesh.vertex_of_input(border.points[(i + 1) % border.points.size()]), entity);
}

double facing_of(const FindContactsOptions& options) { return std::sin(options.facing_deg * std::numbers::pi / 180); }

/// The edges [first, end) of a border, all on one controller: a contact of each run of them that do not conform yet.
void add_runs(const TriangleSoup& soup, const ContactMesh& mesh, const Border& border,
              const std::vector<std::vector<Nearness>>& near, std::size_t first, std::size_t end,
              std::uint32_t controller, FoundContacts& found) {
  while (first < end) {
    std::size_t last = first;
    while (last < end && !conforms(mesh, border, last, controller)) ++last;
    if (last > first) add_contact(soup, border, near, first, last - first, controller, found);
    first = std::max(last, first + 1);
  }
}

/// Which controller every edge of a border belongs to, so that the area between is least; passing from one to the next
/// costs the distance squared. That fee is tuned on the reference models: with half of it, the border of a horizon that
/// an unconformity grazes (A6 at 50 m) hops between the two. Empty if an edge has none.
std::vector<std::uint32_t> choose_controllers(const TriangleSoup& soup, const ContactMesh& mesh, const Border& border,
                                              const std::vector<std::vector<Nearness>>& near, double facing,
                                              double distance_m) {
  struct Way {
    std::uint32_t entity;
    double cost;
    std::size_t before;
  };
  const auto has_part_on = [&](std::uint32_t entity) {
    for (std::size_t i = 0; i < border.edge_count(); ++i)
      if (conforms(mesh, border, i, entity)) return true;
    return false;
  };
  std::map<std::uint32_t, bool> is_held;  // a border that is on it in part may run beside it elsewhere
  for (const auto& edge : near)
    for (const Nearness& n : edge)
      if (is_held.find(n.entity) == is_held.end()) is_held[n.entity] = has_part_on(n.entity);
  const double change_m2 = distance_m * distance_m;
  std::vector<std::vector<Way>> ways(border.edge_count());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Vec3 &a = soup.points[border.points[i]], &b = soup.points[border.points[(i + 1) % border.points.size()]];
    const double edge_m = length(b - a);
    for (const Nearness& n : near[i]) {
      if (n.facing < facing && !is_held[n.entity]) continue;
      Way way{n.entity, i == 0 ? 0 : infinite, 0};
      for (std::size_t k = 0; i > 0 && k < ways[i - 1].size(); ++k) {
        const double cost = ways[i - 1][k].cost + (ways[i - 1][k].entity == n.entity ? 0 : change_m2);
        if (cost < way.cost) way = {n.entity, cost, k};
      }
      way.cost += conforms(mesh, border, i, n.entity) ? 0 : n.max_m * edge_m;
      ways[i].push_back(way);
    }
    if (ways[i].empty()) return {};
  }
  std::vector<std::uint32_t> choice(ways.size());
  std::size_t at = 0;
  for (std::size_t k = 1; k < ways.back().size(); ++k)
    if (ways.back()[k].cost < ways.back()[at].cost) at = k;
  for (std::size_t i = ways.size(); i-- > 0; at = ways[i][at].before) choice[i] = ways[i][at].entity;
  return choice;
}

/// Contacts of a border whose edges belong to the controllers `choice`.
void add_chosen(const TriangleSoup& soup, const ContactMesh& mesh, const Border& border,
                const std::vector<std::vector<Nearness>>& near, const std::vector<std::uint32_t>& choice,
                FoundContacts& found) {
  const std::size_t count = border.edge_count();
  std::size_t start = 0;
  if (border.is_closed) {
    const auto continues = [&](std::size_t i) {
      const std::size_t before = (i + count - 1) % count;
      return choice[i] == choice[before] &&
             conforms(mesh, border, i, choice[i]) == conforms(mesh, border, before, choice[before]);
    };
    while (start < count && continues(start)) ++start;
    start %= count;
  }
  for (std::size_t first = start; first < start + count;) {
    std::size_t end = first + 1;
    while (end < start + count && choice[end % count] == choice[first % count]) ++end;
    add_runs(soup, mesh, border, near, first, end, choice[first % count], found);
    first = end;
  }
}

/// Whether it was attached, or needs not be.
bool attach_border(const TriangleSoup& soup, const ContactMesh& mesh, const Border& border,
                   const std::vector<std::vector<Nearness>>& near, const FindContactsOptions& options, double facing,
                   FoundContacts& found) {
  const std::size_t count = border.edge_count();
  std::vector<std::uint32_t> choice = choose_controllers(soup, mesh, border, near, facing, options.distance_m);
  if (choice.empty()) {
    // Some edges may run beside a surface that the border faces as a whole.
    std::uint32_t whole = no_index;
    double whole_m = infinite;
    for (const Nearness& n : near[0]) {
      double max_m = 0;
      if (!lies_near_all(near, n.entity, facing, max_m) || !(max_m < whole_m)) continue;
      whole_m = max_m;
      whole = n.entity;
    }
    if (whole == no_index) return false;
    choice.assign(count, whole);
  }
  add_chosen(soup, mesh, border, near, choice, found);
  return true;
}

/// The ends of contacts: point → the contacts that end there.
std::map<std::uint32_t, std::vector<std::uint32_t>> ends_of(const ContactConstraints& constraints) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> ends;
  for (std::uint32_t i = 0; i < constraints.borders.size(); ++i) {
    const BorderOnSurface& c = constraints.borders[i];
    if (c.is_closed) continue;
    ends[c.points.front()].push_back(i);
    ends[c.points.back()].push_back(i);
  }
  return ends;
}

bool take_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// One text of name_contacts, taken apart.
struct NamedContact {
  std::string_view controlled, controller;
  std::optional<double> within_m;
  std::optional<std::size_t> border;  ///< from 0
  bool is_stone = false;
};

std::optional<NamedContact> parse_contact(std::string_view text) {
  NamedContact named;
  const std::size_t arrow = text.find("->");
  if (arrow == std::string_view::npos) return std::nullopt;
  named.controlled = trimmed(text.substr(0, arrow));
  named.controller = trimmed(text.substr(arrow + 2));
  if (const std::size_t at = named.controller.rfind(" within "); at != std::string_view::npos) {
    double within = 0;
    if (!take_number(trimmed(named.controller.substr(at + 8)), within) || !(within > 0)) return std::nullopt;
    named.within_m = within;
    named.controller = trimmed(named.controller.substr(0, at));
  }
  if (named.controlled.ends_with(".stone") && named.controller.ends_with(".border")) {
    named.is_stone = true;
    named.controlled.remove_suffix(6);
    named.controller.remove_suffix(7);
  } else if (const std::size_t at = named.controlled.rfind(".border "); at != std::string_view::npos) {
    double number = 0;
    if (!take_number(trimmed(named.controlled.substr(at + 8)), number) || !(number >= 1 && number <= 1e9) ||
        number != std::floor(number))
      return std::nullopt;
    named.border = static_cast<std::size_t>(number) - 1;
    named.controlled = named.controlled.substr(0, at);
  }
  if (named.controlled.empty() || named.controller.empty() || named.controlled == named.controller) return std::nullopt;
  return named;
}

/// "H2 -> F3 within 25", for all borders of H2.
struct NamedReach {
  const std::string* text = nullptr;
  std::uint32_t controlled = 0, controller = 0;
  double within_m = 0;
  bool is_met = false;  ///< a border, or a part of one, was found for it
};

/// Borders that no single name fits, divided among the controllers named for their entity: one may pass from a fault to
/// the next without a stone. `is_taken` is per border.
void divide_named(const TriangleSoup& soup, const std::vector<Border>& borders, const Surroundings& surroundings,
                  const std::vector<bool>& is_taken, double facing, std::vector<NamedReach>& reaches,
                  FoundContacts& found) {
  const ContactMesh mesh(soup);
  for (std::size_t b = 0; b < borders.size(); ++b) {
    const Border& border = borders[b];
    std::vector<std::vector<Nearness>> near(border.edge_count());
    double distance_m = 0;
    int controllers = 0;
    for (const NamedReach& reach : reaches) {
      if (is_taken[b] || reach.controlled != border.entity) continue;
      ++controllers;
      distance_m = std::max(distance_m, reach.within_m);
      const auto own = parallel_map(near.size(), [&](std::size_t e) {
        return surroundings.near(border, e, reach.within_m, 0, reach.controller);
      });
      for (std::size_t e = 0; e < near.size(); ++e)
        if (!own[e].empty() && !find(near[e], reach.controller)) near[e].push_back(own[e][0]);
    }
    if (controllers < 2 || is_taken[b]) continue;
    const std::vector<std::uint32_t> choice = choose_controllers(soup, mesh, border, near, facing, distance_m);
    if (choice.empty()) continue;
    add_chosen(soup, mesh, border, near, choice, found);
    for (NamedReach& reach : reaches)
      if (reach.controlled == border.entity &&
          std::find(choice.begin(), choice.end(), reach.controller) != choice.end())
        reach.is_met = true;
  }
}

}  // namespace

FoundContacts find_contacts(const TriangleSoup& soup, const FindContactsOptions& options) {
  FoundContacts found;
  if (soup.triangles.empty() || !(options.distance_m > 0)) return found;
  const std::vector<Border> borders = find_borders(soup, options.borders);
  const Surroundings surroundings(soup);
  const auto near = parallel_map(borders.size(), [&](std::size_t i) {
    std::vector<std::vector<Nearness>> edges;
    for (std::size_t e = 0; e < borders[i].edge_count(); ++e)
      edges.push_back(surroundings.near(borders[i], e, options.distance_m, options.sag_ratio, no_index));
    return edges;
  });
  const ContactMesh mesh(soup);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < borders.size(); ++i)
    if (!attach_border(soup, mesh, borders[i], near[i], options, facing_of(options), found)) left.push_back(i);
  // A border that runs beside a surface still belongs to it where both its ends do belong to contacts: a truncation
  // whose angle comes down to nothing.
  const auto ends = ends_of(found.constraints);
  for (const std::size_t i : left) {
    const Border& border = borders[i];
    if (!border.is_closed && ends.find(border.points.front()) != ends.end() &&
        ends.find(border.points.back()) != ends.end())
      attach_border(soup, mesh, border, near[i], options, 0, found);
  }

  const FreeEdges free_edges{soup, borders};
  for (const auto& [point, contacts] : ends_of(found.constraints))
    for (std::size_t i = 0; i < contacts.size(); ++i)
      for (std::size_t j = i + 1; j < contacts.size(); ++j) {
        const BorderOnSurface &a = found.constraints.borders[contacts[i]], &b = found.constraints.borders[contacts[j]];
        if (a.entity != b.entity || a.controller != b.controller) continue;
        if (free_edges.distance_m(a.controller, soup.points[point]) <= options.distance_m)
          found.constraints.stones.push_back({a.entity, point, a.controller});
      }
  return found;
}

Result<FoundContacts> name_contacts(const TriangleSoup& soup, const std::vector<std::string>& texts,
                                    const FindContactsOptions& options) {
  FoundContacts found;
  const std::vector<Border> borders = find_borders(soup, options.borders);
  const Surroundings surroundings(soup);
  Box3 box;
  for (const Vec3& p : soup.points) box.take(p);
  const auto entity_named = [&](std::string_view name) {
    for (std::uint32_t e = 0; e < soup.entities.size(); ++e)
      if (soup.entities[e].name == name) return e;
    return no_index;
  };
  std::vector<NamedReach> reaches;
  std::vector<bool> is_taken(borders.size(), false);
  const auto none_lies_there = [](const std::string& text, std::string_view controlled) {
    return Failure{FailureCode::invalid_options,
                   "contact \"" + text + "\": no border of " + std::string(controlled) + " lies there and faces it",
                   "widen within, or name the border by its number"};
  };
  // Stones last: they are ends of contacts.
  for (const bool is_stone_turn : {false, true}) {
    if (is_stone_turn) {
      divide_named(soup, borders, surroundings, is_taken, facing_of(options), reaches, found);
      for (const NamedReach& reach : reaches)
        if (!reach.is_met) return none_lies_there(*reach.text, soup.entities[reach.controlled].name);
    }
    for (const std::string& text : texts) {
      const auto fail = [&](const std::string& why, const std::string& remedy) {
        return Failure{FailureCode::invalid_options, "contact \"" + text + "\": " + why, remedy};
      };
      const auto named = parse_contact(text);
      if (!named)
        return fail("not of the form \"H2 -> F3 within 25\"",
                    "write border owner -> surface, or owner.stone -> surface.border");
      if (named->is_stone != is_stone_turn) continue;
      const std::uint32_t controlled = entity_named(named->controlled), controller = entity_named(named->controller);
      for (const auto& [entity, name] :
           {std::pair{controlled, named->controlled}, std::pair{controller, named->controller}})
        if (entity == no_index) return fail("no surface is called " + std::string(name), "use a name of the input");
      bool is_any = false;
      if (is_stone_turn) {
        const FreeEdges free_edges{soup, borders};
        std::uint32_t best = no_index;
        double best_m = infinite;
        for (const auto& [point, contacts] : ends_of(found.constraints)) {
          if (found.constraints.borders[contacts[0]].entity != controlled) continue;
          const double d = free_edges.distance_m(controller, soup.points[point]);
          if (named->within_m && d <= *named->within_m) {
            found.constraints.stones.push_back({controlled, point, controller});
            is_any = true;
          }
          if (d < best_m) {
            best_m = d;
            best = point;
          }
        }
        if (!named->within_m && best != no_index) {
          found.constraints.stones.push_back({controlled, best, controller});
          is_any = true;
        }
        if (!is_any)
          return fail("no end of a contact of " + std::string(named->controlled) + " is there",
                      "name its contacts too");
        continue;
      }
      std::vector<const Border*> own;
      for (const Border& border : borders)
        if (border.entity == controlled) own.push_back(&border);
      if (named->border) {
        if (*named->border >= own.size())
          return fail(std::string(named->controlled) + " has " + std::to_string(own.size()) + " borders",
                      "count from 1");
        own = {own[*named->border]};
      }
      const Border* nearest = nullptr;
      double nearest_m = infinite;
      std::vector<std::vector<Nearness>> nearest_edges;
      const double reach_m = named->within_m.value_or(box.diagonal_m());
      for (const Border* border : own) {
        const auto near = parallel_map(
            border->edge_count(), [&](std::size_t e) { return surroundings.near(*border, e, reach_m, 0, controller); });
        double max_m = 0;
        if (!lies_near_all(near, controller, named->border ? 0 : facing_of(options), max_m)) continue;
        if (named->within_m) {
          add_contact(soup, *border, near, 0, border->edge_count(), controller, found);
          is_taken[static_cast<std::size_t>(border - borders.data())] = true;
          is_any = true;
        } else if (max_m < nearest_m) {
          nearest_m = max_m;
          nearest = border;
          nearest_edges = near;
        }
      }
      if (nearest) add_contact(soup, *nearest, nearest_edges, 0, nearest->edge_count(), controller, found);
      if (named->within_m && !named->border)
        reaches.push_back({&text, controlled, controller, *named->within_m, is_any});
      else if (!nearest && !is_any)
        return none_lies_there(text, named->controlled);
    }
  }
  return found;
}

FoundContacts joined(const FoundContacts& named, const FoundContacts& found) {
  using Edge = std::array<std::uint32_t, 2>;
  const auto edges_of = [](const BorderOnSurface& c) {
    std::vector<Edge> edges;
    for (std::size_t i = 0; i + (c.is_closed ? 0 : 1) < c.points.size(); ++i) {
      const std::uint32_t a = c.points[i], b = c.points[(i + 1) % c.points.size()];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
    return edges;
  };
  std::vector<Edge> taken;
  for (const BorderOnSurface& c : named.constraints.borders)
    for (const Edge& edge : edges_of(c)) taken.push_back(edge);
  std::sort(taken.begin(), taken.end());
  FoundContacts all = named;
  for (std::size_t i = 0; i < found.gaps.size(); ++i) {
    const std::vector<Edge> edges = edges_of(found.constraints.borders[i]);
    if (std::any_of(edges.begin(), edges.end(),
                    [&](const Edge& e) { return std::binary_search(taken.begin(), taken.end(), e); }))
      continue;
    all.constraints.borders.push_back(found.constraints.borders[i]);
    all.gaps.push_back(found.gaps[i]);
  }
  const auto& stones = named.constraints.stones;
  for (const StoneOnBorder& stone : found.constraints.stones)
    if (std::none_of(stones.begin(), stones.end(), [&](const StoneOnBorder& s) { return s.point == stone.point; }))
      all.constraints.stones.push_back(stone);
  return all;
}

std::string describe(const TriangleSoup& soup, const BorderOnSurface& contact, const ContactGap& gap) {
  char metres[32];
  std::snprintf(metres, sizeof metres, "%.3g", gap.max_gap_m);
  const Vec3 p = gap.where + soup.local_origin;
  const std::string& controller = soup.entities[contact.controller].name;
  return soup.entities[contact.entity].name +
         (gap.overshoots ? " overshoots " + controller + " by " + metres + " m"
                         : " stops " + std::string(metres) + " m short of " + controller) +
         " at (" + OptionPrinter::literal(p.x) + ", " + OptionPrinter::literal(p.y) + ", " +
         OptionPrinter::literal(p.z) + ")";
}

}  // namespace strataflow
