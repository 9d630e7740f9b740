#include <algorithm>
#include <string>

#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/section_model.h"

namespace strataflow {
namespace {

/// Five layers, 8 m thick and more.
class VariableLayers final : public SectionModel {
 public:
  VariableLayers() {
    box = {{0, 0, 0}, {2000, 1500, 600}};
    row_breaks = {0, 1500};
    entities = {{"H1", Role::horizon}, {"H2", Role::horizon}, {"H3", Role::horizon}, {"H4", Role::horizon}};
    close_with_box(1, {{0, Cut::plain}, {1, Cut::plain}, {2, Cut::plain}, {3, Cut::plain}});
  }

 private:
  double line_x(std::uint32_t line, double, double) const override { return line == 0 ? box.low.x : box.high.x; }

  double surface_z(std::uint32_t, std::uint32_t level, double, double x, double y, double) const override {
    const double second = 8 + 110 * bump((x - 600) / 800) * bump((y - 600) / 900);
    const double third = 95 - 80 * bump((x - 1100) / 700) * bump((y - 900) / 1100);
    const double fourth = 10 + 90 * bump((x - 1700) / 900) * bump((y - 300) / 1300);
    double z = 120 + 55 * wave(x / 800) * wave(y / 950 + 0.3);
    if (level > 1) z += second;
    if (level > 2) z += third;
    if (level > 3) z += fourth;
    return z;
  }
};

/// Fourteen steep veins, 6 to 20 m thick, through one horizon. Both walls of a vein are lines of the section.
class Veins final : public SectionModel {
 public:
  Veins() {
    box = {{0, 0, 0}, {10200, 1300, 280}};
    row_breaks = {0, 1300};
    entities = {{"H1", Role::horizon}};
    for (std::uint32_t line = 1; line <= 2 * vein_count; ++line) {
      const std::string name = "V" + std::to_string((line + 1) / 2) + (line % 2 == 1 ? "West" : "East");
      faults.push_back({line, static_cast<std::uint32_t>(entities.size()), 0, 1300, true, true, true, true});
      entities.push_back({name, Role::intrusion});
    }
    close_with_box(2 * vein_count + 1, {{0, Cut::plain}});
  }

 private:
  static constexpr std::uint32_t vein_count = 14;

  double line_x(std::uint32_t line, double y, double z) const override {
    if (line == 0) return box.low.x;
    if (line == block_count()) return box.high.x;
    const std::uint32_t vein = (line - 1) / 2;
    const double lean = 0.1 + 0.15 * wave(vein / 4.0), sway = 60 * wave(y / 1100 + vein / 3.0);
    const double thick = 13 + 7 * wave(y / 500 + vein / 5.0) * wave(z / 260 + 0.2);
    const double centre = box.high.x * (vein + 1) / (vein_count + 1) + lean * (z - 140) + sway;
    return centre + (line % 2 == 1 ? -0.5 : 0.5) * thick;
  }

  double surface_z(std::uint32_t, std::uint32_t, double, double x, double y, double) const override {
    return 140 + 45 * wave(x / 2300) + 15 * wave(y / 700 + 0.4);
  }
};

/// An old basin (U over H1) with a mound in it, filled by thin layers that thin out against it at three to six
/// degrees. H6 covers everything.
class Onlap final : public SectionModel {
 public:
  Onlap() {
    box = {{0, 0, 0}, {110, 65, 40}};
    row_breaks = {0, mound_y, 65};
    for (const char* name : {"H1", "H2", "H3", "H4", "H5", "H6"}) entities.push_back({name, Role::horizon});
    entities.push_back({"U", Role::unconformity});
    std::vector<Level> levels{{0, Cut::plain}, {6, Cut::cutter}};
    for (std::uint32_t horizon = 1; horizon < 6; ++horizon) levels.push_back({horizon, Cut::above_cutter});
    close_with_box(1, levels);
  }

 private:
  static constexpr double mound_x = 60, mound_y = 32, draped = 0.7;

  double line_x(std::uint32_t line, double, double) const override { return line == 0 ? box.low.x : box.high.x; }

