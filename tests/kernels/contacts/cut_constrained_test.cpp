#include "kernels/contacts/cut_constrained.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <tuple>

#include "base/archive.h"
#include "base/digest.h"
#include "kernels/contacts/raw_surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::add_grid;
using support::add_patch;
using support::cut;
using support::failures;
using support::raw_box;
using support::region_volumes;

ContactConstraints found_in(const TriangleSoup& soup, double distance_m) {
  return find_contacts(soup, {.distance_m = distance_m}).constraints;
}

class ConstrainedCutOfABox : public testing::TestWithParam<std::tuple<double, std::uint32_t>> {};

TEST_P(ConstrainedCutOfABox, closes_every_leak_into_four_regions_of_250) {
  const auto [gap, divisions] = GetParam();
  const TriangleSoup raw = raw_box(gap, divisions);
  const ConstrainedCut result = cut(raw, found_in(raw, 1.5 * std::abs(gap)));
  EXPECT_EQ(failures(result), "");
  const std::vector<double> volumes = region_volumes(result.soup);
  ASSERT_EQ(volumes.size(), 4u) << support::violations(result.soup);
  for (const double volume : volumes) EXPECT_NEAR(volume, 250, 1e-9);
  EXPECT_EQ(support::violations(result.soup), "");
  ASSERT_EQ(result.borders.size(), 12u);
  for (const ContactReport& report : result.borders) {
    EXPECT_GE(report.max_move_m, 0.9 * std::abs(gap));
    EXPECT_LE(report.max_move_m, 2 * std::abs(gap));
  }
}

INSTANTIATE_TEST_SUITE_P(GapsAndOvershoots, ConstrainedCutOfABox,
                         testing::Combine(testing::Values(1e-6, 1e-3, 0.1, 0.3, -1e-6, -1e-3, -0.1),
                                          testing::Values(1u, 4u, 7u)));

TEST(ConstrainedCut, a_corner_goes_to_where_its_controllers_cross_not_to_the_corner_of_another_contact) {
  TriangleSoup raw;  // F1 pokes through South, sharing nothing with it
  add_grid(raw, add_patch(raw, "F1", Role::fault), 3, 3, [](double u, double v) { return Vec3{5, 8 * u - 2, 8 * v}; });
  add_grid(raw, add_patch(raw, "South", Role::boundary), 4, 3,
           [](double u, double v) { return Vec3{10 * u, 0, 8 * v}; });
  std::vector<std::string> contacts;
  for (const auto& [name, z] : {std::pair{"H1", 3.0}, {"H2", 5.0}}) {
    add_grid(raw, add_patch(raw, name, Role::horizon), 3, 3,
             [z = z](double u, double v) { return Vec3{1 + 4.3 * u, 3 * v - 0.3, z}; });
    for (const char* onto : {"F1", "South"}) contacts.push_back(std::string(name) + " -> " + onto + " within 0.4");
  }
  const Result<FoundContacts> named = name_contacts(raw, contacts, {});
  ASSERT_TRUE(named) << describe(named.failure());
  const ConstrainedCut result = cut(raw, named->constraints);
  EXPECT_EQ(failures(result), "");
  const std::uint32_t h2 = 3;
  for (const Vec3& p : support::positions_of(result.soup, h2)) EXPECT_NEAR(p.z, 5, 1e-9);
  for (const ContactReport& report : result.borders) EXPECT_LT(report.max_move_m, 0.5);
}

TEST(ConstrainedCut, a_half_horizon_pulled_along_x_closes_the_leak) {
  // Test 2 of euler1999 §4.2 to the letter: only the left half stops short, at x = 4.9, and is led along +x.
  TriangleSoup raw = raw_box(1e-3, 3);
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    Vec3& p = raw.points[i];
    if (std::abs(p.x - (5 - 1e-3)) < 1e-9 && p.z == 5) p.x = 4.9;
  }
  FoundContacts found = find_contacts(raw, {.distance_m = 2e-3, .sag_ratio = 0});
  EXPECT_EQ(found.constraints.borders.size(), 11u);  // the contact with the fault is out of reach
  const std::vector<double> leaking = region_volumes(cut(raw, found.constraints).soup);
  ASSERT_EQ(leaking.size(), 3u);
  EXPECT_NEAR(leaking.back(), 500, 1e-9);
  found = find_contacts(raw, {.distance_m = 0.2});
  for (BorderOnSurface& border : found.constraints.borders)
    if (raw.entities[border.controller].name == "F1") border.direction = {1, 0, 0};
  const ConstrainedCut result = cut(raw, found.constraints);
  EXPECT_EQ(failures(result), "");
  const std::vector<double> volumes = region_volumes(result.soup);
  ASSERT_EQ(volumes.size(), 4u);
  for (const double volume : volumes) EXPECT_NEAR(volume, 250, 1e-9);
}

