#include "batch/run/run_files.h"

#include <array>
#include <cstdio>
#include <span>

#include "base/log.h"
#include "batch/job_file/resolved_job.h"
#include "batch/program_version.h"
#include "batch/report/report_html.h"
#include "batch/report/report_json.h"
#include "io/gocad/write_gocad.h"
#include "io/input/labelled_triangles.h"
#include "io/mesh/write_abaqus.h"
#include "io/mesh/write_gmsh.h"
#include "io/mesh/write_medit.h"
#include "io/surface/write_obj.h"
#include "io/vtk/write_vtk_xml.h"

namespace strataflow {

namespace {

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::string fixed(double number, int digits) {
  std::array<char, 64> text;
  return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.*f", digits, number))};
}

std::string log_text(const JobReport& report, const RunFacts& facts) {
  RunLog log;
  log.line(LogLevel::info, "strataflow " + program_version() + ", job " + report.job->header.name + ", " +
                               std::to_string(facts.threads) + " threads, " + fixed(facts.total_s, 3) + " s");
  for (const StageRecord& record : report.stages) {
    std::string text = fixed(record.timing.start_s, 3) + " s  " + record.node + " (" + record.stage + " " +
                       std::to_string(record.version) + "): " + std::string(to_string(record.outcome.status));
    if (record.outcome.digest) text += ", " + record.outcome.digest->hex();
    text += record.timing.is_cached ? ", from the store" : ", " + fixed(record.timing.seconds, 3) + " s";
    log.line(LogLevel::info, text);
    for (const Warning& warning : record.outcome.warnings)
      log.line(LogLevel::warning, warning.kind + ": " + warning.what);
    if (!record.timing.not_stored.empty()) log.line(LogLevel::warning, "not_stored: " + record.timing.not_stored);
  }
  return log.text();
}

}  // namespace

std::vector<RunFile> run_files(const JobReport& report, const RunFacts& facts) {
  std::vector<RunFile> files;
  const auto add = [&](const std::string& name, const std::string& text) { files.push_back({name, bytes_of(text)}); };
  const Job& job = *report.job;
  add("report.json", report_json(report));
  add("timing.json", timing_json(report, facts.threads, facts.total_s, facts.peak_memory_mb));
  add("report.html", report_html(report));
  add("job.toml", resolved_job_text(job, facts.run_folder));
  add("log.txt", log_text(report, facts));
  const auto add_surfaces = [&](const std::string& product, const StructuralModel& model) {
    const LabelledTriangles triangles = labelled_triangles(model);
    add(product + ".vtp", write_vtp(triangles));
    if (job.writes("gocad")) add(product + ".ml", write_gocad_ml(model, job.header.name));
    if (job.writes("medit")) add(product + ".mesh", write_medit(triangles));
    if (job.writes("gmsh")) add(product + ".msh", write_gmsh(triangles));
    if (job.writes("obj")) add(product + ".obj", write_obj(triangles));
    if (job.writes("abaqus")) add(product + ".inp", write_abaqus(triangles));
  };
  if (report.model && job.makes("model")) add_surfaces("model", report.model->model);
  if (report.model && report.diagram && job.makes("voronoi"))
    add("voronoi.vtp", write_voronoi_vtp(labelled_triangles(report.model->model), *report.diagram));
  if (report.surfaces && report.surfaces_report && job.makes("surfaces"))
    add_surfaces("surfaces", report.surfaces->model);
  if (report.complexity && job.makes("complexity"))
    add("complexity.vtu", write_vtu(report.complexity->map, report.complexity->fields));
  if (report.quads && job.makes("quads")) add("quads.vtp", write_quads_vtp(report.quads->mesh));
  const auto add_volume = [&](const std::string& product, const VolumeMesh& mesh,
                              std::span<const CellField> fields = {}) {
    add(product + ".vtu", write_vtu(mesh, fields));
    add(product + "_facets.vtp", write_facets_vtp(mesh));
    if (job.writes("gocad"))  // tetrahedra only
      if (const Result<std::string> solid = write_gocad_so(mesh, job.header.name)) add(product + ".so", *solid);
    if (job.writes("medit")) add(product + ".mesh", write_medit(mesh));
    if (job.writes("gmsh")) add(product + ".msh", write_gmsh(mesh));
    if (job.writes("abaqus")) add(product + ".inp", write_abaqus(mesh));
  };
  if (report.tets && report.tets_quality && job.makes("tets")) add_volume("tets", *report.tets);
  if (report.hexes && report.simulation && job.makes("hexes")) {
    add_volume("hexes", report.hexes->live.mesh, report.simulation->fields);
    add("hexes.grdecl", report.simulation->grdecl);
    if (!report.simulation->deck.empty()) {
      add("hexes.data", report.simulation->deck);
      add("hexes_regions.inc", report.simulation->regions);
    }
    add("hexes_plan.vtp", write_quads_vtp(report.hex_plan->mesh));
    add("hexes_singular.vtp", write_lines_vtp(report.hexes->audit.singular_lines, report.hexes->live.mesh.local_origin));
  }
  if (report.frames && job.makes("frames")) {
    add("frames.vtu", write_vtu(report.frames->mesh, report.frames->directions));
    add("frames_singular.vtp", write_lines_vtp(report.frames->singular, report.frames->mesh.local_origin));
  }
  if (report.hybrid && report.hybrid_quality && job.makes("hybrid")) add_volume("hybrid", report.hybrid->mesh);
  return files;
}

std::vector<RunFile> inspection_files(const JobReport& report, const RunFacts& facts) {
  const Job& job = *report.job;
  const bool is_plan = !job.makes("quads");
  const auto& problem = is_plan ? report.hex_plan_problem : report.plan_problem;
  if (!problem || (is_plan ? report.hex_plan : report.quads)) return {};
  std::vector<RunFile> files;
  const auto add = [&](const std::string& name, const std::string& text) { files.push_back({name, bytes_of(text)}); };
  add("report.json", report_json(report));
  add("job.toml", resolved_job_text(job, facts.run_folder));
  add("log.txt", log_text(report, facts));
  add("plan_problem.vtp", write_feature_mesh_vtp(*problem, nullptr, nullptr));
  if (report.frame_field && report.frame_field->why_not.empty())
    add("frame_field.vtp", write_feature_mesh_vtp(*problem, &report.frame_field->value.field, nullptr));
  if (report.seamless_map && report.seamless_map->why_not.empty()) {
    const FieldAndMap& found = report.seamless_map->value;
    add("seamless_map.vtp", write_feature_mesh_vtp(*problem, &found.field.field, &found.map.map));
  }
  if (report.grid && report.grid->why_not.empty())
    add("quantize.vtp", write_feature_mesh_vtp(report.grid->value.mesh, nullptr, &report.grid->value.map));
  return files;
}

}  // namespace strataflow
