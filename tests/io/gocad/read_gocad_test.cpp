#include "io/gocad/read_gocad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "io/gocad/gocad_header.h"
#include "io/gocad/gocad_reader.h"
#include "io/gocad/gocad_vertices.h"
#include "io/input_samples.h"

namespace strataflow {
namespace {

using ::testing::HasSubstr;

std::string sample(const std::string& name) { return support::text_of(support::own_sample("gocad/" + name)); }

InputData read_well(const std::string& text, const std::string& name = "model.ml") {
  Result<InputData> input = read_gocad(text, name);
  EXPECT_TRUE(input) << (input ? "" : describe(input.failure()));
  return input ? std::move(*input) : InputData{};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expect_failure(const std::string& text, const std::string& what, FailureCode code = FailureCode::malformed_file) {
  const Result<InputData> input = read_gocad(text, "file.ml");
  ASSERT_FALSE(input) << "expected: " << what;
  EXPECT_EQ(input.failure().code, code) << describe(input.failure());
  EXPECT_THAT(input.failure().what, HasSubstr(what));
  EXPECT_THAT(input.failure().what, HasSubstr("file.ml:"));
  EXPECT_FALSE(input.failure().remedy.empty());
}

/// Six times the volume inside the triangles of a patch, seen from the origin.
double six_volumes(const TriangleSoup& s, std::uint32_t patch) {
  double sum = 0;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    if (s.triangle_patch[t] == patch)
      sum += dot(s.points[s.triangles[t][0]], cross(s.points[s.triangles[t][1]], s.points[s.triangles[t][2]]));
  return sum;
}

TEST(ReadGocad, numbers_patches_by_the_table_even_when_tsurfs_are_shuffled) {
  const InputData data = read_well(sample("two_layers.ml"));  // the TSurf "middle" comes before "box"
  const TriangleSoup& s = data.surfaces;
  ASSERT_EQ(s.entities.size(), 2u);
  EXPECT_EQ(s.entities[0].name, "box");
  EXPECT_EQ(s.entities[0].role, Role::boundary);
  EXPECT_EQ(s.entities[1].name, "middle");
  EXPECT_EQ(s.entities[1].role, Role::horizon);
  EXPECT_EQ(s.patch_entity, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(s.triangle_patch, (std::vector<std::uint32_t>{2, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(s.points.size(), 3u + 9u + 3u) << "an atom of a TSurf is a copy of its vertex";
  EXPECT_TRUE(data.warnings.empty());
}

TEST(ReadGocad, depth_becomes_z_up_and_the_order_of_vertices_stays) {
  const std::string depth = sample("two_layers.ml");
  std::string elevation = depth;
  for (std::size_t at; (at = elevation.find("ZPOSITIVE Depth")) != std::string::npos;)
    elevation.replace(at, 15, "ZPOSITIVE Elevation");
  const InputData up = read_well(elevation);
  const InputData down = read_well(depth);
  ASSERT_EQ(up.surfaces.points.size(), down.surfaces.points.size());
  for (std::size_t i = 0; i < up.surfaces.points.size(); ++i)
    EXPECT_EQ(down.surfaces.points[i].z, -up.surfaces.points[i].z);
  for (std::uint32_t patch = 0; patch < 3; ++patch)
    EXPECT_EQ(six_volumes(down.surfaces, patch), -six_volumes(up.surfaces, patch)) << "mirrored, not turned over";
  EXPECT_FALSE(std::signbit(down.surfaces.points[3].z)) << "no negative zeros";
}

TEST(ReadGocad, keeps_region_layer_and_border_records) {
  const TriangleSoup s = read_well(sample("two_layers.ml")).surfaces;
  ASSERT_EQ(s.regions.size(), 3u);
  EXPECT_EQ(s.regions[0].name, "Universe");
  EXPECT_EQ(s.regions[2].name, "Lower");
  ASSERT_EQ(s.regions[2].sides.size(), 2u);
  EXPECT_EQ(s.regions[2].sides[0].patch, 1u);
  EXPECT_EQ(s.regions[2].sides[0].is_positive, 1);
  EXPECT_EQ(s.regions[2].sides[1].patch, 2u);
  EXPECT_EQ(s.regions[2].sides[1].is_positive, 0);
  ASSERT_EQ(s.layers.size(), 1u);
  EXPECT_EQ(s.layers[0].name, "all");
  EXPECT_EQ(s.layers[0].regions, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(s.border_stones, (std::vector<std::uint32_t>{0, 6, 9})) << "vertex 7 of box is a copy of vertex 4";
  ASSERT_EQ(s.border_starts.size(), 3u);
  EXPECT_EQ(s.border_starts[0], (std::array<std::uint32_t, 2>{0, 1}));
}

TEST(ReadGocad, reads_vertex_properties_with_sizes_units_and_no_data) {
  for (const char* name : {"properties.ts", "crlf.ts"}) {
    const InputData data = read_well(sample(name), name);
    const TriangleSoup& s = data.surfaces;
    ASSERT_EQ(s.properties.size(), 2u) << name;
    EXPECT_EQ(s.properties[0].name, "my prop");
    EXPECT_EQ(s.properties[0].unit, "m");
    EXPECT_EQ(s.properties[1].width, 3u);
    ASSERT_EQ(s.points.size(), 6u) << "an atom is a point of its own";
    EXPECT_EQ(s.points[3], s.points[1]);
    EXPECT_EQ(s.points[0].x, 461000.672);
    EXPECT_EQ(s.points[4], s.points[0]);
    EXPECT_EQ(s.points[5].z, 1e-3);
    EXPECT_EQ(s.properties[0].values[0], 0.5);
    EXPECT_TRUE(std::isnan(s.properties[0].values[1])) << "no data";
    EXPECT_TRUE(std::isnan(s.properties[0].values[2])) << "a VRTX carries none";
    EXPECT_EQ(s.properties[0].values[3], 7.5);
    EXPECT_TRUE(std::isnan(s.properties[0].values[4])) << "a plain ATOM carries none";
    EXPECT_TRUE(std::isnan(s.properties[1].values[4])) << "-1 is no data of the second property";
    EXPECT_EQ(s.entities[0].name, "Top Reservoir");
    EXPECT_EQ(s.patch_entity.size(), 2u);
    EXPECT_EQ(s.triangles[1], (Triangle{3, 4, 5}));
    ASSERT_EQ(data.warnings.size(), 1u);
    EXPECT_EQ(data.warnings[0].kind, "unit_not_metre");
  }
}

TEST(ReadGocad, reads_lines_points_and_wells_and_names_what_it_skips) {
  const InputData data = read_well(sample("objects.gocad"), "objects.gocad");
  ASSERT_EQ(data.lines.size(), 3u);
  EXPECT_TRUE(data.lines[0].is_closed);
  EXPECT_EQ(data.lines[0].points.size(), 3u);
  EXPECT_FALSE(data.lines[1].is_closed);
  EXPECT_EQ(data.lines[1].points.size(), 2u);
  EXPECT_EQ(data.lines[2].role, Role::well);
  EXPECT_EQ(data.lines[2].name, "W-1");
  EXPECT_EQ(data.lines[2].points[1], (Vec3{1001, 2002, -75}));
  ASSERT_EQ(data.point_sets.size(), 1u);
  EXPECT_EQ(data.point_sets[0].name, "picks");
  EXPECT_EQ(data.point_sets[0].properties.at(0).values[0], 4);
  EXPECT_TRUE(std::isnan(data.point_sets[0].properties.at(0).values[1]));
  ASSERT_EQ(data.warnings.size(), 2u);
  EXPECT_EQ(data.warnings[0].kind, "skipped_record");
  EXPECT_EQ(data.warnings[1].kind, "skipped_object");
  EXPECT_THAT(data.warnings[1].what, HasSubstr("Voxet 'cube'"));
}

TEST(ReadGocad, a_line_breaks_where_its_segments_break_and_tells_of_loose_vertices) {
  const InputData data = read_well(
      "GOCAD PLine 1\nHEADER {\nname:l\n}\nILINE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 2 0 0\nVRTX 4 3 0 0\nVRTX 5 4 0 "
      "0\n"
      "SEG 1 2\nSEG 3 4\nEND\n");
  ASSERT_EQ(data.lines.size(), 2u);
  EXPECT_EQ(data.lines[1].points[0].x, 2);
  ASSERT_EQ(data.warnings.size(), 1u);
  EXPECT_EQ(data.warnings[0].kind, "unconnected_vertices");
}

double six_volume(const VolumeMesh& mesh, std::size_t cell) {
  const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[cell]];
  const Vec3& p = mesh.points[v[0]];
  return dot(mesh.points[v[1]] - p, cross(mesh.points[v[2]] - p, mesh.points[v[3]] - p));
}

TEST(ReadGocad, reads_a_solid_with_regions_surfaces_and_positive_cells) {
  for (const bool is_depth : {true, false}) {
    const std::string text = sample("solid.so");
    const InputData data = read_well(is_depth ? text : replaced(text, "Depth", "Elevation"), "solid.so");
    const VolumeMesh& mesh = data.volume;
    ASSERT_EQ(mesh.cell_count(), 2u);
    EXPECT_EQ(mesh.points.size(), 5u);
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"left", "right"}));
    EXPECT_EQ(mesh.cell_region, (std::vector<std::int32_t>{0, 1}));
    for (std::size_t c = 0; c < 2; ++c) EXPECT_GT(six_volume(mesh, c), 0) << is_depth;
    EXPECT_EQ(data.surfaces.triangles.size(), 3u);
    EXPECT_EQ(data.surfaces.points.size(), 4u) << "only what the surfaces use";
    EXPECT_EQ(data.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(data.surfaces.entities[0].name, "skin 1");
  }
}

TEST(ReadGocad, a_cell_that_differs_from_the_majority_stays_inverted) {
  std::string text = sample("solid.so");
  text = replaced(text, "MODEL\n", "TETRA 1 2 4 3\nTETRA 1 2 3 4\nMODEL\n");  // one against three
  const VolumeMesh mesh = read_well(text).volume;
  int positive = 0;
  for (std::size_t c = 0; c < 4; ++c) positive += six_volume(mesh, c) > 0;
  EXPECT_EQ(positive, 3);
  EXPECT_LT(six_volume(mesh, 2), 0);
}

TEST(ReadGocad, a_tsurf_without_header_or_coordinate_system_reads) {
  const InputData data =
      read_well("GOCAD TSurf 1\nVRTX 10 0 0 0\nVRTX 5000000000 1 0 0\nVRTX 7 0 1 0\nTRGL 10 5000000000 7\nEND", "s.ts");
  EXPECT_EQ(data.surfaces.entities.at(0).name, "s") << "the file's name without its ending";
  EXPECT_EQ(data.surfaces.triangles.at(0), (Triangle{0, 1, 2}));
}

TEST(ReadGocad, an_object_without_a_name_is_called_like_its_file) {
  const std::string nameless = "GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
  EXPECT_EQ(read_well(nameless, "faults.tar.gz/in/F-1.2.ts.gz").surfaces.entities.at(0).name, "F-1.2");
  EXPECT_EQ(read_well(nameless, ".ts").surfaces.entities.at(0).name, ".ts");
}

TEST(ReadGocad, tsurfs_of_one_name_share_an_entity) {
  const std::string one =
      "GOCAD TSurf 1\nHEADER {\nname: a\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
  const TriangleSoup s = read_well(one + one + replaced(one, "name: a", "name: b")).surfaces;
  EXPECT_EQ(s.entities.size(), 2u);
  EXPECT_EQ(s.patch_entity, (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(ReadGocad, names_every_kind_of_damage_with_its_line) {
  const std::string model = sample("two_layers.ml");
  expect_failure("", "no GOCAD object");
  expect_failure("\n \n# only a comment\n", "no GOCAD object");
  expect_failure("solid cube\n", "expected 'GOCAD <kind>', found 'solid'");
  expect_failure(std::string("\0\x01\x02 binary", 10), "expected 'GOCAD <kind>'");
  expect_failure(replaced(model, "VRTX 2 1 0 1", "VRTX 2 nan 0 1"),
                 "file.ml:47: a position needs three finite numbers");
  expect_failure(replaced(model, "VRTX 2 1 0 1", "VRTX 2 1 -inf 1"), "three finite numbers");
  expect_failure(replaced(model, "VRTX 2 1 0 1", "VRTX 2 1 0 1e999"), "three finite numbers");
  expect_failure(replaced(model, "VRTX 2 1 0 1", "VRTX 2 1 0"), "three finite numbers");
  expect_failure(replaced(model, "VRTX 2 1 0 1", "VRTX x 1 0 1"), "a vertex needs an id");
  expect_failure(replaced(model, "VRTX 2 1 0 1", "VRTX 1 1 0 1"), "vertex 1 is there twice");
  expect_failure(replaced(model, "TRGL 1 2 3", "TRGL 1 2 99"), "there is no vertex '99' in 'middle'");
  expect_failure(replaced(model, "TRGL 1 2 3", "TRGL 1 2"), "a vertex id is missing");
  expect_failure(replaced(model, "TRGL 1 2 3", "TRGL 1 2 -3"), "there is no vertex '-3'");
  expect_failure(replaced(model, "ATOM 7 4", "ATOM 7 70"), "there is no vertex '70'");
  expect_failure(replaced(model, "BSTONE 1", "BSTONE 44"), "there is no vertex '44'");
  expect_failure(replaced(model, "BORDER 4 1 2", "BORDER 4 1"), "a vertex id is missing");
  expect_failure(replaced(model, "+2  -3  0", "+2  -9  0"), "names TFACE -9");
  expect_failure(replaced(model, "+2  -3  0", "+2  -9223372036854775808  0"), "not in the table");
  expect_failure(replaced(model, "  +2  -3  0", "  +2  -3"), "found 'LAYER'");
  expect_failure(replaced(model, "LAYER all\n  5  6", "LAYER all\n  5  7"), "names region 7");
  expect_failure(replaced(model, "TFACE 3  top", "TFACE 2  top"), "TFACE 2 is there twice");
  expect_failure(replaced(model, "REGION 6", "REGION 5"), "REGION 5 is there twice");
  expect_failure(replaced(model, "BORDER 4 1 2\nEND\n", ""), "has no END");
  expect_failure(model.substr(0, model.find("GOCAD TSurf 1\nHEADER {\nname:box")), "has no triangles");
  expect_failure("GOCAD TSurf 1\nHEADER {\nname: a\nTFACE\nEND\n", "block opened here is never closed");
  expect_failure("GOCAD TSurf 1\nEND\n", "no triangle");
  expect_failure("GOCAD TSurf 1\nPROPERTIES p\nESIZES 4000000000\nEND\n", "ESIZES");
  expect_failure(replaced(sample("properties.ts"), "7.5 1 0 0", "7.5 1"), "lacks values of property normal");
  expect_failure("GOCAD Voxet 1\nHEADER {\nname: cube\n}\nEND\n", "Voxet 'cube'", FailureCode::unsupported);
}

TEST(ReadGocad, a_file_cut_at_any_byte_fails_by_name_or_holds_whole_objects) {
  for (const char* name : {"two_layers.ml", "properties.ts", "objects.gocad", "solid.so", "crlf.ts"}) {
    const std::string text = sample(name);
    for (std::size_t size = 0; size < text.size(); ++size) {
      const Result<InputData> input = read_gocad(text.substr(0, size), name);
      if (!input) {
        EXPECT_THAT(input.failure().what, HasSubstr(std::string(name) + ":")) << size;
      } else {
        EXPECT_EQ(text.substr(0, size).substr(text.substr(0, size).find_last_of('E')).substr(0, 3), "END")
            << name << " cut at " << size;
      }
    }
    for (int tenth = 1; tenth < 10; ++tenth)
      EXPECT_FALSE(read_gocad(text.substr(0, text.size() * tenth / 10), name)) << name << " at " << tenth << " tenths";
  }
}

TEST(ReadGocad, huge_declared_counts_and_ids_cost_no_memory) {
  std::string text = "GOCAD TSurf 1\nPROPERTIES";
  for (int i = 0; i < 2000; ++i) text += " p" + std::to_string(i);
  text += "\nESIZES";
  for (int i = 0; i < 2000; ++i) text += " 4096";
  text +=
      "\nTFACE\nVRTX 18446744073709551615 0 0 0\nVRTX 9999999999 1 0 0\nVRTX 2 0 1 0\nTRGL 18446744073709551615 "
      "9999999999 2\nEND\n";
  const InputData data = read_well(text);
  EXPECT_EQ(data.surfaces.points.size(), 3u);
  EXPECT_TRUE(data.surfaces.properties.empty()) << "no vertex brought a value";
}

TEST(GocadHeader, kinds_map_to_roles_and_back) {
  for (const Role role : {Role::fault, Role::horizon, Role::unconformity, Role::boundary, Role::intrusion})
    EXPECT_EQ(role_from_gocad(gocad_kind_of(role)), role);
  EXPECT_EQ(role_from_gocad("reverse_fault"), Role::fault);
  EXPECT_EQ(role_from_gocad("none"), Role::horizon);
  EXPECT_EQ(role_from_gocad("intraformational"), Role::horizon);
  EXPECT_EQ(role_from_gocad("something"), Role::unknown);
}

TEST(GocadVertices, ids_may_be_dense_sparse_and_in_any_order_but_not_repeated) {
  GocadVertexIds ids;
  std::uint32_t point = 0;
  for (const std::uint64_t id : {5000ull, 3ull, 18446744073709551615ull, 1023ull, 0ull})
    EXPECT_TRUE(ids.add(id, point++));
  for (std::uint64_t id = 4; id < 1000; ++id) EXPECT_TRUE(ids.add(id, point++));
  for (const std::uint64_t id : {5000ull, 3ull, 18446744073709551615ull, 500ull}) EXPECT_FALSE(ids.add(id, 0));
  EXPECT_EQ(ids.find(5000), 0u);
  EXPECT_EQ(ids.find(18446744073709551615ull), 2u);
  EXPECT_EQ(ids.find(4), 5u);
  EXPECT_EQ(ids.find(4999), GocadVertexIds::unknown);
}

// ---- real models

InputData read_shared(const std::string& name) {
  return read_well(support::text_of(support::shared_data() / name), std::filesystem::path(name).filename().string());
}

std::size_t distinct_points(const std::vector<Vec3>& points) {
  std::set<std::tuple<double, double, double>> seen;
  for (const Vec3& p : points) seen.insert({p.x, p.y, p.z});
  return seen.size();
}

TEST(ReadGocadRealModels, model3d_files_have_their_known_counts) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  struct Known {
    const char* file;
    std::size_t entities, patches, vertices, triangles, regions;
  };
  for (const Known& known :
       {Known{"ringmesh-tiny/geomodel3d_only.ml", 10, 41, 151, 379, 8},
        Known{"ringmesh-tiny/split_cube.ml", 2, 3, 12, 22, 2}, Known{"ringmesh-tiny/non_split_cube.ml", 2, 2, 0, 0, 1},
        Known{"ringmesh-tiny/not_sealed_cube.ml", 6, 6, 0, 0, 0}, Known{"ringmesh-A1/modelA1.ml", 9, 21, 3602, 7932, 4},
        Known{"ringmesh-A2/modelA2.ml", 6, 61, 6530, 16346, 12},
        Known{"ringmesh-A4/modelA4.ml", 11, 55, 23438, 48903, 8},
        Known{"cloudspin/CloudSpin.ml", 22, 115, 14524, 30751, 7},
        Known{"cloudspin/CloudSpin_fixed.ml", 22, 115, 14524, 30751, 7}}) {
    const InputData data = read_shared(known.file);
    const TriangleSoup& s = data.surfaces;
    EXPECT_EQ(s.entities.size(), known.entities) << known.file;
    EXPECT_EQ(s.patch_entity.size(), known.patches) << known.file;
    EXPECT_EQ(s.regions.size(), known.regions + 1) << known.file << " (with Universe)";
    if (known.triangles == 0) continue;
    EXPECT_EQ(s.triangles.size(), known.triangles) << known.file;
    EXPECT_EQ(distinct_points(s.points), known.vertices) << known.file;
    const std::set<std::uint32_t> used(s.triangle_patch.begin(), s.triangle_patch.end());
    EXPECT_EQ(used.size(), known.patches) << known.file << ": every patch has triangles";
    for (const Entity& entity : s.entities) EXPECT_NE(entity.role, Role::unknown) << known.file << " " << entity.name;
  }
}

TEST(ReadGocadRealModels, normals_point_into_the_region_on_the_positive_side_in_depth_and_elevation_files) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  for (const char* name : {"ringmesh-A1/modelA1.ml", "cloudspin/CloudSpin_fixed.ml"}) {
    const TriangleSoup s = read_shared(name).surfaces;
    ASSERT_GT(s.regions.size(), 2u);
    const Vec3 reference = s.points[0];
    std::vector<double> inside(s.patch_entity.size());  // volume between a patch and the reference point
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      const auto& [a, b, c] = s.triangles[t];
      inside[s.triangle_patch[t]] +=
          dot(s.points[a] - reference, cross(s.points[b] - reference, s.points[c] - reference)) / 6;
    }
    std::vector<double> volumes;
    for (const RegionRecord& region : s.regions) {
      double sum = 0;
      for (const PatchSide& side : region.sides) sum += (side.is_positive ? -1 : 1) * inside[side.patch];
      volumes.push_back(sum);
      EXPECT_EQ(sum > 0, region.name != "Universe") << name << " " << region.name;
    }
    const double all = std::accumulate(volumes.begin() + 1, volumes.end(), 0.0);
    EXPECT_NEAR(all, -volumes[0], 1e-9 * all) << name << ": regions fill the model";
  }
}

TEST(ReadGocadRealModels, layers_and_faults_of_a4_are_known) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  const InputData data = read_shared("ringmesh-A4/modelA4.ml");
  EXPECT_EQ(data.surfaces.layers.size(), 4u);
  EXPECT_EQ(data.surfaces.properties.size(), 5u);
  EXPECT_EQ(data.surfaces.border_starts.size(), 256u);
  std::size_t faults = 0;
  std::size_t horizons = 0;
  for (const Entity& entity : data.surfaces.entities) {
    faults += entity.role == Role::fault;
    horizons += entity.role == Role::horizon;
  }
  EXPECT_EQ(faults, 2u);
  EXPECT_EQ(horizons, 3u);
}

TEST(ReadGocadRealModels, solids_have_their_known_counts_volumes_and_no_inverted_cell) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  struct Known {
    const char* file;
    std::size_t points, cells, regions, surface_triangles, patches, entities;
    double volume;
  };
  for (const Known& known :
       {Known{"ringmesh-tiny/box_tsolid_with_model.so", 8, 6, 1, 12, 6, 6, 1},
        Known{"ringmesh-tiny/cube_model_equi.so", 54, 112, 2, 116, 11, 7, 0},
        Known{"ringmesh-tiny/solid_surf_inside.so", 157, 454, 1, 0, 0, 0, 0},
        Known{"ringmesh-tiny/geomodel3d_with_volume_mesh.so", 180, 630, 8, 379, 41, 10, 1545451.485407},
        Known{"ringmesh-A4/modelA4.so", 6691, 34540, 8, 10049, 55, 11, 7.762286e11},
        Known{"gocad-formats/test.lso", 313, 1247, 4, 581, 23, 4, 0}}) {
    const InputData data = read_shared(known.file);
    EXPECT_EQ(data.volume.points.size(), known.points) << known.file;
    EXPECT_EQ(data.volume.cell_count(), known.cells) << known.file;
    EXPECT_EQ(data.volume.region_names.size(), known.regions) << known.file;
    double sum = 0;
    for (std::size_t c = 0; c < data.volume.cell_count(); ++c) {
      const double v = six_volume(data.volume, c);
      EXPECT_GT(v, 0) << known.file << " cell " << c;
      sum += v / 6;
      EXPECT_GE(data.volume.cell_region[c], 0) << known.file;
    }
    if (known.volume > 0) {
      EXPECT_NEAR(sum, known.volume, 1e-6 * known.volume) << known.file;
    }
    if (known.patches == 0) continue;
    EXPECT_EQ(data.surfaces.triangles.size(), known.surface_triangles) << known.file;
    EXPECT_EQ(data.surfaces.patch_entity.size(), known.patches) << known.file;
    EXPECT_EQ(data.surfaces.entities.size(), known.entities) << known.file;
  }
}

TEST(ReadGocadRealModels, small_files_of_every_kind_have_their_known_counts) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  struct Known {
    const char* file;
    std::size_t points, triangles, patches, entities;
  };
  for (const Known& known : {Known{"surf2d.ts", 46, 46, 3, 1}, Known{"surf2d_multi.ts", 92, 92, 6, 1},
                             Known{"2triangles.ts", 4, 2, 1, 1}, Known{"ts-2props.ts", 4, 2, 1, 1},
                             Known{"sgrid_tsurf.ts", 4, 2, 1, 1}, Known{"Fault_without_crs.ts", 189, 324, 1, 1}}) {
    const TriangleSoup s = read_shared(std::string("gocad-formats/") + known.file).surfaces;
    EXPECT_EQ(s.points.size(), known.points) << known.file;
    EXPECT_EQ(s.triangles.size(), known.triangles) << known.file;
    EXPECT_EQ(s.patch_entity.size(), known.patches) << known.file;
    EXPECT_EQ(s.entities.size(), known.entities) << known.file;
  }
  const InputData lines = read_shared("gocad-formats/normal_lines.pl");
  std::size_t vertices = 0;
  std::size_t segments = 0;
  for (const Polyline& line : lines.lines) {
    vertices += line.points.size();
    segments += line.points.size() - (line.is_closed ? 0 : 1);
  }
  EXPECT_EQ(lines.lines.size(), 17u);
  EXPECT_EQ(vertices, 11391u);
  EXPECT_EQ(segments, 11374u);
  const InputData well = read_shared("gocad-formats/test.wl");
  ASSERT_EQ(well.lines.size(), 1u);
  EXPECT_EQ(well.lines[0].points.size(), 55u);
  EXPECT_EQ(well.lines[0].points[0], (Vec3{1005111, 2451215.75, 167.89999389648438}));
  const InputData points = read_shared("gocad-formats/points.vs");
  ASSERT_EQ(points.point_sets.size(), 1u);
  EXPECT_EQ(points.point_sets[0].points.size(), 6u);
  EXPECT_EQ(points.point_sets[0].properties.at(0).width, 3u);
  const InputData skipping = read_shared("gocad-formats/sgrid_tsurf.ts");
  ASSERT_EQ(skipping.warnings.size(), 1u);
  EXPECT_THAT(skipping.warnings[0].what, HasSubstr("SGrid 'model_A1_box'"));
  EXPECT_FALSE(read_gocad(support::text_of(support::shared_data() / "gocad-formats/test.vo"), "test.vo"));
  EXPECT_EQ(read_shared("drogon/faults_F1-F6.ts").surfaces.entities.size(), 6u);
  EXPECT_EQ(read_shared("drogon/wells.pl").lines.size(), 8u);
}

TEST(ReadGocadRealModels, a_model_cut_at_every_tenth_fails_by_name) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  for (const char* name : {"ringmesh-A1/modelA1.ml", "ringmesh-A4/modelA4.so"}) {
    const std::string text = support::text_of(support::shared_data() / name);
    for (int tenth = 0; tenth < 10; ++tenth) {
      const Result<InputData> input = read_gocad(text.substr(0, text.size() * tenth / 10), "model.ml");
      ASSERT_FALSE(input) << tenth;
      EXPECT_THAT(input.failure().what, HasSubstr("model.ml:")) << tenth;
    }
  }
}

}  // namespace
}  // namespace strataflow
