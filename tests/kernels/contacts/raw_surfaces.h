#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "kernels/contacts/contact_mesh.h"
#include "kernels/contacts/cut_constrained.h"
#include "kernels/contacts/find_contacts.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "support/shapes.h"

namespace strataflow::support {

/// A sheet of columns × rows quads, `at(u, v)` with u, v in [0, 1], its points shared.
inline std::uint32_t add_grid(TriangleSoup& soup, std::uint32_t patch, std::uint32_t columns, std::uint32_t rows,
                              const std::function<Vec3(double, double)>& at) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) soup.points.push_back(at(double(i) / columns, double(j) / rows));
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = first + j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      for (const Triangle& t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
        soup.triangles.push_back(t);
        soup.triangle_patch.push_back(patch);
      }
    }
  return first;
}

/// A patch of an entity that has one already.
inline std::uint32_t add_patch_of(TriangleSoup& soup, std::uint32_t entity) {
  soup.patch_entity.push_back(entity);
  return static_cast<std::uint32_t>(soup.patch_entity.size() - 1);
}

/// A box 10 × 10 × 10, a fault x = 5 and a horizon z = 5 in two halves, all of them `gap` short of what they should
/// touch (a negative gap overshoots).
inline TriangleSoup raw_box(double gap, std::uint32_t divisions) {
  TriangleSoup soup = box({0, 0, 0}, {10, 10, 10});
  const double low = gap, high = 10 - gap, span = high - low;
  add_grid(soup, add_patch(soup, "F1", Role::fault), divisions, divisions, [&](double u, double v) {
    return Vec3{5, low + span * u, low + span * v};
  });
  const std::uint32_t left = add_patch(soup, "H1", Role::horizon);
  const std::uint32_t right = add_patch_of(soup, soup.patch_entity[left]);
  const double width = 5 - 2 * gap;
  add_grid(soup, left, divisions, divisions, [&](double u, double v) {
    return Vec3{gap + width * u, low + span * v, 5};
  });
  add_grid(soup, right, divisions, divisions, [&](double u, double v) {
    return Vec3{5 + gap + width * u, low + span * v, 5};
  });
  return soup;
}

inline ConstrainedCut cut(const TriangleSoup& soup, const ContactConstraints& constraints,
                          const ConstrainedCutOptions& options = {}) {
  Result<ConstrainedCut> result = cut_constrained(soup, constraints, options);
  EXPECT_TRUE(result) << (result ? "" : describe(result.failure()));
  return result ? *std::move(result) : ConstrainedCut{};
}

/// Every failure of a cut, one a line; empty is good.
inline std::string failures(const ConstrainedCut& cut) {
  std::string text;
  for (const std::string& failure : cut.failures) text += failure + "\n";
  for (const ContactReport& report : cut.borders)
    for (const std::string& failure : report.failures) text += failure + "\n";
  return text;
}

inline std::vector<double> region_volumes(const TriangleSoup& soup) {
  const Result<BuiltModel> built = build_structural_model(soup);
  EXPECT_TRUE(built) << (built ? "" : describe(built.failure()));
  std::vector<double> volumes;
  if (built)
    for (const Region& region : built->model.regions) volumes.push_back(region.volume_m3);
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

/// The violations of a model made from these surfaces, one a line.
inline std::string violations(const TriangleSoup& soup) {
  const Result<BuiltModel> built = build_structural_model(soup);
  if (!built) return describe(built.failure());
  std::string text;
  for (const Violation& violation : check_validity(*built).violations)
    text += violation.kind + ": " + violation.what + "\n";
  return text;
}

/// Length of the edges that two entities share vertex for vertex, each once.
inline double shared_length_m(const TriangleSoup& soup, std::uint32_t one, std::uint32_t other) {
  const ContactMesh mesh(soup);
  double sum = 0;
  for (const std::uint32_t t : mesh.triangles_of(one))
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangle(t)[k], b = mesh.triangle(t)[(k + 1) % 3];
      if (!mesh.has_edge(a, b, other)) continue;
      sum += length(mesh.point(b) - mesh.point(a)) / mesh.count_at(a, b, one);
    }
  return sum;
}

inline double area_m2(const TriangleSoup& soup, std::uint32_t entity) {
  double sum = 0;
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    const Triangle& t = soup.triangles[i];
    if (soup.patch_entity[soup.triangle_patch[i]] == entity)
      sum += 0.5 * length(cross(soup.points[t[1]] - soup.points[t[0]], soup.points[t[2]] - soup.points[t[0]]));
  }
  return sum;
}

/// The positions an entity has, each once, ascending.
inline std::vector<Vec3> positions_of(const TriangleSoup& soup, std::uint32_t entity) {
  std::vector<Vec3> list;
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    if (soup.patch_entity[soup.triangle_patch[i]] == entity)
      for (const std::uint32_t p : soup.triangles[i]) list.push_back(soup.points[p]);
  std::sort(list.begin(), list.end(), lexicographically_less);
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

/// Positions that two entities share.
inline std::vector<Vec3> shared_positions(const TriangleSoup& soup, std::uint32_t one, std::uint32_t other) {
  const std::vector<Vec3> a = positions_of(soup, one), b = positions_of(soup, other);
  std::vector<Vec3> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both), lexicographically_less);
  return both;
}

}  // namespace strataflow::support
