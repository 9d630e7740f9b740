#include "batch/report/report_html.h"

#include <array>
#include <cstdio>

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

std::string tets_section(const VolumeMesh& mesh, const VolumeQualityReport& quality) {
  std::string html = "<h2>Tetrahedra</h2>\n";
  html += html_table({}, {{"cells", count(quality.cells)},
                          {"vertices", count(quality.vertices)},
                          {"volume, m³", readable_number(quality.volume_m3)},
                          {"inverted cells", count(quality.inverted)},
                          {"faces that do not conform", count(quality.nonconforming_faces)},
                          {"smallest dihedral angle, °", readable_number(quality.min_dihedral_deg)},
                          {"largest dihedral angle, °", readable_number(quality.max_dihedral_deg)},
                          {"facets on surfaces", count(mesh.facets.size())}});
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

}  // namespace

std::string report_html(const JobReport& report) {
  const std::string& name = report.job->header.name;
  std::string body =
      "<h1>" + escaped_html(name) + "</h1>\n<p class=\"note\">strataflow " + program_version() + "</p>\n";
  if (report.sealed) body += cut_section(*report.sealed);
  if (report.model && report.validity)
    body += model_section(*report.model, *report.validity) + pictures_html(report.model_pictures);
  if (report.tets && report.tets_quality)
    body += tets_section(*report.tets, *report.tets_quality) + pictures_html(report.tets_pictures);
  body += stages_section(report);
  return html_page(name + " – strataflow", body);
}

}  // namespace strataflow