/// A controller x = k |y| with a ridge along z, and a triangle whose border edge (k, −1, 0)–(k, 1, 0) should be on it;
/// `apex` is its third corner.
struct Fold {
  TriangleSoup soup;
  ContactConstraints constraints;
  explicit Fold(double k, const Vec3& apex) {
    add_grid(soup, add_patch(soup, "Fault", Role::fault), 4, 1, [&](double u, double v) {
      return Vec3{k * std::abs(4 * u - 2), 4 * u - 2, 4.5 * v - 1};
    });
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    support::add_triangle(soup, add_patch(soup, "Horizon", Role::horizon), {k, -1, 0}, {k, 1, 0}, apex);
    constraints.borders.push_back({.entity = 1, .controller = 0, .points = {first, first + 1}});
  }
};

class FoldedController : public testing::TestWithParam<double> {};

TEST_P(FoldedController, is_followed_over_its_ridge_without_gap_or_overlap) {
  const double k = GetParam();
  const Fold fold(k, {k + 6, 0, 0});
  const ConstrainedCut result = cut(fold.soup, fold.constraints);
  EXPECT_EQ(failures(result), "");
  const std::vector<Vec3> line = support::shared_positions(result.soup, 0, 1);
  // One node per controller edge crossed, and two: edges with their ends on both sides of z = 0 and |y| < 1 there.
  const ContactMesh mesh(fold.soup);
  std::size_t crossed = 0;
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a)
    for (std::uint32_t b = a + 1; b < mesh.vertex_count(); ++b) {
      const Vec3 &p = mesh.point(a), &q = mesh.point(b);
      if (!mesh.has_edge(a, b, 0) || !(p.z * q.z < 0)) continue;
      const double y = p.y + p.z / (p.z - q.z) * (q.y - p.y);
      crossed += std::abs(y) < 1 - 1e-12;
    }
  EXPECT_EQ(line.size(), crossed + 2);
  EXPECT_EQ(result.borders[0].inserted_nodes, crossed);
  EXPECT_TRUE(std::count(line.begin(), line.end(), Vec3{0, 0, 0}));
  for (const Vec3& p : line) {
    EXPECT_NEAR(p.x, k * std::abs(p.y), 1e-15);
    EXPECT_EQ(p.z, 0);
  }
  EXPECT_NEAR(support::shared_length_m(result.soup, 0, 1), 2 * std::hypot(1, k), 1e-14);
  // What lay between the border edge and the fault: a triangle of height k, gap or overlap.
  EXPECT_NEAR(support::area_m2(result.soup, 1), support::area_m2(fold.soup, 1) + k, 1e-13);
  EXPECT_NEAR(support::area_m2(result.soup, 0), support::area_m2(fold.soup, 0), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(BothSigns, FoldedController, testing::Values(0.1, 0.5, 1.0, 2.0, -0.1, -0.5, -1.0, -2.0));

TEST(ConstrainedCut, the_plane_of_a_steep_border_triangle_finds_no_path_or_a_v_where_the_mean_normal_finds_the_line) {
  const Fold steep(0.5, {0.6, 0, -3}), dipping(0.5, {1.5, 0, -2});
  const ConstrainedCut none = cut(steep.soup, steep.constraints, {.guide_plane = GuidePlaneRule::local_dip});
  ASSERT_EQ(none.borders[0].failures.size(), 1u);
  EXPECT_EQ(none.borders[0].failures[0].find("Horizon on Fault: no path"), 0u) << none.borders[0].failures[0];

  const auto highest = [](const ConstrainedCut& result) {
    double z = 0;
    for (const Vec3& p : support::shared_positions(result.soup, 0, 1)) z = std::max(z, p.z);
    return z;
  };
  EXPECT_NEAR(highest(cut(dipping.soup, dipping.constraints, {.guide_plane = GuidePlaneRule::local_dip})), 1.0, 1e-12);
  for (const Fold* fold : {&steep, &dipping}) {
    const ConstrainedCut result = cut(fold->soup, fold->constraints);
    EXPECT_EQ(failures(result), "");
    EXPECT_EQ(highest(result), 0);
    EXPECT_NEAR(support::shared_length_m(result.soup, 0, 1), 2 * std::hypot(1, 0.5), 1e-14);
  }
}

class StoneOffset : public testing::TestWithParam<double> {};

TEST_P(StoneOffset, a_stone_on_fault_2_where_it_ends_on_fault_1_is_one_node_on_three_lines) {
  const double off = GetParam();
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F1", Role::fault), 5, 7, [](double u, double v) { return Vec3{5, 10 * u, 10 * v}; });
  add_grid(soup, add_patch(soup, "F2", Role::fault), 6, 5, [&](double u, double v) {
    return Vec3{5 + off + 5 * u, 5, 0.3 + 9 * v};
  });
  add_grid(soup, add_patch(soup, "H", Role::horizon), 4, 4, [&](double u, double v) {
    return Vec3{5 + 2 * off + 4 * u, 5 + 1.5 * off + 4 * v, 5.1};
  });
  const Result<FoundContacts> named =
      name_contacts(soup, {"H -> F1", "H -> F2", "F2 -> F1", "H.stone -> F2.border"}, FindContactsOptions{});
  ASSERT_TRUE(named) << describe(named.failure());
  ASSERT_EQ(named->constraints.stones.size(), 1u);
  const ConstrainedCut result = cut(soup, named->constraints);
  EXPECT_EQ(failures(result), "");
  const std::vector<Vec3> on_12 = support::shared_positions(result.soup, 0, 1),
                          on_13 = support::shared_positions(result.soup, 0, 2),
                          on_23 = support::shared_positions(result.soup, 1, 2);
  std::vector<Vec3> triple;
  for (const Vec3& p : on_12)
    if (std::count(on_13.begin(), on_13.end(), p) && std::count(on_23.begin(), on_23.end(), p)) triple.push_back(p);
  ASSERT_EQ(triple.size(), 1u);
  EXPECT_EQ(triple[0], (Vec3{5, 5, 5.1}));
  // Every contact is shared along its whole length: no line ends beside another.
  EXPECT_NEAR(support::shared_length_m(result.soup, 0, 1), 9, 1e-12);
  EXPECT_NEAR(support::shared_length_m(result.soup, 0, 2), 4 + 1.5 * off, 1e-12);
  EXPECT_NEAR(support::shared_length_m(result.soup, 1, 2), 4 + 2 * off, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(FromTinyToCoarse, StoneOffset,
                         testing::Values(1e-12, 1e-9, 1e-6, 1e-3, 1e-2, 0.1, 0.3, -1e-3, -0.1));

TEST(ConstrainedCut, a_fault_sealed_on_another_leaves_one_line_for_a_horizon_to_cross) {
  // T junction of Fig 3-34: once the faults share their contact, a horizon meets both in one point of one edge.
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F2", Role::fault), 5, 7, [](double u, double v) {
    return Vec3{5 + 0.3 * std::sin(7 * u), 10 * u, 10 * v};
  });
  add_grid(soup, add_patch(soup, "F1", Role::fault), 6, 4, [](double u, double v) {
    return Vec3{5.4 + 4 * u, 5.2, 10 * v};
  });
  const Result<FoundContacts> named = name_contacts(soup, {"F1 -> F2"}, FindContactsOptions{});
  ASSERT_TRUE(named);
  const ConstrainedCut result = cut(soup, named->constraints);
  EXPECT_EQ(failures(result), "");
  const ContactMesh mesh(result.soup);
  for (const double z : {0.13, 3.3, 5.01, 9.9}) {
    std::size_t crossed = 0;
    for (const std::uint32_t t : mesh.triangles_of(1))
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangle(t)[k], b = mesh.triangle(t)[(k + 1) % 3];
        if (!mesh.has_edge(a, b, 0) || !((mesh.point(a).z - z) * (mesh.point(b).z - z) < 0)) continue;
        ++crossed;
        EXPECT_EQ(mesh.count_at(a, b, 0), 2u);
        EXPECT_EQ(mesh.count_at(a, b, 1), 1u);
      }
    EXPECT_EQ(crossed, 1u) << z;
  }
}

