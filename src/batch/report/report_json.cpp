#include "batch/report/report_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "batch/program_version.h"
#include "batch/report/complexity_json.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/topology/validity/check_validity.h"
#include "stages/all_stages.h"

namespace strataflow {

namespace {

using Json = nlohmann::ordered_json;

std::string written(const Json& json) {
  // Names come from files and may be any bytes; JSON is UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json json_of(const std::optional<Failure>& failure) {
  if (!failure) return nullptr;
  return {{"code", to_string(failure->code)}, {"what", failure->what}, {"remedy", failure->remedy}};
}

Json json_of(const std::vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) list.push_back({{"kind", warning.kind}, {"what", warning.what}});
  return list;
}

Json json_of(const std::vector<Change>& changes) {
  Json list = Json::array();
  for (const Change& change : changes)
    list.push_back({{"kind", change.kind}, {"what", change.what}, {"why", change.why}});
  return list;
}

Json json_of(const std::vector<Distribution>& distributions) {
  Json list = Json::array();
  for (const Distribution& one : distributions)
    list.push_back({{"name", one.name},
                    {"count", one.count},
                    {"minimum", one.minimum},
                    {"maximum", one.maximum},
                    {"mean", one.mean()},
                    {"low", one.low},
                    {"high", one.high},
                    {"bins", one.bins}});
  return list;
}

Json json_of(const std::vector<RegionQuality>& regions) {
  Json list = Json::array();
  for (const RegionQuality& region : regions)
    list.push_back(
        {{"region", region.region}, {"name", region.name}, {"cells", region.cells}, {"volume_m3", region.volume_m3}});
  return list;
}

double area_m2(const StructuralModel& model) {
  double sum = 0;
  for (const Triangle& t : model.triangles) {
    const Vec3& a = model.points[t[0]];
    sum += 0.5 * length(cross(model.points[t[1]] - a, model.points[t[2]] - a));
  }
  return sum;
}

Json entities_json(const StructuralModel& model) {
  std::vector<std::uint64_t> surfaces(model.entities.size(), 0);
  for (const Surface& surface : model.surfaces)
    for (const std::uint32_t entity : surface.all_entities) ++surfaces[entity];
  Json list = Json::array();
  for (std::size_t i = 0; i < model.entities.size(); ++i)
    list.push_back({{"id", i},
                    {"name", model.entities[i].name},
                    {"role", to_string(model.entities[i].role)},
                    {"surfaces", surfaces[i]}});
  return list;
}

/// Surfaces where several entities coincide: the mesh files name only the youngest.
Json coincident_json(const StructuralModel& model) {
  Json list = Json::array();
  for (std::size_t i = 0; i < model.surfaces.size(); ++i)
    if (const Surface& surface = model.surfaces[i]; surface.all_entities.size() > 1)
      list.push_back({{"surface", i}, {"entity", surface.entity}, {"entities", surface.all_entities}});
  return list;
}

Json violations_json(const Vec3& origin, const std::vector<Violation>& violations) {
  Json list = Json::array();
  for (const Violation& violation : violations) {
    const Vec3 where = violation.where + origin;
    list.push_back({{"kind", violation.kind},
                    {"severity", violation.severity == Violation::Severity::error ? "error" : "warning"},
                    {"what", violation.what},
                    {"remedy", violation.remedy},
                    {"where_m", {where.x, where.y, where.z}},
                    {"count", violation.count}});
  }
  return list;
}

Json model_block(const BuiltModel& built, const ValidityReport& validity) {
  const StructuralModel& model = built.model;
  Json regions = Json::array();
  Json volumes = Json::array();
  for (std::size_t i = 0; i < model.regions.size(); ++i) {
    regions.push_back({{"id", i}, {"name", model.regions[i].name}, {"volume_m3", model.regions[i].volume_m3}});
    volumes.push_back(model.regions[i].volume_m3);
  }
  Json layers = Json::array();
  for (const Layer& layer : model.layers) layers.push_back({{"name", layer.name}, {"regions", layer.regions}});
  return {{"corners", model.corners.size()},
          {"lines", model.lines.size()},
          {"surfaces", model.surfaces.size()},
          {"regions", model.regions.size()},
          {"vertices", model.points.size()},
          {"triangles", model.triangles.size()},
          {"sealed", is_sealed(model, validity)},
          {"bbox_diagonal_m", model.box.diagonal_m()},
          {"area_m2", area_m2(model)},
          {"regions_list", regions},
          {"volumes_m3", volumes},
          {"layers", layers},
          {"entities", entities_json(model)},
          {"coincident_surfaces", coincident_json(model)},
          {"intersecting_triangle_pairs", validity.intersecting_triangle_pairs},
          {"self_intersecting_pairs", validity.self_intersecting_pairs},
          {"violations", violations_json(model.local_origin, validity.violations)}};
}

Json cut_block(const CutResult& result) {
  const CutReport& cut = result.report;
  return {{"intersecting_triangle_pairs", cut.intersecting_pairs},
          {"cut_triangles", cut.cut_triangles},
          {"pieces", cut.pieces},
          {"new_points", cut.new_points},
          {"merged_points", cut.merged_points},
          {"largest_move_m", cut.largest_move_m},
          {"dropped_triangles", cut.dropped_triangles},
          {"rounds", cut.rounds},
          {"pairs_left", cut.pairs_left},
          {"changes", json_of(result.changes)}};
}

Json steps_json(const std::vector<CvtStep>& steps) {
  Json list = Json::array();
  for (const CvtStep& step : steps) list.push_back({{"energy", step.energy}, {"gradient_norm", step.gradient_norm}});
  return list;
}

Json sites_json(const SiteSet& sites) {
  return {{"sites", sites.sites.size()},
          {"sites_on_box", sites.sites_on_box},
          {"edge_length_m", sites.edge_length_m},
          {"line_attraction", sites.line_attraction},
          {"evaluations", sites.evaluations},
          {"replanted_sites", sites.replanted},
          {"stopped_by", sites.stopped_by},
          {"lloyd_steps", steps_json(sites.lloyd_steps)},
          {"newton_steps", steps_json(sites.newton_steps)}};
}

Json voronoi_block(const SiteSet& sites, const RestrictedDiagram& diagram) {
  Json json = sites_json(sites);
  json["pieces"] = diagram.piece_count();
  return json;
}

Json distance_json(const HausdorffDistance& distance) {
  return {{"ratio", distance.ratio()},
          {"distance_m", distance.distance_m()},
          {"bound_m", distance.bound_m()},
          {"from_input_m", distance.forward.distance_m},
          {"to_input_m", distance.backward.distance_m},
          {"samples", distance.forward.samples + distance.backward.samples}};
}

Json topology_json(const TopologyInvariants& topology) {
  return {{"euler", topology.euler()},
          {"betti", {topology.components, topology.independent_loops, topology.cavities}},
          {"borders", topology.borders}};
}

Json contacts_json(const std::vector<Contact>& contacts) {
  Json list = Json::array();
  for (const Contact& contact : contacts)
    list.push_back({{"name", contact.name},
                    {"valence", contact.valence},
                    {"lines", contact.lines},
                    {"edges", contact.edges},
                    {"length_m", contact.length_m}});
  return list;
}

Json mesh_json(const SurfaceMeshReport& mesh) {
  return {{"corners", mesh.corners},
          {"lines", mesh.lines},
          {"surfaces", mesh.surfaces},
          {"regions", mesh.regions},
          {"vertices", mesh.vertices},
          {"triangles", mesh.triangles.triangles},
          {"min_angle_deg", mesh.triangles.min_angle_deg},
          {"angles_below_30_ratio", mesh.triangles.angles_below_30_ratio},
          {"mean_quality", mesh.triangles.mean_quality},
          {"area_m2", mesh.triangles.area_m2},
          {"bbox_diagonal_m", mesh.diagonal_m},
          {"edge_valences", mesh.edge_valences},
          {"contacts", contacts_json(mesh.contacts)}};
}

Json surfaces_block(const SiteSet* sites, const RemeshedSurfaces& remeshed, const BuiltModel& built,
                    const ValidityReport& validity, const SurfacesReport& report) {
  Json json = mesh_json(report.after);
  json["sites"] = remeshed.sites_asked;
  json["edge_length_m"] = remeshed.edge_length_m;
  json["added_sites"] = remeshed.added_sites;
  json["merged_points"] = remeshed.merged_points;
  json["ball_property_failures"] = remeshed.ball_failures;
  json["sealed"] = is_sealed(built.model, validity);
  json["intersecting_triangle_pairs"] = validity.intersecting_triangle_pairs;
  json["hausdorff_ratio"] = report.hausdorff.ratio();
  json["hausdorff"] = distance_json(report.hausdorff);
  Json by_entity = Json::array();
  for (const EntityDistance& entity : report.by_entity) {
    Json one = distance_json(entity.distance);
    one["entity"] = entity.name;
    by_entity.push_back(std::move(one));
  }
  json["hausdorff_by_entity"] = std::move(by_entity);
  if (sites) json["optimisation"] = sites_json(*sites);
  json["topology"] = {{"before", topology_json(report.topology_before.whole)},
                      {"after", topology_json(report.topology_after.whole)}};
  json["before"] = mesh_json(report.before);
  Json volumes = Json::array();
  for (const Region& region : built.model.regions) volumes.push_back(region.volume_m3);
  json["volumes_m3"] = std::move(volumes);
  json["steps"] = {{"splits", remeshed.splits},
                   {"collapses", remeshed.collapses},
                   {"flips", remeshed.flips},
                   {"moves", remeshed.moves}};
  Json kept = Json::array();
  for (const KeptTriangle& triangle : remeshed.kept) {
    Vec3 middle;
    for (const std::uint32_t corner : remeshed.soup.triangles[triangle.triangle])
      middle = middle + (1.0 / 3) * remeshed.soup.points[corner];
    middle = middle + remeshed.soup.local_origin;
    kept.push_back({{"where_m", {middle.x, middle.y, middle.z}},
                    {"smallest_angle_deg", triangle.smallest_angle_deg},
                    {"why", triangle.touches_small_feature ? "small feature of the input" : "no valid step mends it"}});
  }
  json["triangles_below_5_deg"] = std::move(kept);
  json["changes"] = json_of(remeshed.changes);
  return json;
}

Json json_of(const DihedralQuantiles& angles) {
  const auto listed = [](const std::vector<AngleQuantile>& quantiles) {
    Json list = Json::array();
    for (const AngleQuantile& one : quantiles) list.push_back({{"share", one.share}, {"angle_deg", one.angle_deg}});
    return list;
  };
  return {{"all", listed(angles.all)},
          {"wedge_deg", DihedralQuantiles::wedge_deg},
          {"cells_in_wedges", angles.cells_in_wedges},
          {"sharpest_wedge_deg", angles.sharpest_wedge_deg},
          {"min_outside_wedges_deg", angles.min_outside_wedges_deg},
          {"outside_wedges", listed(angles.outside_wedges)}};
}

/// Irregular points inside: those of the field, and those that came of curves laid into the quads.
Json irregular_json(const MeshedQuads& quads) {
  const std::vector<std::uint32_t> valence = quad_valence(quads.mesh);
  const std::vector<char> is_boundary = boundary_points(quads.mesh);
  Json list = Json::array();
  for (std::uint32_t p = 0; p < valence.size(); ++p) {
    if (is_boundary[p] || valence[p] == 4) continue;
    const Vec3 at = quads.mesh.points[p] + quads.mesh.local_origin;
    list.push_back({{"at", {at.x, at.y, at.z}},
                    {"quads", valence[p]},
                    {"created", std::binary_search(quads.created.begin(), quads.created.end(), p)}});
  }
  return list;
}

Json quads_block(const FeatureMesh* problem, const MeshedQuads& quads, const Attempt<FieldAndMap>* seamless,
                 const Attempt<GridMapping>* grid) {
  const QuadQuality& quality = quads.quality;
  std::vector<Distribution> spreads{quality.scaled_jacobian, quality.angle_deg, quality.edge_length_m};
  Json block = {{"quads", quads.mesh.quads.size()},
                {"vertices", quads.mesh.points.size()},
                {"edge_length_m", problem ? problem->edge_length_m : quads.quality.edge_length_m.mean()},
                {"triangles", problem ? problem->triangles.size() : 0},
                {"interior_irregular", quality.interior_irregular},
                {"interior_valence", quality.interior_valence},
                {"boundary_valence", quality.boundary_valence},
                {"inverted", quality.inverted},
                {"min_scaled_jacobian", quality.scaled_jacobian.minimum},
                {"min_scaled_jacobian_before_smoothing", quads.scaled_jacobian_before},
                {"mean_scaled_jacobian", quality.scaled_jacobian.mean()},
                {"features", problem ? problem->features.size() : quads.mesh.features.size()},
                {"features_missing", quads.missing.size()},
                {"fallback", quads.why_subdivided.empty() ? Json(nullptr) : Json(quads.why_subdivided)},
                {"imprinted", quads.imprinted.size()},
                {"imprinted_curves", quads.imprinted},
                {"irregular", quads.imprinted.empty() ? Json(nullptr) : irregular_json(quads)},
                {"histograms", json_of(spreads)},
                {"changes", json_of(quads.mesh.changes)}};
  if (seamless && seamless->why_not.empty()) {
    const FrameFieldReport& report = seamless->value.field.report;
    block["field"] = {
        {"valence_3", report.valence_3},         {"valence_5", report.valence_5},
        {"valence_other", report.valence_other}, {"on_features", report.feature_irregular},
        {"cancelled", report.cancelled},         {"smallest_sine", seamless->value.field.field.smallest_sine},
        {"given_up", seamless->value.retries}};
    const MapReport& map = seamless->value.map.report;
    block["map"] = {{"unknowns", map.unknowns},
                    {"iterations", map.foldover_free.iterations},
                    {"flipped_before", map.foldover_free.flipped_before},
                    {"energy", map.foldover_free.energy},
                    {"smallest_determinant", map.foldover_free.smallest_determinant}};
  }
  if (grid && grid->why_not.empty())
    block["integers"] = {{"half_edges", grid->value.half_edges},
                         {"operations", grid->value.operations},
                         {"doublings", grid->value.doublings},
                         {"energy_before", grid->value.energy_before},
                         {"energy", grid->value.energy},
                         {"transfer", grid->value.transfer},
                         {"unmet_features", grid->value.unmet_features}};
  return block;
}

Json tets_block(const VolumeMesh& mesh, const VolumeQualityReport& quality) {
  return {{"vertices", quality.vertices},
          {"cells", quality.cells},
          {"per_region", json_of(quality.per_region)},
          {"volume_m3", quality.volume_m3},
          {"min_dihedral_deg", quality.min_dihedral_deg},
          {"max_dihedral_deg", quality.max_dihedral_deg},
          {"dihedral_quantiles", json_of(quality.dihedral_quantiles)},
          {"inverted", quality.inverted},
          {"nonconforming_faces", quality.nonconforming_faces},
          {"facets", mesh.facets.size()},
          {"histograms", json_of(quality.distributions)},
          {"changes", json_of(mesh.changes)}};
}

Json hybrid_block(const HybridMesh& hybrid, const VolumeQualityReport& quality, const RemeshedSurfaces& surfaces,
                  const SurfacesReport& compared) {
  const HybridReport& report = hybrid.report;
  Json regions = Json::array();
  for (std::size_t r = 0; r < report.regions.size(); ++r) {
    const HybridRegion& region = report.regions[r];
    regions.push_back({{"region", r},
                       {"name", r < hybrid.mesh.region_names.size() ? hybrid.mesh.region_names[r] : ""},
                       {"cells", region.tetrahedra + region.pyramids + region.prisms},
                       {"tets", region.tetrahedra},
                       {"pyramids", region.pyramids},
                       {"prisms", region.prisms},
                       {"volume_m3", region.volume_m3},
                       {"prism_volume_ratio", region.volume_m3 > 0 ? region.prism_volume_m3 / region.volume_m3 : 0}});
  }
  Json block = tets_block(hybrid.mesh, quality);
  block["per_region"] = regions;
  block["tets"] = quality.tetrahedra;
  block["pyramids"] = quality.pyramids;
  block["prisms"] = quality.prisms;
  block["cells_from_voronoi"] = report.cells_from_voronoi();
  block["cells_from_segments"] = report.cells_from_segments;
  block["cells_from_vertices"] = report.cells_from_vertices;
  block["cells_from_fill"] = report.cells_from_fill;
  block["min_scaled_jacobian"] = quality.min_scaled_jacobian;
  block["mean_scaled_jacobian"] = quality.mean_scaled_jacobian;
  block["candidates"] = {{"pairs", report.facing.pairs},
                         {"turned", report.facing.turned},
                         {"inverted", report.facing.inverted},
                         {"flat", report.facing.flat},
                         {"unequal", report.facing.unequal},
                         {"dropped",
                          {{"isolated", report.dropped.isolated},
                           {"inverted", report.dropped.inverted},
                           {"nonconforming", report.dropped.nonconforming},
                           {"crossing", report.dropped.crossing},
                           {"unfilled", report.dropped.unfilled}}}};
  block["points"] = {{"surfaces", report.surface_points},       {"layers", report.layer_points},
                     {"centres", report.centre_points},         {"apexes", report.apex_points},
                     {"interior_sites", report.interior_sites}, {"fill", report.fill_points}};
  const VertexDualCounts& duals = report.vertex_duals;
  block["voronoi_vertices"] = {{"vertices", duals.vertices},
                               {"candidates", duals.candidates},
                               {"unreached", duals.unreached},
                               {"edges", duals.edges},
                               {"checked_edges", duals.checked_edges},
                               {"inconsistent_edges", duals.inconsistent_edges},
                               {"flat", duals.flat},
                               {"crossing", duals.crossing},
                               {"replaced", duals.replaced},
                               {"kept", duals.kept}};
  block["interior_sites"] = {{"asked", report.interior_sites_asked}, {"set", report.interior_sites}};
  block["improvement"] = {{"exchanges", report.improvement.exchanges},
                          {"moves", report.improvement.moves},
                          {"added_points", report.improvement.added_points},
                          {"smallest_scaled_jacobian_before", report.improvement.smallest_before},
                          {"smallest_scaled_jacobian_after", report.improvement.smallest_after}};
  block["anisotropy_ratio"] = {{"min", report.min_anisotropy_ratio},
                               {"mean", report.mean_anisotropy_ratio},
                               {"max", report.max_anisotropy_ratio}};
  block["surfaces"] = {{"sites", surfaces.sites_asked},
                       {"added_sites", surfaces.added_sites},
                       {"triangles", compared.after.triangles.triangles},
                       {"min_angle_deg", compared.after.triangles.min_angle_deg},
                       {"hausdorff_ratio", compared.hausdorff.ratio()}};
  return block;
}

/// Structs that list their fields by name.
template <class Fields>
Json json_of_fields(const Fields& fields);

struct FieldsToJson {
  Json json = Json::object();
  template <class T>
  void operator()(const char* name, const T& value) {
    json[name] = json_of_field(value);
  }
  template <class T>
  static Json json_of_field(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
      return value;
    else if constexpr (std::is_same_v<T, Distribution>)
      return json_of(std::vector<Distribution>{value});
    else
      return json_of_fields(value);
  }
  template <class T>
  static Json json_of_field(const std::vector<T>& values) {
    Json items = Json::array();
    for (const T& value : values) items.push_back(json_of_field(value));
    return items;
  }
};

template <class Fields>
Json json_of_fields(const Fields& fields) {
  FieldsToJson visit;
  const_cast<Fields&>(fields).visit_fields(visit);  // one list serves reading and writing
  return visit.json;
}

Json simulation_block(const SimulationFiles& files) {
  const SimulationGridReport& report = files.grid.report;
  Json wells = Json::array();
  for (const SimulationWell& well : files.wells)
    wells.push_back({{"name", well.name}, {"injects", well.is_injector}, {"cells", well.cells.size()}});
  return {{"size", files.grid.grid.size},
          {"layout", report.layout},
          {"reason", report.reason},
          {"blocks", report.blocks},
          {"split_columns", report.split_columns},
          {"active_cells", report.active_cells},
          {"dead_cells", report.dead_cells},
          {"occupancy_ratio", report.occupancy_ratio},
          {"largest_deviation_m", report.largest_deviation_m},
          {"largest_volume_error_ratio", report.largest_volume_error_ratio},
          {"volume_error_ratio", report.volume_error_ratio},
          {"index_contacts", report.index_contacts},
          {"lateral_connections", report.lateral_connections},
          {"vertical_connections", report.vertical_connections},
          {"fault_connections", report.fault_connections},
          {"wells", wells}};
}

Json frames_block(const FramedMesh& frames) {
  double length_m = 0;
  for (const Polyline& line : frames.singular)
    for (std::size_t i = 0; i + (line.is_closed ? 0 : 1) < line.points.size(); ++i)
      length_m += length(line.points[(i + 1) % line.points.size()] - line.points[i]);
  return {{"cells", frames.mesh.cell_count()},         {"energy", frames.energy},
          {"iterations", frames.iterations},           {"smallest_determinant", frames.smallest_determinant},
          {"singular_curves", frames.singular.size()}, {"singular_length_m", length_m}};
}

Json hexes_block(const JobReport& report) {
  const VolumeQualityReport& quality = report.hexes->quality;
  const HexGrid& grid = report.smoothed_hexes->hexes.grid;
  const ExtrusionReport& extrusion = report.smoothed_hexes->hexes.report;
  const HexSmoothing& smoothing = report.smoothed_hexes->smoothing;
  Json block = tets_block(report.hexes->live.mesh, quality);
  block["cells"] = quality.cells;
  block["dead_cells"] = extrusion.dead;
  block["wedges"] = report.hexes->audit.wedges;
  block["offset_fault_faces"] = report.hexes->audit.diagnosis.nonconforming_faces.on_faults;
  block["layers"] = grid.layers;
  block["quads"] = grid.plan.quads.size();
  block["singular_vertices"] = report.hexes->singular_vertices;
  block["min_scaled_jacobian"] = quality.min_scaled_jacobian;
  block["mean_scaled_jacobian"] = quality.mean_scaled_jacobian;
  block["smoothing"] = {{"min_scaled_jacobian_before", smoothing.min_before},
                        {"min_scaled_jacobian_after", smoothing.min_after},
                        {"largest_warpage_ratio_before", smoothing.warpage_before},
                        {"largest_warpage_ratio_after", smoothing.warpage_after},
                        {"moves", smoothing.moves},
                        {"sweeps", smoothing.sweeps}};
  block["largest_outside_m"] = extrusion.largest_outside_m;
  block["unreached_corners"] = extrusion.unreached;
  block["bridged"] = {{"vertices", extrusion.bridged}, {"furthest_m", extrusion.largest_bridged_m}};
  block["levels"] = report.layered_space->layers.level_names;
  block["untangling"] = {{"turned_over_at_first", report.layered_space->turned_over_at_first},
                         {"steps", report.layered_space->untangling_steps}};
  block["audit"] = json_of_fields(report.hexes->audit);
  block["method"] = report.job->hex.method;
  block["plan"] = quads_block(report.hex_plan_problem.get(), *report.hex_plan, nullptr, nullptr);
  if (report.simulation) block["simulation_grid"] = simulation_block(*report.simulation);
  return block;
}

}  // namespace

