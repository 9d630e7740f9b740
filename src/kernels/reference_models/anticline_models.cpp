#include <array>
#include <cmath>

#include "base/internal_error.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/section_model.h"

namespace strataflow {
namespace {

constexpr double cot_dip = 0.57735026918962576;  // faults dip 60° to the east
constexpr double mid_z = 250.0;

/// The fold all of them share; its axis is 11° off the strike of the faults.
double anticline_z(std::uint32_t horizon, double x, double y) {
  constexpr std::array<double, 3> limb{150, 230, 320}, rise{70, 80, 90};
  return limb[horizon] + rise[horizon] * bump((x - 800 + 0.2 * (y - 465)) / 950);
}

/// A1, and the frame of the others: straight lines dipping 60° and a drop per block.
class Anticline : public SectionModel {
 public:
  explicit Anticline(std::vector<double> fault_x, bool is_eroded = false) : fault_x_(std::move(fault_x)) {
    box = {{0, 0, 0}, {1600, 930, 500}};
    row_breaks = {0, 930};
    entities = {{"H1", Role::horizon}, {"H2", Role::horizon}, {"H3", Role::horizon}};
    const Cut cut = is_eroded ? Cut::below_cutter : Cut::plain;
    std::vector<Level> levels{{0, cut}, {1, cut}, {2, cut}};
    for (std::size_t f = 0; f < fault_x_.size(); ++f) entities.push_back({"F" + std::to_string(f + 1), Role::fault});
    if (is_eroded) {
      levels.push_back({static_cast<std::uint32_t>(entities.size()), Cut::cutter});
      entities.push_back({"E", Role::unconformity});
    }
    close_with_box(static_cast<std::uint32_t>(fault_x_.size()) + 1, levels);
    for (std::uint32_t f = 0; f < fault_x_.size(); ++f)
      faults.push_back({f + 1, 3 + f, 0, 930, true, true, true, true});
  }

 protected:
  double line_x(std::uint32_t line, double, double z) const override {
    if (line == 0) return box.low.x;
    if (line == block_count()) return box.high.x;
    return fault_x_[line - 1] + (mid_z - z) * cot_dip;
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double x, double y, double) const override {
    const double drop = drop_m(block, y);
    return anticline_z(level - 1, x - drop * cot_dip, y) - drop;  // moved along the dip of the faults
  }

  /// How far a block went down, by all faults west of it.
  virtual double drop_m(std::uint32_t, double) const { return 0; }

  std::vector<double> fault_x_;
};

/// A2: two regional parallel faults of constant throw.
class ParallelFaults final : public Anticline {
 public:
  ParallelFaults() : Anticline({500, 980}) {}

 private:
  double drop_m(std::uint32_t block, double) const override { return std::array<double, 3>{0, 35, 60}[block]; }
};

/// A3: two local faults. Each displaces both of its sides by half its throw, less and less away from it. The throw is
/// greatest in the middle and zero on the tip line: two arcs above and below, joined by the columns at both ends.
class LocalFaults final : public Anticline {
 public:
  LocalFaults() : Anticline({520, 1010}) {
    row_breaks = {0, ends[0].south, ends[1].south, ends[0].north, ends[1].north, 930};
    for (SectionFault& fault : faults) {
      fault = {fault.line, fault.entity, ends[fault.line - 1].south, ends[fault.line - 1].north, false, false,
               false,      false};
    }
  }

 private:
  struct Ends {
    double south, north;
  };
  static constexpr std::array<Ends, 2> ends{Ends{200, 680}, Ends{260, 740}};
  static constexpr double middle_z = 308, half_side = 118, arch = 44, greatest_throw = 20;

  /// −1 at the southern, 1 at the northern end; exactly so at the rows of the ends.
  static double along(std::uint32_t fault, double y) {
    const double centre = 0.5 * (ends[fault].south + ends[fault].north);
    return (y - centre) / (0.5 * (ends[fault].north - ends[fault].south));
  }
  static double half_height(double t) { return half_side + arch * std::sqrt(std::max(0.0, 1 - t * t)); }

  static double throw_m(std::uint32_t fault, double y, double z) {
    const double t = along(fault, y), up = (z - middle_z) / half_height(t);
    return t * t < 1 && up * up < 1 ? greatest_throw * (1 - t * t) * (1 - up * up) : 0.0;
  }