TEST(ConstrainedCut, a_slit_around_a_dying_fault_ends_on_its_tip) {
  // Fig 1-23 and 3-15: two lips with a throw that dies out, on a fault that ends inside the horizon.
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F", Role::fault), 4, 4, [](double u, double v) {
    return Vec3{5, 6.3 * u, 3 + 4 * v};
  });
  const std::uint32_t horizon = add_patch(soup, "H", Role::horizon);
  const auto lip_z = [](double x, double y) { return 5 + (y < 6 ? (x < 5 ? 0.1 : -0.1) * (6 - y) : 0.0); };
  add_grid(soup, horizon, 4, 5, [&](double u, double v) {
    return Vec3{4.9 * u + (v > 0.55 ? 0.1 * u : 0), 10 * v, lip_z(4.9 * u, 10 * v)};
  });
  add_grid(soup, horizon, 4, 5, [&](double u, double v) {
    return Vec3{5 + (v > 0.55 ? 0.0 : 0.1 * (1 - u)) + 5 * u, 10 * v, lip_z(5.1, 10 * v)};
  });
  const FoundContacts found = find_contacts(soup, {.distance_m = 0.4});
  ASSERT_EQ(found.constraints.borders.size(), 2u);
  ASSERT_EQ(found.constraints.stones.size(), 1u);
  const ConstrainedCut result = cut(soup, found.constraints);
  EXPECT_EQ(failures(result), "");
  const std::vector<Vec3> shared = support::shared_positions(result.soup, 0, 1);
  std::size_t at_tip = 0;
  for (const Vec3& p : shared) at_tip += p.y == 6.3;
  EXPECT_EQ(at_tip, 1u);  // both lips end in one node of the fault's border
  const Result<BuiltModel> built = build_structural_model(result.soup);
  ASSERT_TRUE(built);
  for (const Violation& v : check_validity(*built).violations) EXPECT_NE(v.kind, "improper_intersection") << v.what;
}