std::string report_json(const JobReport& report) {
  Json stages = Json::array();
  for (const StageRecord& record : report.stages)
    stages.push_back({{"id", stages.size()},
                      {"node", record.node},
                      {"stage", record.stage},
                      {"version", record.version},
                      {"status", to_string(record.outcome.status)},
                      {"digest", record.outcome.digest ? Json(record.outcome.digest->hex()) : Json(nullptr)},
                      {"warnings", json_of(record.outcome.warnings)}});
  Json json = {{"format", 1},
               {"program", "strataflow " + program_version()},
               {"job", report.job->header.name},
               {"status", report.error ? "failed" : "ok"},
               {"error", json_of(report.error)},
               {"stages", stages}};
  if (report.sealed) json["cut"] = cut_block(*report.sealed);
  if (report.model && report.validity) json["model"] = model_block(*report.model, *report.validity);
  if (report.sites && report.diagram) json["voronoi"] = voronoi_block(*report.sites, *report.diagram);
  if (report.remeshed && report.surfaces && report.surfaces_validity && report.surfaces_report)
    json["surfaces"] = surfaces_block(report.sites.get(), *report.remeshed, *report.surfaces, *report.surfaces_validity,
                                      *report.surfaces_report);
  if (report.complexity) json["complexity"] = complexity_json(*report.complexity);
  if (report.quads && report.plan_problem)
    json["quads"] = quads_block(report.plan_problem.get(), *report.quads, report.seamless_map.get(), report.grid.get());
  if (report.hybrid && report.hybrid_quality && report.hybrid_remeshed && report.hybrid_surfaces_report)
    json["hybrid"] =
        hybrid_block(*report.hybrid, *report.hybrid_quality, *report.hybrid_remeshed, *report.hybrid_surfaces_report);
  if (report.hexes && report.hex_plan) json["hexes"] = hexes_block(report);
  if (report.frames) json["frames"] = frames_block(*report.frames);
  if (report.tets && report.tets_quality) json["tets"] = tets_block(*report.tets, *report.tets_quality);
  return written(json);
}

