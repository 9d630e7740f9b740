#include "kernels/reference_models/extrudable_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/internal_error.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/section_model.h"

namespace strataflow {
namespace {

/// A vertical fault along a line of the grid of stations, between two stations.
struct StationFault {
  bool runs_north = true;
  std::uint32_t line = 0;
  std::uint32_t from = 0, to = 0;
  bool abuts_from = false, abuts_to = false;  ///< ends on another fault with its throw, instead of dying out
  double throw_m = 0;
};

constexpr std::uint32_t last_station = 12;
constexpr double reach = 3;  // stations beside a fault that it displaces, no more than what it abuts is long
constexpr std::array<StationFault, 12> station_faults{StationFault{true, 5, 0, 12, false, false, 30},
                                                      {false, 7, 2, 10, false, false, 24},
                                                      {false, 4, 0, 5, false, true, -26},
                                                      {true, 8, 0, 4, false, false, 22},
                                                      {true, 10, 3, 9, false, false, -20},
                                                      {true, 2, 4, 12, true, false, 18},
                                                      {false, 9, 5, 12, true, false, 16},
                                                      {true, 9, 9, 12, true, false, -14},
                                                      {false, 2, 6, 12, false, false, 20},
                                                      {true, 3, 0, 2, false, false, -16},
                                                      {false, 10, 0, 4, false, false, 14},
                                                      {true, 11, 0, 2, false, false, 12}};
constexpr std::uint32_t horizon_count = 3;

class VerticalFaults final : public ColumnModel {
 public:
  VerticalFaults(std::uint32_t faults, bool is_bent) : fault_count_(faults), is_bent_(is_bent) {
    STRATAFLOW_ASSERT(faults <= station_faults.size(), "at most twelve vertical faults");
    box = {{0, 0, 0}, {1600, 1200, 400}};
    for (std::uint32_t h = 1; h <= horizon_count; ++h) entities.push_back({"H" + std::to_string(h), Role::horizon});
    for (std::uint32_t f = 1; f <= faults; ++f) entities.push_back({"F" + std::to_string(f), Role::fault});
    top_ = static_cast<std::uint32_t>(entities.size());
    for (const char* side : {"Top", "Bottom", "North", "South", "East", "West"})
      entities.push_back({side, Role::boundary});
    std::vector<Level> levels{{top_ + 1, Cut::plain}};
    for (std::uint32_t h = 0; h < horizon_count; ++h) levels.push_back({h, Cut::plain});
    levels.push_back({top_, Cut::plain});
    blocks.assign(last_station * last_station, levels);  // one per square between stations
  }

  Vec3 at(std::uint32_t, const MapPoint& p, double z_m) const override {
    const double u = p.a / last_station, v = p.b / last_station;
    const double bend = is_bent_ ? 1.0 : 0.0;
    return {box.high.x * u + bend * 4 * u * (1 - u) * (90 * wave(1.2 * v + 0.6 * u) + 120 * (v - 0.5)),
            box.high.y * v + bend * 4 * v * (1 - v) * (70 * wave(1.4 * u + 0.5) - 100 * (u - 0.5)), z_m};
  }

  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const override {
    if (level == 0) return box.low.z;
    if (level == horizon_count + 1) return box.high.z;
    double z = 100.0 * level + 12 * wave(p.a / 7 + 0.2) * wave(p.b / 9 + 0.1 * level);
    for (std::uint32_t f = 0; f < fault_count_; ++f) {
      const StationFault& fault = station_faults[f];
      const std::uint32_t east = block % last_station, north = block / last_station;
      const std::uint32_t across = fault.runs_north ? east : north, along = fault.runs_north ? north : east;
      if (along < fault.from || along >= fault.to) continue;
      const double away = ((fault.runs_north ? p.a : p.b) - fault.line) / reach;
      const double side = across >= fault.line ? -0.5 : 0.5;
      z += side * throw_m(fault, fault.runs_north ? p.b : p.a) * bump(away);
    }
    return z;
  }