TEST(ConstrainedCut, impacts_near_a_vertex_or_an_edge_of_the_controller_are_on_it) {
  TriangleSoup soup;
  const std::uint32_t fault = add_patch(soup, "F", Role::fault);
  support::add_quad(soup, fault, {0, 0, 0}, {0, 4, 0}, {0, 4, 4}, {0, 0, 4});  // its diagonal is y = z
  const std::uint32_t horizon = add_patch(soup, "H", Role::horizon);
  const auto first = add_grid(soup, horizon, 2, 1, [](double u, double v) {
    const std::array<Vec3, 3> border{Vec3{0.1, 1e-4, 1e-4}, Vec3{0.1, 2, 2 + 1e-4}, Vec3{0.1, 3.5, 3}};
    return border[static_cast<std::size_t>(2 * u)] + Vec3{v, 0, 0};
  });
  ContactConstraints constraints;
  constraints.borders.push_back(
      {.entity = 1, .controller = 0, .points = {first, first + 1, first + 2}, .direction = {1, 0, 0}});
  const ConstrainedCut result = cut(soup, constraints, {.tolerance_m = 1e-3});
  EXPECT_EQ(failures(result), "");
  const std::vector<Vec3> shared = support::shared_positions(result.soup, 0, 1);
  ASSERT_EQ(shared.size(), 3u);
  EXPECT_EQ(shared[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(shared[1].x, 0);
  EXPECT_NEAR(shared[1].y, shared[1].z, 1e-15);
  EXPECT_EQ(shared[2], (Vec3{0, 3.5, 3}));
  // With a finer tolerance the same impacts are places of their own.
  EXPECT_NEAR(support::shared_positions(cut(soup, constraints, {.tolerance_m = 1e-6}).soup, 0, 1)[0].y, 1e-4, 1e-12);
}

TEST(ConstrainedCut, a_controller_in_two_pieces_has_no_path_and_is_named) {
  TriangleSoup soup;
  soup.local_origin = {1000, 0, 0};
  const std::uint32_t fault = add_patch(soup, "F1", Role::fault);
  support::add_quad(soup, fault, {0, 0, 0}, {0, 1, 0}, {0, 1, 4}, {0, 0, 4});
  support::add_quad(soup, fault, {0, 3, 0}, {0, 4, 0}, {0, 4, 4}, {0, 3, 4});
  const std::uint32_t horizon = add_patch(soup, "H1", Role::horizon);
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  support::add_quad(soup, horizon, {0.1, 0.5, 2.2}, {0.1, 3.5, 2.2}, {2, 3.5, 2.2}, {2, 0.5, 2.2});
  ContactConstraints constraints;
  constraints.borders.push_back({.entity = 1, .controller = 0, .points = {first, first + 1}});
  const ConstrainedCut result = cut(soup, constraints);
  ASSERT_EQ(result.borders[0].failures.size(), 1u);
  EXPECT_EQ(result.borders[0].failures[0], "H1 on F1: no path on it from (1000.0, 0.5, 2.2) to (1000.0, 3.5, 2.2)");
}

TEST(ConstrainedCut, contacts_in_a_circle_are_named_and_still_made) {
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F1", Role::fault), 3, 3, [](double u, double v) {
    return Vec3{0.1 + 4 * u, 0, 4 * v};
  });
  add_grid(soup, add_patch(soup, "F2", Role::fault), 3, 3, [](double u, double v) {
    return Vec3{0, 0.1 + 4 * u, 4 * v};
  });
  const Result<FoundContacts> named = name_contacts(soup, {"F1 -> F2", "F2 -> F1"}, FindContactsOptions{});
  ASSERT_TRUE(named);
  const ConstrainedCut result = cut(soup, named->constraints);
  EXPECT_EQ(failures(result), "contacts in a circle: F1 -> F2 -> F1\n");
  EXPECT_NEAR(support::shared_length_m(result.soup, 0, 1), 4, 1e-12);
}