std::string timing_json(const JobReport& report, int threads, double total_s, double peak_memory_mb) {
  Json stages = Json::array();
  for (const StageRecord& record : report.stages)
    stages.push_back({{"node", record.node},
                      {"start_s", record.timing.start_s},
                      {"seconds", record.timing.seconds},
                      {"cached", record.timing.is_cached}});
  return written({{"threads", threads}, {"total_s", total_s}, {"peak_memory_mb", peak_memory_mb}, {"stages", stages}});
}

std::string model_json(const BuiltModel& built, const ValidityReport& validity) {
  return written(model_block(built, validity));
}

std::string volume_quality_json(const std::string& file, const VolumeQualityReport& quality,
                                const std::optional<PatchTestReport>& patch) {
  Json json = {{"file", file},
               {"vertices", quality.vertices},
               {"cells",
                {{"total", quality.cells},
                 {"tetrahedra", quality.tetrahedra},
                 {"pyramids", quality.pyramids},
                 {"prisms", quality.prisms},
                 {"hexahedra", quality.hexahedra}}},
               {"volume_m3", quality.volume_m3},
               {"per_region", json_of(quality.per_region)},
               {"inverted", quality.inverted},
               {"nonconforming_faces", quality.nonconforming_faces},
               {"open_boundary_edges", quality.open_boundary_edges},
               {"faces_with_hanging_vertex", quality.faces_with_hanging_vertex},
               {"coincident_boundary_vertices", quality.coincident_boundary_vertices},
               {"inner_faces", quality.inner_faces},
               {"boundary_faces", quality.boundary_faces},
               {"min_dihedral_deg", quality.min_dihedral_deg},
               {"max_dihedral_deg", quality.max_dihedral_deg},
               {"dihedral_quantiles", json_of(quality.dihedral_quantiles)},
               {"min_scaled_jacobian", quality.min_scaled_jacobian},
               {"mean_scaled_jacobian", quality.mean_scaled_jacobian},
               {"valid", quality.is_valid()},
               {"histograms", json_of(quality.distributions)}};
  if (patch)
    json["patch_test"] = {{"unknowns", patch->unknowns},
                          {"max_error_ratio", patch->max_error_ratio},
                          {"energy_error_ratio", patch->energy_error_ratio},
                          {"passes", patch->passes()}};
  return written(json);
}