  double surface_z(std::uint32_t, std::uint32_t level, double, double x, double y, double) const override {
    const double flank = 18 * ((x - mound_x) / 60) * ((x - mound_x) / 60);
    if (level == 1) return 3 + 0.8 * wave(x / 40) * wave(y / 30);
    if (level == 2) return 6 + flank + 1.8 * bump((x - mound_x) / 24) * bump((y - mound_y) / 31);
    constexpr std::array<double, 5> rise{7.2, 8.2, 8.95, 10.2, 22};
    return rise[level - 3] + draped * flank + 0.15 * wave(y / 20);
  }
};

/// 33 listric faults that root in a décollement (H1) and cut seven horizons above it, as in models of sand: twenty
/// dip east, thirteen west, with a graben between. Of three neighbours one is regional, one dies in the north and one
/// at both ends.
class Sandbox final : public SectionModel {
 public:
  Sandbox() {
    box = {{0, 0, 0}, {3500, 3000, 500}};
    for (std::uint32_t h = 1; h <= 8; ++h) entities.push_back({"H" + std::to_string(h), Role::horizon});
    std::vector<Level> levels;
    for (std::uint32_t h = 0; h < 8; ++h) levels.push_back({h, Cut::plain});
    row_breaks = {0, 3000};
    for (std::uint32_t f = 0; f < fault_count; ++f) {
      const bool dies_south = f % 3 == 2, dies_north = f % 3 != 0;
      const double south = dies_south ? 300 * (1 + f / 3 % 3) : 0, north = dies_north ? 1500 + 300 * (f / 2 % 5) : 3000;
      faults.push_back(
          {f + 1, static_cast<std::uint32_t>(entities.size()), south, north, !dies_south, !dies_north, true, true});
      entities.push_back({"F" + std::to_string(f + 1), Role::fault});
      row_breaks.insert(row_breaks.end(), {south, north});
    }
    std::sort(row_breaks.begin(), row_breaks.end());
    row_breaks.erase(std::unique(row_breaks.begin(), row_breaks.end()), row_breaks.end());
    close_with_box(fault_count + 1, levels);
  }

 private:
  static constexpr std::uint32_t fault_count = 33, eastward = 20;
  static constexpr double flat_z = 50, spacing = 84, reach = 250;

  double line_x(std::uint32_t line, double y, double z) const override {
    if (line == 0) return box.low.x;
    if (line == block_count()) return box.high.x;
    const bool dips_east = line <= eastward;
    const double at_top = dips_east ? 100 + spacing * (line - 1) : 2350 + spacing * (line - eastward - 1);
    const double down = std::min(1.0, (box.high.z - z) / (box.high.z - flat_z));
    return at_top + 20 * wave(y / 1300) + (dips_east ? reach : -reach) * down * down;
  }

  /// 0 at tips and beyond, positive between.
  double throw_m(const SectionFault& fault, double y) const {
    if (y < fault.south_m || y > fault.north_m) return 0;
    const double most = 3 + 1.3 * (fault.line * 7 % 4);
    const double south = (y - fault.south_m) / (fault.north_m - fault.south_m);
    if (!fault.touches_south) return most * 4 * south * (1 - south);
    return fault.touches_north ? most : most * (1 - south * south);
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double x, double y, double) const override {
    if (level == 1) return flat_z;
    double z = 176 + 43 * (level - 2) + 6 * wave(x / 900) * wave(y / 1100 + 0.2);
    for (std::uint32_t f = 0; f < block; ++f) z += (f < eastward ? -1 : 1) * throw_m(faults[f], y);
    return z;
  }

  std::array<double, 2> fault_span(const SectionFault&, double) const override { return {flat_z, box.high.z}; }
  bool cuts_level(const SectionFault&, const Level& level) const override { return level.entity > 0; }
};

}  // namespace

std::unique_ptr<ColumnModel> variable_layers() { return std::make_unique<VariableLayers>(); }
std::unique_ptr<ColumnModel> veins() { return std::make_unique<Veins>(); }
std::unique_ptr<ColumnModel> onlap() { return std::make_unique<Onlap>(); }
std::unique_ptr<ColumnModel> sandbox() { return std::make_unique<Sandbox>(); }

}  // namespace strataflow
