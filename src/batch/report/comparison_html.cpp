#include "batch/report/comparison_html.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "batch/report/html_page.h"

namespace strataflow {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string count(std::uint64_t number) { return std::to_string(number); }

std::string table_of(const std::string& title, const std::vector<std::string>& header, const Rows& rows) {
  return rows.empty() ? "" : "<h2>" + title + "</h2>\n" + html_table(header, rows);
}

std::string surfaces_table(const std::vector<JobReport>& reports) {
  Rows rows;
  for (const JobReport& report : reports) {
    if (!report.remeshed || !report.surfaces_validity || !report.surfaces_report) continue;
    const SurfaceMeshReport &before = report.surfaces_report->before, &after = report.surfaces_report->after;
    const auto elements = [](const SurfaceMeshReport& mesh) {
      return count(mesh.corners) + " / " + count(mesh.lines) + " / " + count(mesh.surfaces) + " / " +
             count(mesh.regions);
    };
    rows.push_back(
        {report.job->header.name, readable_number(report.remeshed->edge_length_m), count(report.remeshed->sites_asked),
         elements(before), elements(after), count(after.triangles.triangles),
         readable_number(after.triangles.min_angle_deg), readable_number(100 * after.triangles.angles_below_30_ratio),
         readable_number(after.triangles.mean_quality),
         readable_number(100 * report.surfaces_report->hausdorff.ratio()),
         count(report.surfaces_validity->intersecting_triangle_pairs), count(report.remeshed->changes.size())});
  }
  return table_of("Remeshed surfaces",
                  {"job", "edge length, m", "sites", "corners / lines / surfaces / regions before", "after",
                   "triangles", "smallest angle, °", "angles below 30°, %", "mean quality",
                   "Hausdorff, % of the diagonal", "intersecting pairs", "changes"},
                  rows);
}

std::string tets_table(const std::vector<JobReport>& reports) {
  Rows rows;
  for (const JobReport& report : reports) {
    if (!report.tets || !report.tets_quality) continue;
    const VolumeQualityReport& quality = *report.tets_quality;
    const auto& quantiles = quality.dihedral_quantiles.outside_wedges;
    const auto thousandth =
        std::find_if(quantiles.begin(), quantiles.end(), [](const AngleQuantile& one) { return one.share == 0.001; });
    rows.push_back({report.job->header.name, count(quality.cells), count(quality.vertices),
                    readable_number(quality.min_dihedral_deg),
                    readable_number(quality.dihedral_quantiles.min_outside_wedges_deg),
                    thousandth == quantiles.end() ? "" : readable_number(thousandth->angle_deg),
                    count(quality.inverted), count(quality.nonconforming_faces)});
  }
  return table_of("Tetrahedra",
                  {"job", "cells", "vertices", "smallest dihedral angle, °", "the same outside wedges, °",
                   "0.1 % of them are below, °", "inverted", "faces that do not conform"},
                  rows);
}

std::string hexes_table(const std::vector<JobReport>& reports) {
  Rows rows;
  for (const JobReport& report : reports) {
    if (!report.hexes || !report.simulation) continue;
    const HexAudit& audit = report.hexes->audit;
    const auto furthest = [&](std::initializer_list<Role> roles, double SurfaceAudit::*distance_m) {
      double most = 0;
      for (const SurfaceAudit& surface : audit.surfaces)
        for (const Role role : roles)
          if (surface.role == to_string(role)) most = std::max(most, surface.*distance_m);
      return readable_number(most);
    };
    double misplaced_m3 = 0, all_m3 = 0;
    for (const RegionVolumeAudit& region : audit.regions) {
      misplaced_m3 += std::abs(region.grid_m3 - region.model_m3);
      all_m3 += region.model_m3;
    }
    const SimulationGridReport& simulation = report.simulation->grid.report;
    rows.push_back(
        {report.job->header.name, report.job->hex.method, count(audit.cells - audit.dead), count(audit.dead),
         readable_number(audit.min_scaled_jacobian), readable_number(audit.mean_scaled_jacobian),
         readable_number(audit.lateral_deg.mean()), readable_number(audit.lateral_deg.maximum),
         furthest({Role::horizon, Role::unconformity}, &SurfaceAudit::furthest_m),
         furthest({Role::horizon, Role::unconformity}, &SurfaceAudit::furthest_on_traces_m),
         furthest({Role::fault}, &SurfaceAudit::furthest_m), readable_number(100 * misplaced_m3 / all_m3), simulation.layout,
         count(simulation.lateral_connections + simulation.vertical_connections + simulation.fault_connections)});
  }
  return table_of("Hexahedra",
                  {"job", "method", "cells", "without volume", "smallest scaled Jacobian", "mean",
                   "angle between faces and centre lines, mean, °", "largest, °", "vertices of horizons, furthest, m",
                   "the same over faults, m", "vertices of faults, furthest, m", "volume in other regions, %",
                   "layout", "connections beside those by index"},
                  rows);
}

/// One bar from Q10 to Q90 and a dot at Q50 per job, on a common scale.
std::string svg_spreads(const std::vector<std::pair<std::string, CellStatistics>>& spreads, std::uint64_t cells) {
  constexpr int step = 46, height = 160, top = 12, left = 30;
  std::uint32_t highest = 1;
  for (const auto& [name, one] : spreads) highest = std::max(highest, one.q90);
  const int width = left + step * static_cast<int>(spreads.size());
  const auto text = [](double number) { return readable_number(number); };
  const auto y = [&](double elements) { return text(top + height * (1 - elements / highest)); };
  std::string svg =
      "<figure><svg width=\"" + count(width + 60) + "\" height=\"" + count(height + top + 90) + "\" role=\"img\">\n";
  for (std::uint32_t tick = 0; tick <= highest; tick += highest > 12 ? 5 : highest > 5 ? 2 : 1)
    svg += "<line x1=\"" + count(left) + "\" x2=\"" + count(width) + "\" y1=\"" + y(tick) + "\" y2=\"" + y(tick) +
           "\" stroke=\"#e4e4e4\"/><text x=\"" + count(left - 6) + "\" y=\"" + y(tick) +
           "\" font-size=\"11\" text-anchor=\"end\" dy=\"4\">" + count(tick) + "</text>\n";
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const auto& [name, one] = spreads[i];
    const std::string x = count(left + step * static_cast<int>(i) + step / 2);
    svg += "<line x1=\"" + x + "\" x2=\"" + x + "\" y1=\"" + y(one.q10) + "\" y2=\"" + y(one.q90) +
           "\" stroke=\"#4878a8\" stroke-width=\"8\"/><circle cx=\"" + x + "\" cy=\"" + y(one.q50) +
           "\" r=\"5\" fill=\"#fff\" stroke=\"#222\"/><text transform=\"translate(" + x + "," +
           count(height + top + 14) + ") rotate(40)\" font-size=\"11\">" + escaped_html(name) + "</text>\n";
  }
  return svg + "</svg><figcaption>elements in each of about " + count(cells) +
         " cells: Q10 to Q90, the dot is Q50</figcaption></figure>\n";
}

