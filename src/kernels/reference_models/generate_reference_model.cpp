#include "kernels/reference_models/generate_reference_model.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/option_field.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/seal_columns.h"
#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {
namespace {

constexpr double pair_width_m = 1000;

std::string all_names() {
  std::string text;
  for (const std::string_view name : reference_model_names()) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::unique_ptr<ColumnModel> plan(std::string_view name) {
  if (name == "B") return fault_propagation_fold();
  if (name == "C") return onlap_on_fold();
  if (name == "D") return diapir();
  return anticline_model(name);
}

/// 0 at multiples of 2, smooth, between −1 and 1: a sine made of the four operations, the same on every machine.
double wave(double u) {
  const double turn = u - 2 * std::floor(u / 2), half = turn < 1 ? turn : turn - 1;
  return (turn < 1 ? 4 : -4) * half * (1 - half);
}

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

}  // namespace

const std::vector<std::string_view>& reference_model_names() {
  static const std::vector<std::string_view> names{"A1", "A2", "A3", "A4", "A5",
                                                   "A6", "B",  "C",  "D",  "horizon-fault-pair"};
  return names;
}

Result<TriangleSoup> generate_reference_model(std::string_view name, const ReferenceModelOptions& options) {
  const auto& names = reference_model_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    return Failure{FailureCode::invalid_options, "no reference model is called '" + std::string(name) + "'",
                   "choose one of " + all_names()};
  const bool is_pair = name == "horizon-fault-pair";
  const std::unique_ptr<ColumnModel> model = is_pair ? nullptr : plan(name);
  const double width_m = is_pair ? pair_width_m : model->box.high.x;
  const double edge_m = options.resolution_m.value_or(width_m / (is_pair ? 100 : name == "D" ? 32 : 40));
  if (!(edge_m >= width_m / 2000 && edge_m <= width_m / 8))
    return Failure{FailureCode::invalid_options,
                   "resolution_m = " + OptionPrinter::literal(edge_m) + " does not suit " + std::string(name),
                   "choose between " + OptionPrinter::literal(width_m / 2000) + " and " +
                       OptionPrinter::literal(width_m / 8) + " m for " + std::string(name) +
                       " (models: " + all_names() + ")"};
  if (options.raw_ratio && !(std::abs(*options.raw_ratio) <= 0.2))
    return Failure{FailureCode::invalid_options,
                   "raw_ratio = " + OptionPrinter::literal(*options.raw_ratio) + " for " + std::string(name),
                   "choose between -0.2 (overshooting) and 0.2 (stopping short)"};
  if (is_pair) return horizon_fault_pair(edge_m);
  return options.raw_ratio ? model->raw_surfaces(edge_m, *options.raw_ratio) : seal_columns(*model, edge_m);
}

}  // namespace strataflow