  ColumnMap map(double edge_m) const override {
    ColumnMap map;
    const auto divided = [&](double length_m) {
      const double parts = std::max(2.0, std::round(length_m / last_station / edge_m));
      std::vector<double> at;
      for (std::uint32_t s = 0; s < last_station; ++s)
        for (double k = 0; k < parts; ++k) at.push_back(s + k / parts);
      at.push_back(last_station);
      return at;
    };
    const std::vector<double> a = divided(box.high.x), b = divided(box.high.y);
    const auto columns = static_cast<std::uint32_t>(a.size()), rows = static_cast<std::uint32_t>(b.size());
    for (const double north : b)
      for (const double east : a) map.points.push_back({east, north, 0});
    const auto point = [&](std::uint32_t i, std::uint32_t j) { return j * columns + i; };
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
      for (std::uint32_t i = 0; i + 1 < columns; ++i) {
        const auto block = static_cast<std::uint32_t>(b[j]) * last_station + static_cast<std::uint32_t>(a[i]);
        map.triangles.push_back({{point(i, j), point(i + 1, j), point(i + 1, j + 1)}, block});
        map.triangles.push_back({{point(i, j), point(i + 1, j + 1), point(i, j + 1)}, block});
      }
    const std::array<double, 2> low{box.low.z, box.low.z}, high{box.high.z, box.high.z};
    const auto add_line = [&](std::uint32_t entity, bool runs_north, double at, double from, double to) {
      for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
          const double across = runs_north ? a[i] : b[j], along = runs_north ? b[j] : a[i];
          if (across != at || along < from || along >= to) continue;
          map.walls.push_back({{point(i, j), runs_north ? point(i, j + 1) : point(i + 1, j)}, entity, low, high});
        }
    };
    add_line(top_ + 2, false, last_station, 0, last_station);
    add_line(top_ + 3, false, 0, 0, last_station);
    add_line(top_ + 4, true, last_station, 0, last_station);
    add_line(top_ + 5, true, 0, 0, last_station);
    for (std::uint32_t f = 0; f < fault_count_; ++f) {
      const StationFault& fault = station_faults[f];
      add_line(horizon_count + f, fault.runs_north, fault.line, fault.from, fault.to);
    }
    return map;
  }

  TriangleSoup raw_surfaces(double, double) const override { return {}; }

 private:
  /// Full at sides of the box and where the fault abuts, zero where it dies out.
  static double throw_m(const StationFault& fault, double station) {
    const double t = (station - fault.from) / (fault.to - fault.from);
    const bool is_full_first = fault.from == 0 || fault.abuts_from;
    const bool is_full_last = fault.to == last_station || fault.abuts_to;
    return fault.throw_m * (is_full_first ? 1 : t * (2 - t)) * (is_full_last ? 1 : 1 - t * t);
  }

  std::uint32_t fault_count_ = 0, top_ = 0;
  bool is_bent_ = false;
};

/// Blocks side by side, each lower than the one west of it, between lines that do not depend on y.
class BlockRow : public SectionModel {
 public:
  BlockRow(const Vec3& size, double middle_y, std::uint32_t fault_count, std::vector<Level> levels, double throw_m)
      : throw_m_(throw_m) {
    box = {{0, 0, 0}, size};
    row_breaks = {0, middle_y, size.y};
    for (std::uint32_t f = 1; f <= fault_count; ++f) {
      faults.push_back({f, static_cast<std::uint32_t>(levels.size()) + f - 1, 0, size.y, true, true, true, true});
      fault_names_.push_back({"F" + std::to_string(f), Role::fault});
    }
    levels_ = std::move(levels);
  }

 protected:
  /// To be called once the horizons are in `entities`.
  void add_faults() {
    entities.insert(entities.end(), fault_names_.begin(), fault_names_.end());
    close_with_box(static_cast<std::uint32_t>(faults.size()) + 1, levels_);
  }
  double drop_m(std::uint32_t block) const { return throw_m_ * block; }

 private:
  std::vector<Entity> fault_names_;
  std::vector<Level> levels_;
  double throw_m_ = 0;
};

class DippingFaults : public BlockRow {
 public:
  DippingFaults(std::span<const double> cot_dips, double throw_m)
      : BlockRow({2000, 1000, 400}, 500, static_cast<std::uint32_t>(cot_dips.size()),
                 {{0, Cut::plain}, {1, Cut::plain}}, throw_m),
        cot_dips_(cot_dips.begin(), cot_dips.end()) {
    entities = {{"H1", Role::horizon}, {"H2", Role::horizon}};
    add_faults();
  }