  std::array<double, 2> fault_span(const SectionFault& fault, double y) const override {
    const double half = half_height(along(fault.line - 1, y));
    return {middle_z - half, middle_z + half};
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double share, double x, double y,
                   double z) const override {
    double moved = anticline_z(level - 1, x, y);
    if (block < 2) moved += 0.5 * throw_m(block, y, z) * share * share;
    if (block > 0) moved -= 0.5 * throw_m(block - 1, y, z) * (1 - share) * (1 - share);
    return moved;
  }
};

/// A4: throws grow northwards. The western fault ends in the south; the regional eastern one changes sides near the
/// southern border, where its horizon traces cross at a low angle.
/// A6: the same under a topographic erosion surface E, with air above it.
class GrowingThrows final : public Anticline {
 public:
  explicit GrowingThrows(bool is_eroded) : Anticline({500, 980}, is_eroded) {
    row_breaks = {0, hinge_y, tip_y, 930};
    faults[0].south_m = tip_y;
    faults[0].touches_south = false;
  }

 private:
  static constexpr double tip_y = 310, hinge_y = 100;

  double drop_m(std::uint32_t block, double y) const override {
    const double western = y > tip_y ? 0.07 * (y - tip_y) : 0.0;
    return block == 0 ? 0.0 : block == 1 ? western : western + 0.055 * (y - hinge_y);
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double share, double x, double y,
                   double z) const override {
    if (level - 1 < 3) return Anticline::surface_z(block, level, share, x, y, z);
    // Hills and valleys near H3 and H2: caps of the uppermost layer stay on hills of the eroded crest.
    const auto hill = [&](double east, double north, double wide, double high) {
      return high * bump((x - east) / wide) * bump((y - north) / wide);
    };
    return 352 + hill(520, 620, 360, 48) + hill(1120, 330, 320, 56) + hill(760, 110, 170, 66) +
           hill(800, 480, 150, 52) + hill(1000, 800, 150, 62) + hill(1420, 800, 260, 45) + hill(620, 280, 150, 64) +
           hill(820, 760, 280, -95) + hill(250, 250, 280, -45);
  }
};

/// A5: two faults that join in a Y along a branch line down the dip of the main one. Throws are constant and along
/// that line, so the blocks can be moved back to A1. The main throw equals the thickness of the layer under H3 at one
/// row, where H3 of one block meets H2 of the other: slivers on the fault.
class BranchingFaults final : public Anticline {
 public:
  BranchingFaults() : Anticline({560, 560}) {
    row_breaks = {0, branch_y, meeting_y, 930};
    faults[1].south_m = branch_y;
    main_throw_ = thickness_along_dip(meeting_y);
  }

 private:
  static constexpr double branch_y = 350, meeting_y = 640, spread = 0.5, second_throw = 25;

  double line_x(std::uint32_t line, double y, double z) const override {
    const double x = Anticline::line_x(line, y, z);
    return line == 2 && y > branch_y ? x + spread * (y - branch_y) : x;
  }

  double drop_m(std::uint32_t block, double) const override {
    return std::array<double, 3>{0, main_throw_, main_throw_ + second_throw}[block];
  }

  /// Height from H2 up to H3 along the main fault, before any displacement.
  double thickness_along_dip(double y) const {
    const auto on_fault = [&](std::uint32_t horizon) {
      double z = mid_z;
      for (int step = 0; step < 200; ++step) z = anticline_z(horizon, Anticline::line_x(1, y, z), y);
      return z;
    };
    return on_fault(2) - on_fault(1);
  }

  double main_throw_ = 0;
};

}  // namespace

std::unique_ptr<ColumnModel> anticline_model(std::string_view name) {
  if (name == "A1") return std::make_unique<Anticline>(std::vector<double>{});
  if (name == "A2") return std::make_unique<ParallelFaults>();
  if (name == "A3") return std::make_unique<LocalFaults>();
  if (name == "A4") return std::make_unique<GrowingThrows>(false);
  if (name == "A5") return std::make_unique<BranchingFaults>();
  STRATAFLOW_ASSERT(name == "A6", "not the name of an anticline model");
  return std::make_unique<GrowingThrows>(true);
}

}  // namespace strataflow
