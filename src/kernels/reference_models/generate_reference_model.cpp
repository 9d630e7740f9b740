#include "kernels/reference_models/generate_reference_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/option_field.h"
#include "kernels/reference_models/closed_shapes.h"
#include "kernels/reference_models/extrudable_models.h"
#include "kernels/reference_models/fracture_network.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/seal_columns.h"
#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {
namespace {

constexpr double pair_width_m = 1000;

TriangleSoup horizon_fault_pair(double edge_m) {
  SheetSoup sheets({{"H1", Role::horizon}, {"F1", Role::fault}});
  const auto count = static_cast<std::uint32_t>(std::round(pair_width_m / edge_m));
  const auto along = [&](std::uint32_t i) { return pair_width_m * (double(i) / count); };
  sheets.add_grid(0, count + 1, count + 1, [&](std::uint32_t i, std::uint32_t j) {
    const double x = along(i), y = along(j);
    return Vec3{x, y, 500 + 40 * wave(x / 310) * wave(y / 270 + 0.3) + 12 * wave((x + y) / 97)};
  });
  sheets.add_grid(1, count + 1, count + 1, [&](std::uint32_t i, std::uint32_t j) {
    const double y = along(i), z = along(j);
    return Vec3{500 + 0.4 * (500 - z) + 45 * wave(y / 290) + 25 * wave(z / 230 + 0.4) * wave(y / 170), y, z};
  });
  return sheets.take();
}

/// One reference model: told column by column (`plan`), as triangles (`shape`), or neither: a network of
/// fractures, which are cut.
struct Maker {
  std::string_view name;
  double width_m = 1600;  ///< west–east
  double edge_m = 40;     ///< if none is asked for: about 10 000 triangles
  std::unique_ptr<ColumnModel> (*plan)() = nullptr;
  TriangleSoup (*shape)(double edge_m) = nullptr;
  bool has_raw = true;
  double least_edges = 8;  ///< across the width: fewer lose a feature of the model
};

template <char digit>
std::unique_ptr<ColumnModel> anticline() {
  const char name[]{'A', digit};
  return anticline_model({name, 2});
}

constexpr std::array steep_dips_cot{0.17632698070846498, 0.36397023426620234, 0.57735026918962576, 1.0};  // 80° … 45°

std::unique_ptr<ColumnModel> bent_vertical_faults() { return vertical_faults(12, true); }
std::unique_ptr<ColumnModel> four_dipping_faults() { return dipping_faults(steep_dips_cot, 15); }
std::unique_ptr<ColumnModel> faulted_unconformity() { return unconformity(true); }

constexpr std::array makers{
    Maker{.name = "A1", .plan = anticline<'1'>},
    Maker{.name = "A2", .plan = anticline<'2'>},
    Maker{.name = "A3", .plan = anticline<'3'>},
    Maker{.name = "A4", .plan = anticline<'4'>},
    Maker{.name = "A5", .plan = anticline<'5'>},
    Maker{.name = "A6", .plan = anticline<'6'>},
    Maker{.name = "B", .plan = fault_propagation_fold},
    Maker{.name = "C", .plan = onlap_on_fold},
    Maker{.name = "D", .width_m = 120, .edge_m = 3.75, .plan = diapir},
    Maker{.name = "nested-spheres", .width_m = 200, .edge_m = 6, .shape = nested_spheres, .has_raw = false},
    Maker{.name = "slab", .width_m = 1000, .edge_m = 20, .shape = slab, .has_raw = false},
    Maker{.name = "wedge", .width_m = 1000, .edge_m = 20, .shape = wedge, .has_raw = false},
    Maker{.name = "variable-layers", .width_m = 2000, .edge_m = 60, .plan = variable_layers},
    Maker{.name = "bracket", .width_m = 200, .edge_m = 4, .plan = bracket, .has_raw = false},
    Maker{.name = "impeller", .width_m = 200, .edge_m = 4, .plan = impeller, .has_raw = false},
    Maker{.name = "smooth-closed", .width_m = 200, .edge_m = 4, .shape = smooth_closed_surface, .has_raw = false},
    Maker{.name = "torus", .width_m = 200, .edge_m = 4, .shape = torus, .has_raw = false},
    Maker{.name = "veins", .width_m = 10200, .edge_m = 80, .plan = veins},
    Maker{.name = "onlap", .width_m = 110, .edge_m = 2.75, .plan = onlap},
    Maker{.name = "sandbox", .width_m = 3500, .edge_m = 150, .plan = sandbox},
    Maker{.name = "fault-network", .width_m = 12000, .edge_m = 300, .plan = fault_network, .has_raw = false},
    Maker{.name = "dfn", .width_m = 13000, .edge_m = 450},
    Maker{.name = "vertical-faults", .edge_m = 60, .plan = bent_vertical_faults, .has_raw = false},
    Maker{.name = "dipping-faults", .width_m = 2000, .edge_m = 50, .plan = four_dipping_faults, .has_raw = false},
    Maker{.name = "listric", .width_m = 2000, .edge_m = 45, .plan = listric_fault, .has_raw = false},
    Maker{.name = "unconformity", .edge_m = 50, .plan = faulted_unconformity, .has_raw = false},
    Maker{.name = "thin-layers", .width_m = 1000, .edge_m = 40, .plan = thin_layers, .has_raw = false},
    Maker{.name = "horizon-fault-pair", .width_m = pair_width_m, .edge_m = 10, .shape = horizon_fault_pair}};

std::string all_names() {
  std::string text;
  for (const Maker& maker : makers) text += (text.empty() ? "" : ", ") + std::string(maker.name);
  return text;
}

}  // namespace

