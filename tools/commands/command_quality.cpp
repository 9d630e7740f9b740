#include <algorithm>
#include <optional>

#include "batch/check_model.h"
#include "batch/report/html_page.h"
#include "batch/report/report_json.h"
#include "commands.h"
#include "graph/parallel/schedule.h"
#include "terminal.h"

namespace strataflow {

namespace {

std::string distributions_text(const std::vector<Distribution>& distributions) {
  std::string text;
  for (const Distribution& one : distributions)
    if (one.count > 0)
      text += "  " + one.name + ": " + readable_number(one.minimum) + " … " + readable_number(one.maximum) + ", mean " +
              readable_number(one.mean()) + "\n";
  return text;
}

std::string volume_text(const std::string& file, const VolumeQualityReport& quality) {
  std::string text = file + ": " + std::to_string(quality.cells) + " cells (" + std::to_string(quality.tetrahedra) +
                     " tetrahedra, " + std::to_string(quality.pyramids) + " pyramids, " +
                     std::to_string(quality.prisms) + " prisms, " + std::to_string(quality.hexahedra) +
                     " hexahedra), " + std::to_string(quality.vertices) + " vertices, " +
                     readable_number(quality.volume_m3) + " m3\n";
  for (const RegionQuality& region : quality.per_region)
    text += "  region " + std::to_string(region.region) + " " + region.name + ": " + std::to_string(region.cells) +
            " cells, " + readable_number(region.volume_m3) + " m3\n";
  text += distributions_text(quality.distributions);
  text += "  inverted cells: " + std::to_string(quality.inverted) +
          ", faces that do not conform: " + std::to_string(quality.nonconforming_faces) +
          ", open boundary edges: " + std::to_string(quality.open_boundary_edges) + "\n";
  return text + (quality.is_valid() ? "  valid\n" : "  not valid\n");
}

std::string patch_text(const PatchTestReport& patch) {
  return "  patch test: linear fields are reproduced to " + readable_number(patch.max_error_ratio) + ", their energy to " +
         readable_number(patch.energy_error_ratio) + (patch.passes() ? ", passed\n" : ", NOT passed\n");
}

std::string triangle_text(const std::string& file, const TriangleQualityReport& quality) {
  return file + ": " + std::to_string(quality.triangles) + " triangles, " + readable_number(quality.area_m2) + " m2\n" +
         distributions_text({quality.angle_deg, quality.quality, quality.radius_ratio}) +
         "  degenerate triangles: " + std::to_string(quality.degenerate) +
         (quality.degenerate == 0 ? "\n  valid\n" : "\n  not valid\n");
}

}  // namespace

int quality_command(const QualityArguments& arguments) {
  const ScheduleScope threads(ScheduleKind::threads);
  int exit_code = 0;
  std::vector<std::string> reports;
  for (const std::filesystem::path& path : arguments.files) {
    const std::string file = path.string();
    const Result<InputData> input = read_inputs({path});
    if (!input) {
      exit_code = std::max(exit_code, report_failure(input.failure()));
      continue;
    }
    for (const Warning& warning : input->warnings) report_warning(file + ": " + warning.kind + ": " + warning.what);
    bool is_valid = true;
    if (input->volume.cell_count() > 0) {
      const VolumeQualityReport quality = analyze_volume_mesh(input->volume);
      is_valid = quality.is_valid();
      std::optional<PatchTestReport> patch;
      if (arguments.patch_test && is_valid) {
        Result<PatchTestReport> solved = run_patch_test(input->volume);
        if (!solved) {
          exit_code = std::max(exit_code, report_failure({solved.failure().code, file + ": " + solved.failure().what,
                                                          solved.failure().remedy}));
          continue;
        }
        is_valid = solved->passes();
        patch = *solved;
      }
      reports.push_back(arguments.json ? volume_quality_json(file, quality, patch)
                                       : volume_text(file, quality) + (patch ? patch_text(*patch) : ""));
    } else if (!input->surfaces.triangles.empty()) {
      const TriangleQualityReport quality = analyze_triangles(input->surfaces.points, input->surfaces.triangles);
      is_valid = quality.degenerate == 0;
      reports.push_back(arguments.json ? triangle_quality_json(file, quality) : triangle_text(file, quality));
    } else {
      exit_code =
          std::max(exit_code, report_failure({FailureCode::invalid_input, file + ": holds neither triangles nor cells",
                                              "name a surface or volume mesh"}));
    }
    if (!is_valid) exit_code = std::max(exit_code, 1);
  }
  std::string text;
  for (std::size_t i = 0; i < reports.size(); ++i) text += (arguments.json && i > 0 ? "," : "") + reports[i];
  // One file gives an object, several a list: what a script expects of either.
  return std::max(exit_code, print_result(arguments.json && arguments.files.size() > 1 ? "[" + text + "]\n" : text));
}

}  // namespace strataflow
