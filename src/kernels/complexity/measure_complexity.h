#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "kernels/complexity/box_elements.h"
#include "kernels/complexity/cells/count_in_cells.h"
#include "kernels/complexity/fault_measures.h"
#include "kernels/complexity/geometric_complexity.h"
#include "model/cell_field.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

struct ComplexityOptions {
  std::optional<double> edge_length_m;  ///< h; absent: 1/200 of the diagonal
  double angle_deg = 20;
  std::vector<std::int64_t> cells = {100, 1000, 10000};
  std::string neighbourhoods = "voronoi";
  std::string count_by = "components";
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(edge_length_m, OptionField{.name = "edge_length_m",
                                     .description = "Length of the edges a mesh is to have: what is smaller or thinner "
                                                    "is complex; absent: 1/200 of the diagonal",
                                     .minimum = 0,
                                     .exclusive_minimum = true});
    visit(angle_deg, OptionField{.name = "angle_deg",
                                 .description = "Contacts sharper than this are complex",
                                 .minimum = 0,
                                 .maximum = 180});
    visit(cells, OptionField{.name = "cells",
                             .description = "Into how many neighbourhoods the model is cut, one table each; the last "
                                            "is the one of the map",
                             .minimum = 1,
                             .maximum = 10'000'000});
    visit(neighbourhoods, OptionField{.name = "neighbourhoods",
                                      .description = "What elements are counted in: the cells of a centroidal Voronoi "
                                                     "tessellation, voxels, or balls of the same volume around their "
                                                     "centres",
                                      .words = {"voronoi", "voxels", "balls"}});
    visit(count_by, OptionField{.name = "count_by",
                                .description = "Count each connected piece of a surface or line in a neighbourhood; each "
                                               "surface or line of the model once; or each connected piece of a "
                                               "feature whatever contacts split it, without lines and corners. "
                                               "Regions count once",
                                .words = {"components", "elements", "features"}});
  }
};

/// What a region asks of a mesh.
struct RegionNeed {
  std::string name;
  double volume_m3 = 0;
  double thinnest_m = 0;  ///< least thickness found below h where it does not wedge out; infinite: none
  double needed_edge_m = 0;  ///< the least of that and the sizes of its surfaces and lines, as lengths
  template <class A>
  void archive(A& a) {
    a(name, volume_m3, thinnest_m, needed_edge_m);
  }
};

/// Everything pellerin2014 §2.10 measures, and what §5 wishes for besides.
struct ComplexityReport {
  ElementCounts counts;
  GeometricComplexity geometric;
  SizeVariation size_variation;
  std::string neighbourhoods, count_by;
  std::vector<CellStatistics> cells;  ///< in the order of the option
  FaultReport faults;
  std::vector<RegionNeed> needs;  ///< per region
  VolumeMesh map;                 ///< the last neighbourhoods as voxels; Voronoi cells as about eight each
  std::vector<CellField> fields;  ///< of the map's cells; the first counts elements
  template <class A>
  void archive(A& a) {
    a(counts, geometric, size_variation, neighbourhoods, count_by, cells, faults, needs, map, fields);
  }
};

/// `seed` starts the sites of Voronoi cells. Fails with invalid_options, or with invalid_input for a model without
/// extent.
Result<ComplexityReport> measure_complexity(const StructuralModel& model, const ComplexityOptions& options = {},
                                            std::uint64_t seed = 1);

}  // namespace strataflow