TEST(ConstrainedCut, a_border_that_overshoots_by_more_than_a_row_of_triangles_is_left_and_named) {
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F1", Role::fault), 2, 2, [](double u, double v) { return Vec3{0, 4 * u, 4 * v}; });
  add_grid(soup, add_patch(soup, "H1", Role::horizon), 8, 2, [](double u, double v) {
    return Vec3{-0.9 + 4 * u, 1 + 2 * v, 2.1};
  });
  const Result<FoundContacts> named = name_contacts(soup, {"H1 -> F1"}, FindContactsOptions{});
  ASSERT_TRUE(named);
  EXPECT_TRUE(named->gaps[0].overshoots);
  const ConstrainedCut result = cut(soup, named->constraints);
  ASSERT_FALSE(result.borders[0].failures.empty());
  EXPECT_EQ(result.borders[0].failures[0].find("H1 on F1: it overshoots by more than its last triangles"), 0u);
  EXPECT_EQ(result.soup.triangles.size(), soup.triangles.size());
}

TEST(ConstrainedCut, borders_that_coincide_get_the_same_nodes) {
  // A horizon and an onlap surface end in one border; only the horizon's is constrained.
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F1", Role::fault), 5, 3, [](double u, double v) {
    return Vec3{0.05 * std::sin(9 * u), 4 * u, 4 * v};
  });
  add_grid(soup, add_patch(soup, "H1", Role::horizon), 2, 2, [](double u, double v) {
    return Vec3{0.2 + 2 * u, 1 + 2 * v, 2.1};
  });
  add_grid(soup, add_patch(soup, "H2", Role::horizon), 2, 2, [](double u, double v) {
    return Vec3{0.2 + 2 * u, 1 + 2 * v, 2.1 + u};
  });
  const Result<FoundContacts> named = name_contacts(soup, {"H1 -> F1"}, FindContactsOptions{});
  ASSERT_TRUE(named);
  const ConstrainedCut result = cut(soup, named->constraints);
  EXPECT_EQ(failures(result), "");
  EXPECT_GT(result.borders[0].inserted_nodes, 0u);
  const double contact_m = support::shared_length_m(result.soup, 0, 1);
  EXPECT_GE(contact_m, 2);
  EXPECT_NEAR(support::shared_length_m(result.soup, 0, 2), contact_m, 1e-14);
}

