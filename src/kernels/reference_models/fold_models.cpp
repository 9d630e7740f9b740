#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/section_model.h"

namespace strataflow {
namespace {

class FaultPropagationFold final : public SectionModel {
 public:
  FaultPropagationFold() {
    box = {{0, 0, 0}, {1600, 930, 500}};
    row_breaks = {0, 930};
    entities = {{"H1", Role::horizon}, {"H2", Role::horizon}, {"H3", Role::horizon}, {"F1", Role::fault}};
    close_with_box(2, {{0, Cut::plain}, {1, Cut::plain}, {2, Cut::plain}});
    faults = {{1, 3, 0, 930, true, true, true, false}};
  }

 private:
  static constexpr double flat_z = 120, tip_z = 380, branch_x = 500, cot_15_deg = 3.7, bend = -0.006;

  double line_x(std::uint32_t line, double, double z) const override {
    if (line == 0) return box.low.x;
    if (line == 2) return box.high.x;
    const double up = z - flat_z;
    if (up <= 0) return branch_x;
    constexpr double reach = tip_z - flat_z;
    if (up <= reach) return branch_x + (cot_15_deg + bend * up) * up;
    return branch_x + (cot_15_deg + bend * reach) * reach + (cot_15_deg + 2 * bend * reach) * (up - reach);
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double x, double, double) const override {
    if (level == 1) return 60;
    if (level == 2) return flat_z;
    return block == 0 ? 270 + 95 * bump((x - 600) / 620) : 270 - 12 * bump((x - 1150) / 300);
  }

  std::array<double, 2> fault_span(const SectionFault&, double) const override { return {flat_z, tip_z}; }
  bool cuts_level(const SectionFault&, const Level& level) const override { return level.entity == 2; }
};

class OnlapOnFold final : public SectionModel {
 public:
  OnlapOnFold() {
    box = {{0, 0, 0}, {1600, 930, 500}};
    row_breaks = {0, 930};
    entities = {{"U", Role::unconformity}, {"H1", Role::horizon}, {"H2", Role::horizon}};
    close_with_box(1, {{0, Cut::cutter}, {1, Cut::above_cutter}, {2, Cut::plain}});
  }

 private:
  double line_x(std::uint32_t line, double, double) const override { return line == 0 ? box.low.x : box.high.x; }

  double surface_z(std::uint32_t, std::uint32_t level, double, double x, double y, double) const override {
    if (level == 2) return 260;
    if (level == 3) return 400;
    return 140 + 170 * bump((x - 1500) / 1300) + 20 * bump((y - 465) / 700);
  }
};

}  // namespace

std::unique_ptr<ColumnModel> fault_propagation_fold() { return std::make_unique<FaultPropagationFold>(); }
std::unique_ptr<ColumnModel> onlap_on_fold() { return std::make_unique<OnlapOnFold>(); }

}  // namespace strataflow