const std::vector<std::string_view>& reference_model_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Maker& maker : makers) all.push_back(maker.name);
    return all;
  }();
  return names;
}

Result<TriangleSoup> generate_reference_model(std::string_view name, const ReferenceModelOptions& options) {
  const auto* const maker = std::find_if(makers.begin(), makers.end(), [&](const Maker& m) { return m.name == name; });
  if (maker == makers.end())
    return Failure{FailureCode::invalid_options, "no reference model is called '" + std::string(name) + "'",
                   "choose one of " + all_names()};
  const double edge_m = options.resolution_m.value_or(maker->edge_m);
  if (!(edge_m >= maker->width_m / 2000 && edge_m <= maker->width_m / maker->least_edges))
    return Failure{FailureCode::invalid_options,
                   "resolution_m = " + OptionPrinter::literal(edge_m) + " does not suit " + std::string(name),
                   "choose between " + OptionPrinter::literal(maker->width_m / 2000) + " and " +
                       OptionPrinter::literal(maker->width_m / maker->least_edges) + " m for " + std::string(name) +
                       " (models: " + all_names() + ")"};
  if (options.raw_ratio && !(std::abs(*options.raw_ratio) <= 0.2))
    return Failure{FailureCode::invalid_options,
                   "raw_ratio = " + OptionPrinter::literal(*options.raw_ratio) + " for " + std::string(name),
                   "choose between -0.2 (overshooting) and 0.2 (stopping short)"};
  if (options.raw_ratio && !maker->has_raw)
    return Failure{FailureCode::invalid_options,
                   std::string(name) + " has no raw variant: it has no surface that ends on another",
                   "leave out raw_ratio (--raw)"};
  if (maker->shape) return maker->shape(edge_m);
  if (!maker->plan)
    return options.raw_ratio ? raw_fracture_network(edge_m, options.seed, -*options.raw_ratio)
                             : fracture_network(edge_m, options.seed);
  const std::unique_ptr<ColumnModel> model = maker->plan();
  return options.raw_ratio ? model->raw_surfaces(edge_m, *options.raw_ratio) : seal_columns(*model, edge_m);
}

}  // namespace strataflow