TEST(ConstrainedCut, properties_and_records_follow_their_points) {
  TriangleSoup soup = raw_box(0.1, 4);
  PointProperty x{"x", "m", 1, {}};
  for (const Vec3& p : soup.points) x.values.push_back(p.x);
  soup.properties = {x};
  soup.border_stones = {0, 10};
  const ConstrainedCut result = cut(soup, found_in(soup, 0.2));
  ASSERT_EQ(result.soup.properties.size(), 1u);
  ASSERT_EQ(result.soup.properties[0].values.size(), result.soup.points.size());
  for (std::size_t i = 0; i < result.soup.points.size(); ++i)
    EXPECT_NEAR(result.soup.properties[0].values[i], result.soup.points[i].x, 0.11);  // borders keep what they had
  EXPECT_EQ(result.soup.border_stones.size(), 2u);
  EXPECT_EQ(result.soup.entities.size(), soup.entities.size());
}

TEST(ConstrainedCut, indices_out_of_range_and_contacts_with_itself_are_refused) {
  const TriangleSoup soup = raw_box(0.1, 1);
  ContactConstraints wrong;
  wrong.borders.push_back({.entity = 7, .controller = 0, .points = {0, 1}});
  EXPECT_EQ(cut_constrained(soup, wrong).failure().code, FailureCode::invalid_input);
  wrong.borders = {{.entity = 1, .controller = 1, .points = {0, 1}}};
  EXPECT_EQ(cut_constrained(soup, wrong).failure().what, "a contact of F1 with itself");
  wrong.borders = {{.entity = 1, .controller = 0, .points = {0, 100000}}};
  EXPECT_FALSE(cut_constrained(soup, wrong));
}

TEST(ConstrainedCut, is_the_same_to_the_bit_on_every_schedule) {
  const TriangleSoup raw = *generate_reference_model("A4", {.resolution_m = 90, .raw_ratio = 0.005});
  const auto digest = [&] { return digest_of(archived(cut(raw, found_in(raw, 8)).soup)); };
  const Digest expected = digest();
  support::on_every_schedule([&](const char* schedule) { EXPECT_EQ(digest(), expected) << schedule; }, 3);
}

class RawReferenceModel : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(RawReferenceModel, is_sealed_by_its_contacts_alone) {
  const auto [name, ratio] = GetParam();
  const double resolution_m = std::string_view(name) == "D" ? 8 : 60;
  const Result<TriangleSoup> sealed = generate_reference_model(name, {.resolution_m = resolution_m, .raw_ratio = {}});
  const Result<TriangleSoup> raw = generate_reference_model(name, {.resolution_m = resolution_m, .raw_ratio = ratio});
  ASSERT_TRUE(sealed && raw);
  const ConstrainedCut result = cut(*raw, found_in(*raw, 2400 * std::abs(ratio)));
  EXPECT_EQ(failures(result), "");
  const std::vector<double> expected = region_volumes(*sealed), volumes = region_volumes(result.soup);
  ASSERT_EQ(volumes.size(), expected.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) EXPECT_NEAR(volumes[i], expected[i], 2e-3 * expected[i]);
  const Result<BuiltModel> built = build_structural_model(result.soup);
  for (const Violation& v : check_validity(*built).violations) EXPECT_EQ(v.kind, "dangling_surface") << v.what;
}

TEST(ConstrainedCut, turned_and_far_away_models_are_sealed_alike) {
  for (const char* name : {"A2", "A4", "C"}) {
    TriangleSoup raw = *generate_reference_model(name, {.resolution_m = 60, .raw_ratio = -1e-3});
    const std::size_t regions =
        region_volumes(*generate_reference_model(name, {.resolution_m = 60, .raw_ratio = {}})).size();
    const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
    for (Vec3& p : raw.points) {
      p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
      p = Vec3{p.x, c * p.y - s * p.z, s * p.y + c * p.z} + Vec3{5e6, 5e6, 0};
    }
    const ConstrainedCut result = cut(raw, found_in(raw, 2.4));
    EXPECT_EQ(failures(result), "") << name;
    EXPECT_EQ(region_volumes(result.soup).size(), regions) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(GapsAndOvershoots, RawReferenceModel,
                         testing::Combine(testing::Values("A1", "A2", "A3", "A4", "B", "C", "D"),
                                          testing::Values(1e-6, 1e-3, 1e-2, -1e-6, -1e-3, -1e-2)));
INSTANTIATE_TEST_SUITE_P(Branch, RawReferenceModel,
                         testing::Combine(testing::Values("A5"), testing::Values(1e-6, 1e-3, 1e-2)));

}  // namespace
}  // namespace strataflow