std::string complexity_section(const std::vector<JobReport>& reports) {
  Rows rows, cells;
  std::size_t most = 0;
  for (const JobReport& report : reports) {
    if (!report.complexity) continue;
    const ComplexityReport& one = *report.complexity;
    const std::string& name = report.job->header.name;
    rows.push_back({name, count(one.counts.regions), count(one.counts.surfaces), count(one.counts.lines),
                    count(one.counts.corners), readable_number(one.geometric.total()),
                    readable_number(one.size_variation.total())});
    for (const CellStatistics& statistics : one.cells)
      cells.push_back({name, count(statistics.cells), readable_number(statistics.resolution_m), count(statistics.q10),
                       count(statistics.q50), count(statistics.q90), count(statistics.max),
                       readable_number(statistics.mean), readable_number(statistics.cv), count(statistics.above_6)});
    most = std::max(most, one.cells.size());
  }
  if (rows.empty()) return "";
  std::string html =
      table_of("Complexity",
               {"job", "regions", "surfaces", "lines", "corners", "geometric complexity", "variation of sizes"}, rows) +
      "<div class=\"row\">\n";
  for (std::size_t place = 0; place < most; ++place) {
    std::vector<std::pair<std::string, CellStatistics>> spreads;
    for (const JobReport& report : reports)
      if (report.complexity && place < report.complexity->cells.size())
        spreads.emplace_back(report.job->header.name, report.complexity->cells[place]);
    html += svg_spreads(spreads, spreads.front().second.cells);
  }
  return html + "</div>\n" +
         html_table({"job", "cells", "width, m", "Q10", "Q50", "Q90", "max", "mean", "variation", "above 6"}, cells);
}

}  // namespace

std::string comparison_html(const std::vector<JobReport>& reports) {
  const std::string body = "<h1>" + count(reports.size()) + " jobs side by side</h1>\n" + surfaces_table(reports) +
                           tets_table(reports) + hexes_table(reports) + complexity_section(reports);
  return html_page("Comparison – strataflow", body);
}

}  // namespace strataflow
