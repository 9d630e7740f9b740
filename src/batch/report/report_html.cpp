#include "batch/report/report_html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "batch/program_version.h"
#include "batch/report/html_page.h"
#include "kernels/topology/validity/check_validity.h"

namespace strataflow {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string count(std::uint64_t number) { return std::to_string(number); }

std::string hex_colour(const Colour& colour) {
  std::array<char, 8> text;
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text.data();
}

std::string pictures_html(const std::shared_ptr<const Pictures>& pictures) {
  std::string html;
  if (!pictures) return html;
  constexpr std::size_t most_entries = 40;  // a legend of hundreds helps nobody
  for (const Picture& picture : pictures->pictures) {
    html += html_picture(picture.png, picture.caption) + "<p class=\"note\">";
    for (std::size_t i = 0; i < picture.legend.size() && i < most_entries; ++i)
      html += "<span style=\"color:" + hex_colour(picture.legend[i].colour) + "\">&#9632;</span> " +
              escaped_html(picture.legend[i].name) + " &ensp;";
    html += (picture.legend.size() > most_entries ? "…</p>\n" : "</p>\n");
  }
  return html;
}

std::string stages_section(const JobReport& report) {
  Rows rows;
  for (const StageRecord& record : report.stages)
    rows.push_back({record.node, std::string(to_string(record.outcome.status)),
                    record.outcome.digest ? record.outcome.digest->hex() : "", count(record.outcome.warnings.size())});
  std::string html = "<h2>Stages</h2>\n" + html_table({"stage", "status", "digest", "warnings"}, rows);
  for (const StageRecord& record : report.stages)
    for (const Warning& warning : record.outcome.warnings)
      html += "<p class=\"note\">" + escaped_html(record.node + ": " + warning.kind + ": " + warning.what) + "</p>\n";
  return html;
}

std::string model_section(const BuiltModel& built, const ValidityReport& validity) {
  const StructuralModel& model = built.model;
  std::string html = "<h2>Model</h2>\n";
  html += html_table({}, {{"sealed", is_sealed(model, validity) ? "yes" : "no"},
                          {"regions", count(model.regions.size())},
                          {"surfaces", count(model.surfaces.size())},
                          {"lines", count(model.lines.size())},
                          {"corners", count(model.corners.size())},
                          {"triangles", count(model.triangles.size())},
                          {"vertices", count(model.points.size())},
                          {"diagonal, m", readable_number(model.box.diagonal_m())},
                          {"intersecting triangle pairs", count(validity.intersecting_triangle_pairs)}});
  Rows regions;
  for (std::size_t i = 0; i < model.regions.size(); ++i)
    regions.push_back({count(i), model.regions[i].name, readable_number(model.regions[i].volume_m3)});
  html += html_table({"region", "name", "volume, m³"}, regions);
  std::vector<std::uint64_t> surfaces(model.entities.size(), 0), triangles(model.entities.size(), 0);
  for (const Surface& surface : model.surfaces) {
    for (const std::uint32_t entity : surface.all_entities) {
      ++surfaces[entity];
      triangles[entity] += surface.end_triangle - surface.first_triangle;
    }
  }
  Rows entities;
  for (std::size_t i = 0; i < model.entities.size(); ++i)
    entities.push_back({model.entities[i].name, std::string(to_string(model.entities[i].role)), count(surfaces[i]),
                        count(triangles[i])});
  html += html_table({"entity", "role", "surfaces", "triangles"}, entities);
  if (validity.violations.empty()) return html + "<p class=\"ok\">No violation of the validity rules.</p>\n";
  Rows violations;
  for (const Violation& violation : validity.violations)
    violations.push_back({violation.severity == Violation::Severity::error ? "error" : "warning", violation.kind,
                          violation.what, violation.remedy});
  return html + html_table({"severity", "rule", "what", "what to do"}, violations);
}

std::string changes_table(const std::vector<Change>& changes) {
  if (changes.empty()) return "";
  Rows rows;
  for (const Change& change : changes) rows.push_back({change.kind, change.what, change.why});
  return "<h3>Changes</h3>\n" + html_table({"kind", "what", "why"}, rows);
}

std::string cut_section(const CutResult& result) {
  const CutReport& cut = result.report;
  if (cut.rounds == 0 && result.changes.empty()) return "";
  return "<h2>Cutting and sealing</h2>\n" +
         html_table({}, {{"intersecting triangle pairs before", count(cut.intersecting_pairs)},
                         {"triangles cut", count(cut.cut_triangles)},
                         {"pieces", count(cut.pieces)},
                         {"new points", count(cut.new_points)},
                         {"points joined", count(cut.merged_points)},
                         {"triangles dropped", count(cut.dropped_triangles)}}) +
         changes_table(result.changes);
}

std::string sites_section(const SiteSet& sites, const RestrictedDiagram* diagram) {
  std::vector<double> energies;
  for (const CvtStep& step : sites.lloyd_steps) energies.push_back(step.energy);
  for (const CvtStep& step : sites.newton_steps) energies.push_back(step.energy);
  Rows rows{{"sites", count(sites.sites.size())},
            {"of these on the box", count(sites.sites_on_box)},
            {"edge length, m", readable_number(sites.edge_length_m)},
            {"diagrams computed", count(sites.evaluations)},
            {"stopped by", sites.stopped_by}};
  if (diagram) rows.push_back({"pieces of cells", count(diagram->piece_count())});
  return "<h2>Restricted Voronoi diagram</h2>\n" + html_table({}, rows) + "<div class=\"row\">\n" +
         svg_curve(energies, "energy of the tessellation, m⁴") + "</div>\n";
}

std::string surfaces_section(const RemeshedSurfaces& remeshed, const ValidityReport& validity,
                             const SurfacesReport& report) {
  const SurfaceMeshReport &before = report.before, &after = report.after;
  const auto row = [](const std::string& what, const std::string& was, const std::string& is) {
    return std::vector<std::string>{what, was, is};
  };
  const auto share = [](const SurfaceMeshReport& mesh) {
    return readable_number(100 * mesh.triangles.angles_below_30_ratio);
  };
  std::string html = "<h2>Remeshed surfaces</h2>\n";
  html += html_table(
      {"", "before", "after"},
      {row("corners", count(before.corners), count(after.corners)),
       row("lines", count(before.lines), count(after.lines)),
       row("surfaces", count(before.surfaces), count(after.surfaces)),
       row("regions", count(before.regions), count(after.regions)),
       row("vertices", count(before.vertices), count(after.vertices)),
       row("triangles", count(before.triangles.triangles), count(after.triangles.triangles)),
       row("smallest angle, °", readable_number(before.triangles.min_angle_deg),
           readable_number(after.triangles.min_angle_deg)),
       row("angles below 30°, %", share(before), share(after)),
       row("mean quality", readable_number(before.triangles.mean_quality),
           readable_number(after.triangles.mean_quality)),
       row("area, m²", readable_number(before.triangles.area_m2), readable_number(after.triangles.area_m2))});
  html += html_table({}, {{"sites asked for, without the box", count(remeshed.sites_asked)},
                          {"edge length, m", readable_number(remeshed.edge_length_m)},
                          {"Hausdorff distance, m", readable_number(report.hausdorff.distance_m())},
                          {"the same, % of the diagonal", readable_number(100 * report.hausdorff.ratio())},
                          {"intersecting triangle pairs", count(validity.intersecting_triangle_pairs)},
                          {"triangles that keep an angle below 5°", count(remeshed.kept.size())}});
  html += "<div class=\"row\">\n" + svg_histogram(after.triangles.angle_deg) + svg_histogram(after.triangles.quality) +
          "</div>\n";
  return html + changes_table(remeshed.changes);
}

std::string complexity_section(const ComplexityReport& report) {
  const ElementCounts& counts = report.counts;
  const GeometricComplexity& geometric = report.geometric;
  const SizeVariation& variation = report.size_variation;
  std::string html =
      "<h2>Complexity</h2>\n<p class=\"note\">Without the box. Too small, thin: below an edge length of " +
      readable_number(geometric.edge_length_m) + " m; sharp: below " + readable_number(geometric.angle_deg) +
      "°.</p>\n";
  Rows rows;
  const auto add_row = [&](const char* name, std::uint64_t number, ElementType type, double size_variation) {
    const ElementComplexity sum = geometric.sum_of(type);
    rows.push_back({name, count(number), readable_number(sum.too_small), readable_number(sum.shape),
                    readable_number(sum.thin), readable_number(sum.sharp), readable_number(sum.total()),
                    readable_number(size_variation)});
  };
  add_row("regions", counts.regions, ElementType::region, variation.regions);
  add_row("surfaces", counts.surfaces, ElementType::surface, variation.surfaces);
  add_row("lines", counts.lines, ElementType::line, variation.lines);
  rows.push_back({"corners", count(counts.corners), "", "", "", "", "", ""});
  rows.push_back({"all", count(counts.total()), "", "", "", "", readable_number(geometric.total()),
                  readable_number(variation.total())});
  html += html_table({"elements", "number", "too small", "shape", "thin", "sharp", "sum", "variation of sizes"}, rows);
  Rows cells;
  for (const CellStatistics& one : report.cells)
    cells.push_back({count(one.cells), readable_number(one.resolution_m), count(one.q10), count(one.q50),
                     count(one.q90), count(one.max), readable_number(one.mean), readable_number(one.cv),
                     count(one.above_6), readable_number(one.needed_edge_m)});
  html += "<h3>Elements in " + report.neighbourhoods + ", counted by " + report.count_by + "</h3>\n" +
          html_table({"number", "width, m", "Q10", "Q50", "Q90", "max", "mean", "variation", "above 6",
                      "edge that 99 % would do with, m"},
                     cells);
  if (!report.fields.empty() && !report.cells.empty()) {
    Distribution spread("elements in each of the last", 0.5, report.cells.back().max + 0.5, report.cells.back().max);
    for (const double elements : report.fields.front().values) spread.add(elements);
    html += svg_histogram(spread);
  }
  Rows faults;
  for (const FaultMeasures& fault : report.faults.faults)
    faults.push_back({fault.name, readable_number(fault.strike_deg), readable_number(fault.dip_deg),
                      count(fault.layers_affected), readable_number(fault.throw_m.q50),
                      readable_number(fault.throw_m.maximum), readable_number(fault.horizon_angle_deg.minimum),
                      count(fault.faults.size()), readable_number(fault.free_border_m)});
  if (!faults.empty())
    html += "<h3>Faults</h3>\n" +
            html_table({"fault", "strike, °", "dip, °", "layers affected", "median throw, m", "largest throw, m",
                        "smallest angle with a horizon, °", "faults met", "free border, m"},
                       faults);
  Rows needs;
  for (const RegionNeed& need : report.needs)
    needs.push_back({need.name, readable_number(need.volume_m3),
                     need.thinnest_m < geometric.edge_length_m ? readable_number(need.thinnest_m) : "",
                     readable_number(need.needed_edge_m)});
  return html + "<h3>What regions need</h3>\n" +
         html_table({"region", "volume, m³", "thinnest, m", "edge length, m"}, needs);
}

std::string quads_section(const FeatureMesh& problem, const MeshedQuads& quads, const Attempt<GridMapping>* grid) {
  const QuadQuality& quality = quads.quality;
  std::string html = "<h2>Quads</h2>\n";
  if (!quads.why_subdivided.empty())
    html += "<p class=\"note\">Every triangle was cut into three quads, for no map was found: " +
            escaped_html(quads.why_subdivided) + "</p>\n";
  for (const std::string& curve : quads.imprinted)
    html += "<p class=\"note\">'" + escaped_html(curve) +
            "' was laid into the quads, which were divided once, for no map follows it; " +
            count(quads.created.size()) + " irregular vertices came of it.</p>\n";
  html += html_table({}, {{"quads", count(quads.mesh.quads.size())},
                          {"vertices", count(quads.mesh.points.size())},
                          {"wanted edge length, m", readable_number(problem.edge_length_m)},
                          {"irregular vertices inside", count(quality.interior_irregular)},
                          {"smallest scaled Jacobian", readable_number(quality.scaled_jacobian.minimum)},
                          {"the same before smoothing", readable_number(quads.scaled_jacobian_before)},
                          {"mean scaled Jacobian", readable_number(quality.scaled_jacobian.mean())},
                          {"inverted quads", count(quality.inverted)},
                          {"features", count(problem.features.size())},
                          {"features missing", count(quads.missing.size())}});
  Rows valences;
  for (std::size_t v = 1; v < std::max(quality.interior_valence.size(), quality.boundary_valence.size()); ++v) {
    const auto points = [&](const std::vector<std::uint64_t>& by_valence) {
      return v < by_valence.size() ? count(by_valence[v]) : count(0);
    };
    valences.push_back({std::to_string(v), points(quality.interior_valence), points(quality.boundary_valence)});
  }
  html += html_table({"quads around a vertex", "vertices inside", "on the boundary"}, valences);
  if (grid && grid->why_not.empty())
    html += html_table({}, {{"half-edges of the decimated map", count(grid->value.half_edges)},
                            {"integer operations", count(grid->value.operations)},
                            {"energy before, after",
                             readable_number(grid->value.energy_before) + ", " + readable_number(grid->value.energy)},
                            {"transfer", grid->value.transfer}});
  html += "<div class=\"row\">\n" + svg_histogram(quality.scaled_jacobian) + svg_histogram(quality.angle_deg) +
          svg_histogram(quality.edge_length_m) + "</div>\n";
  return html + changes_table(quads.mesh.changes);
}

std::string volume_section(const std::string& title, const VolumeMesh& mesh, const VolumeQualityReport& quality) {
  std::string html = "<h2>" + title + "</h2>\n";
  html += html_table({}, {{"cells", count(quality.cells)},
                          {"vertices", count(quality.vertices)},
                          {"volume, m³", readable_number(quality.volume_m3)},
                          {"inverted cells", count(quality.inverted)},
                          {"faces that do not conform", count(quality.nonconforming_faces)},
                          {"smallest dihedral angle, °", readable_number(quality.min_dihedral_deg)},
                          {"largest dihedral angle, °", readable_number(quality.max_dihedral_deg)},
                          {"facets on surfaces", count(mesh.facets.size())}});
  const DihedralQuantiles& angles = quality.dihedral_quantiles;
  Rows quantiles;
  for (std::size_t i = 0; i < angles.all.size() && i < angles.outside_wedges.size(); ++i)
    quantiles.push_back({readable_number(100 * angles.all[i].share), readable_number(angles.all[i].angle_deg),
                         readable_number(angles.outside_wedges[i].angle_deg)});
  if (!quantiles.empty())
    html += html_table({"% of dihedral angles", "at most, °", "outside wedges, °"}, quantiles) + "<p class=\"note\">" +
            count(angles.cells_in_wedges) +
            " cells lie in wedges, where two surfaces meet at less than 20°; the smallest angle of the others is " +
            readable_number(angles.min_outside_wedges_deg) + "°.</p>\n";
  Rows regions;
  for (const RegionQuality& region : quality.per_region)
    regions.push_back(
        {std::to_string(region.region), region.name, count(region.cells), readable_number(region.volume_m3)});
  html += html_table({"region", "name", "cells", "volume, m³"}, regions);
  html += "<div class=\"row\">\n";
  for (const Distribution& distribution : quality.distributions) html += svg_histogram(distribution);
  html += "</div>\n";
  return html + changes_table(mesh.changes);
}

std::string hybrid_section(const HybridMesh& hybrid, const VolumeQualityReport& quality) {
  const HybridReport& report = hybrid.report;
  std::string html = volume_section("Hybrid mesh", hybrid.mesh, quality);
  html += html_table(
      {},
      {{"prisms", count(quality.prisms)},
       {"pyramids", count(quality.pyramids)},
       {"tetrahedra", count(quality.tetrahedra)},
       {"cells between facing triangles", count(report.cells_from_segments)},
       {"tetrahedra dual to Voronoi vertices", count(report.cells_from_vertices)},
       {"cells of the fill", count(report.cells_from_fill)},
       {"base edge : height of prisms, mean", readable_number(report.mean_anisotropy_ratio)},
       {"pairs of facing triangles", count(report.facing.pairs)},
       {"of them given up", count(report.dropped.isolated + report.dropped.inverted + report.dropped.nonconforming +
                                  report.dropped.crossing + report.dropped.unfilled)},
       {"candidates that were no cells", count(report.facing.turned + report.facing.inverted + report.facing.flat)}});
  return html;
}

std::string frames_section(const FramedMesh& frames) {
  std::vector<std::pair<double, const Polyline*>> curves;
  double whole_m = 0;
  for (const Polyline& line : frames.singular) {
    double length_m = 0;
    for (std::size_t i = 0; i + (line.is_closed ? 0 : 1) < line.points.size(); ++i)
      length_m += length(line.points[(i + 1) % line.points.size()] - line.points[i]);
    curves.emplace_back(length_m, &line);
    whole_m += length_m;
  }
  std::string html = "<h2>Frames</h2>\n";
  html += html_table({}, {{"cells", count(frames.mesh.cell_count())},
                          {"energy", readable_number(frames.energy)},
                          {"diffusion steps", std::to_string(frames.iterations)},
                          {"smallest determinant of three directions", readable_number(frames.smallest_determinant)},
                          {"singular curves", count(curves.size())},
                          {"their length, m", readable_number(whole_m)}});
  if (frames.smallest_determinant < 0.1)
    html +=
        "<p class=\"note\">Somewhere three directions nearly lie in a plane: frames.orthogonality keeps them "
        "apart.</p>\n";
  constexpr std::size_t most_curves = 20;
  std::stable_sort(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto place = [&](const Vec3& p) {
    const Vec3 q = p + frames.mesh.local_origin;
    return readable_number(q.x) + ", " + readable_number(q.y) + ", " + readable_number(q.z);
  };
  Rows rows;
  for (const auto& [length_m, line] : curves) {
    if (rows.size() == most_curves) break;
    rows.push_back({readable_number(length_m), line->is_closed ? "closed" : "open", place(line->points.front()),
                    place(line->points.back())});
  }
  if (!rows.empty()) html += html_table({"singular curve, m", "", "from", "to"}, rows);
  if (curves.size() > most_curves) html += "<p class=\"note\">The others are in frames_singular.vtp.</p>\n";
  Distribution angles("angle_between_directions_deg", 0, 90, 18);
  for (std::size_t c = 0; c < frames.mesh.cell_count(); ++c)
    for (std::size_t i = 0; i < frames.directions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double cosine = 0;
        for (std::size_t k = 0; k < 3; ++k)
          cosine += frames.directions[i].values[3 * c + k] * frames.directions[j].values[3 * c + k];
        angles.add(std::acos(std::min(1.0, std::abs(cosine))) * 180 / std::numbers::pi);
      }
  return html + "<div class=\"row\">\n" + svg_histogram(angles) + "</div>\n";
}

std::string hexes_section(const JobReport& report) {
  const HexGrid& grid = report.smoothed_hexes->hexes.grid;
  std::string html = volume_section("Hexahedra", report.hexes->live.mesh, report.hexes->quality);
  Rows rows = {
      {"method", report.job->hex.method},
      {"layers", count(grid.layers)},
      {"quads of the plan", count(grid.plan.quads.size())},
      {"singular vertices of the plan", count(report.hexes->singular_vertices)},
      {"cells without volume", count(report.smoothed_hexes->hexes.report.dead)},
      {"cells that end in an edge", count(report.hexes->audit.wedges)},
      {"smallest scaled Jacobian before smoothing", readable_number(report.smoothed_hexes->smoothing.min_before)},
      {"after", readable_number(report.hexes->quality.min_scaled_jacobian)}};
  if (report.simulation) {
    const SimulationGridReport& simulation = report.simulation->grid.report;
    rows.push_back({"layout for simulators", simulation.layout});
    if (!simulation.reason.empty()) rows.push_back({"not native because", simulation.reason});
    rows.push_back({"active cells", count(simulation.active_cells)});
    rows.push_back(
        {"connections beside those by index",
         count(simulation.lateral_connections + simulation.vertical_connections + simulation.fault_connections)});
    rows.push_back({"largest deviation from straight pillars, m", readable_number(simulation.largest_deviation_m)});
  }
  return html + html_table({}, rows);
}

}  // namespace

std::string report_html(const JobReport& report) {
  const std::string& name = report.job->header.name;
  std::string body =
      "<h1>" + escaped_html(name) + "</h1>\n<p class=\"note\">strataflow " + program_version() + "</p>\n";
  if (report.sealed) body += cut_section(*report.sealed);
  if (report.model && report.validity)
    body += model_section(*report.model, *report.validity) + pictures_html(report.model_pictures);
  if (report.sites) body += sites_section(*report.sites, report.diagram.get());
  if (report.remeshed && report.surfaces_validity && report.surfaces_report)
    body += surfaces_section(*report.remeshed, *report.surfaces_validity, *report.surfaces_report) +
            pictures_html(report.surfaces_pictures);
  if (report.complexity) body += complexity_section(*report.complexity);
  if (report.quads && report.plan_problem)
    body +=
        quads_section(*report.plan_problem, *report.quads, report.grid.get()) + pictures_html(report.quads_pictures);
  if (report.tets && report.tets_quality)
    body += volume_section("Tetrahedra", *report.tets, *report.tets_quality) + pictures_html(report.tets_pictures);
  if (report.hybrid && report.hybrid_quality)
    body += hybrid_section(*report.hybrid, *report.hybrid_quality) + pictures_html(report.hybrid_pictures);
  if (report.hexes && report.hex_plan)
    body += hexes_section(report) + pictures_html(report.hexes_pictures) + "<h3>Plan</h3>\n" +
            pictures_html(report.hex_plan_pictures);
  if (report.frames) body += frames_section(*report.frames);
  body += stages_section(report);
  return html_page(name + " – strataflow", body);
}

}  // namespace strataflow