 private:
  double line_x(std::uint32_t line, double, double z) const override {
    if (line == 0) return box.low.x;
    if (line == block_count()) return box.high.x;
    return box.high.x * line / block_count() + cot_dips_[line - 1] * (0.5 * box.high.z - z);
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double x, double y, double) const override {
    return 90 + 130 * (level - 1.0) + 10 * wave(x / 900) * wave(y / 700 + 0.3) + 30 - drop_m(block);
  }

  std::vector<double> cot_dips_;
};

class ListricFault final : public BlockRow {
 public:
  ListricFault() : BlockRow({2000, 1000, 400}, 500, 1, {{0, Cut::plain}, {1, Cut::plain}}, 25) {
    entities = {{"H1", Role::horizon}, {"H2", Role::horizon}};
    add_faults();
  }

 private:
  double line_x(std::uint32_t line, double, double z) const override {
    if (line == 0) return box.low.x;
    if (line == 2) return box.high.x;
    constexpr double cot_80_deg = 0.17632698070846498, cot_20_deg = 2.7474774194546222;
    const double down = (box.high.z - z) / box.high.z;
    return 600 + box.high.z * (cot_80_deg * down + 0.5 * (cot_20_deg - cot_80_deg) * down * down);
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double, double y, double) const override {
    return 20 + 125 * (level - 0.0) + 8 * wave(y / 700 + 0.3) - drop_m(block);
  }
};

class Unconformity final : public BlockRow {
 public:
  explicit Unconformity(bool has_fault)
      : BlockRow({1600, 1000, 540}, 500, has_fault ? 1 : 0,
                 {{0, Cut::plain}, {1, Cut::below_cutter}, {2, Cut::below_cutter}, {3, Cut::cutter}, {4, Cut::plain}},
                 15) {
    entities = {{"H1", Role::horizon},
                {"H2", Role::horizon},
                {"H3", Role::horizon},
                {"E", Role::unconformity},
                {"H4", Role::horizon}};
    add_faults();
  }

 private:
  double line_x(std::uint32_t line, double, double z) const override {
    if (line == 0) return box.low.x;
    if (line == block_count()) return box.high.x;
    return 700 + 0.3 * (250 - z);
  }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double x, double y, double) const override {
    if (level == 4) return 285 + 8 * wave(x / 1100) + 5 * wave(y / 900);
    if (level == 5) return 460 + 8 * wave(x / 900 + 0.4);
    return 40 + 90 * (level - 1.0) + 0.12 * x + 0.03 * y - drop_m(block);
  }
};

class ThinLayers final : public BlockRow {
 public:
  ThinLayers()
      : BlockRow({1000, 1000, 300}, 500, 1, {{0, Cut::plain}, {1, Cut::plain}, {2, Cut::plain}, {3, Cut::plain}}, 5) {
    for (const char* name : {"H1", "H2", "H3", "H4"}) entities.push_back({name, Role::horizon});
    add_faults();
  }

 private:
  double line_x(std::uint32_t line, double, double) const override { return 500.0 * line; }

  double surface_z(std::uint32_t block, std::uint32_t level, double, double x, double y, double) const override {
    constexpr std::array<double, 5> up{0, 0, 1, 1.1, 1.11};
    return 150 + up[level] + 0.02 * x + 6 * wave(x / 700) * wave(y / 800 + 0.2) - drop_m(block);
  }
};

}  // namespace

std::unique_ptr<ColumnModel> vertical_faults(std::uint32_t faults, bool is_bent) {
  return std::make_unique<VerticalFaults>(faults, is_bent);
}
std::unique_ptr<ColumnModel> dipping_faults(std::span<const double> cot_dips, double throw_m) {
  return std::make_unique<DippingFaults>(cot_dips, throw_m);
}
std::unique_ptr<ColumnModel> listric_fault() { return std::make_unique<ListricFault>(); }
std::unique_ptr<ColumnModel> unconformity(bool has_fault) { return std::make_unique<Unconformity>(has_fault); }
std::unique_ptr<ColumnModel> thin_layers() { return std::make_unique<ThinLayers>(); }

}  // namespace strataflow