std::string triangle_quality_json(const std::string& file, const TriangleQualityReport& quality) {
  return written({{"file", file},
                  {"cells", {{"triangles", quality.triangles}}},
                  {"degenerate", quality.degenerate},
                  {"inverted", 0},
                  {"nonconforming_faces", 0},
                  {"area_m2", quality.area_m2},
                  {"min_angle_deg", quality.min_angle_deg},
                  {"angles_below_30_ratio", quality.angles_below_30_ratio},
                  {"mean_quality", quality.mean_quality},
                  {"valid", quality.degenerate == 0},
                  {"histograms", json_of(std::vector{quality.angle_deg, quality.quality, quality.radius_ratio})}});
}

std::string stages_json() {
  Json list = Json::array();
  for (const StageDescription& stage : all_stages()) {
    Json options = Json::array();
    for (const OptionDescription& option : stage.options)
      options.push_back({{"name", option.name},
                         {"type", option.type},
                         {"unit", option.unit},
                         {"default", option.default_value.empty() ? Json(nullptr) : Json(option.default_value)},
                         {"domain", option.domain},
                         {"description", option.description}});
    list.push_back({{"stage", stage.name},
                    {"summary", stage.summary},
                    {"inputs", stage.inputs},
                    {"output", stage.output},
                    {"version", stage.version},
                    {"uses_seed", stage.uses_seed},
                    {"section", stage.section},
                    {"options", options}});
  }
  return written(list);
}

}  // namespace strataflow
