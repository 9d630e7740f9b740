#include "batch/report/comparison_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace strataflow {
namespace {

using testing::HasSubstr;
using testing::Not;

JobReport complexity_of(const Job& job, std::uint32_t q10, std::uint32_t q50, std::uint32_t q90) {
  ComplexityReport found;
  CellStatistics cells;
  cells.cells = 998;
  cells.q10 = q10;
  cells.q50 = q50;
  cells.q90 = q90;
  cells.mean = 2.345;
  found.cells = {cells};
  JobReport report;
  report.job = &job;
  report.complexity = std::make_shared<ComplexityReport>(found);
  return report;
}

TEST(Comparison, draws_a_bar_from_q10_to_q90_for_every_model_on_one_scale) {
  Job plain, hard;
  plain.header.name = "A1";
  hard.header.name = "A5 <Y>";
  const std::string page = comparison_html({complexity_of(plain, 1, 3, 5), complexity_of(hard, 2, 4, 10)});
  EXPECT_THAT(page, HasSubstr("A5 &lt;Y&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<Y>")));
  EXPECT_THAT(page, HasSubstr("2.345"));
  // 160 units for ten elements, 12 above: Q10 = 1 and Q90 = 5 of the first, Q50 = 4 of the second.
  EXPECT_THAT(page, HasSubstr("y1=\"156\" y2=\"92\""));
  EXPECT_THAT(page, HasSubstr("y1=\"140\" y2=\"12\""));
  EXPECT_THAT(page, HasSubstr("cy=\"108\""));
}

TEST(Comparison, has_no_section_for_what_no_job_made) {
  Job job;
  JobReport report;
  report.job = &job;
  const std::string page = comparison_html({report, report});
  EXPECT_THAT(page, Not(HasSubstr("Complexity")));
  EXPECT_THAT(page, Not(HasSubstr("Tetrahedra")));
  EXPECT_THAT(page, Not(HasSubstr("Remeshed")));
}

TEST(Comparison, sets_meshes_of_a_sweep_in_one_table) {
  Job job;
  job.header.name = "sweep_remesh.sites=1000";
  JobReport report;
  report.job = &job;
  RemeshedSurfaces remeshed;
  remeshed.edge_length_m = 41.25;
  report.remeshed = std::make_shared<RemeshedSurfaces>(remeshed);
  report.surfaces_validity = std::make_shared<ValidityReport>();
  SurfacesReport surfaces;
  surfaces.after.triangles.mean_quality = 0.9125;
  report.surfaces_report = std::make_shared<SurfacesReport>(surfaces);
  VolumeQualityReport quality;
  quality.cells = 4711;
  quality.dihedral_quantiles.outside_wedges = {{0.0001, 4}, {0.001, 8.5}};
  report.tets = std::make_shared<VolumeMesh>();
  report.tets_quality = std::make_shared<VolumeQualityReport>(quality);
  const std::string page = comparison_html({report});
  for (const char* part : {"sweep_remesh.sites=1000", "41.25", "0.9125", "4711", "8.5"})
    EXPECT_THAT(page, HasSubstr(part));
}

}  // namespace
}  // namespace strataflow
