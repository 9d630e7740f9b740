#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kernels/reference_models/reference_plans.h"

namespace strataflow {
namespace {

/// A fault of the network. It runs along one of six lines across or along the map, between two of fifteen stations:
/// 0 and 14 are sides of the box, 2, 4 … 12 the lines that run the other way, odd ones lie between them.
struct NetworkFault {
  bool runs_north = true;
  std::uint32_t line = 0;  ///< 1 … 6
  std::uint32_t from = 0, to = 0;
};

constexpr std::array<NetworkFault, 24> network{NetworkFault{true, 1, 0, 5},
                                               {true, 1, 8, 14},
                                               {true, 2, 3, 11},
                                               {true, 2, 13, 14},
                                               {true, 3, 0, 14},
                                               {true, 4, 1, 4},
                                               {true, 4, 7, 13},
                                               {true, 5, 2, 14},
                                               {true, 6, 0, 3},
                                               {true, 6, 5, 9},
                                               {true, 6, 11, 14},
                                               {false, 1, 0, 14},
                                               {false, 2, 3, 11},
                                               {false, 2, 13, 14},
                                               {false, 3, 0, 3},
                                               {false, 3, 6, 9},
                                               {false, 3, 11, 14},
                                               {false, 4, 0, 4},
                                               {false, 4, 7, 13},
                                               {false, 5, 1, 7},
                                               {false, 5, 9, 11},
                                               {false, 5, 13, 14},
                                               {false, 6, 0, 5},
                                               {false, 6, 8, 14}};

constexpr std::uint32_t lines = 6, stations = 15, horizon_count = 4;

/// 24 faults with throws of 10 to 60 m that cross (18 times), abut (6 times) and die out (25 ends). Map coordinates
/// are stations, 0 … 14; blocks are the squares between lines. Columns lean, and stations are bent, so that faults dip
/// and no two are parallel. A fault drops all of the blocks beyond it; its throw is zero at ends inside the box, so
/// that blocks fit again where it is not.
class FaultNetwork final : public ColumnModel {
 public:
  FaultNetwork() {
    box = {{0, 0, 0}, {12000, 10300, 1700}};
    for (std::uint32_t h = 1; h <= horizon_count; ++h) entities.push_back({"H" + std::to_string(h), Role::horizon});
    for (std::size_t f = 1; f <= network.size(); ++f) entities.push_back({"F" + std::to_string(f), Role::fault});
    top_ = static_cast<std::uint32_t>(entities.size());
    for (const char* side : {"Top", "Bottom", "North", "South", "East", "West"})
      entities.push_back({side, Role::boundary});
    std::vector<Level> levels{{top_ + 1, Cut::plain}};
    for (std::uint32_t h = 0; h < horizon_count; ++h) levels.push_back({h, Cut::plain});
    levels.push_back({top_, Cut::plain});
    blocks.assign((lines + 1) * (lines + 1), levels);
  }

  Vec3 at(std::uint32_t, const MapPoint& p, double z_m) const override {
    constexpr double last = stations - 1;
    const double u = p.a / last, v = p.b / last, free_x = 4 * u * (1 - u), free_y = 4 * v * (1 - v);
    const double down = 0.5 * box.high.z - z_m;
    return {box.high.x * u + free_x * (420 * wave(1.3 * v + 0.8 * u) + (0.35 + 0.2 * v) * down),
            box.high.y * v + free_y * (380 * wave(1.5 * u + 0.5) + (0.2 - 0.35 * u) * down), z_m};
  }

  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const override {
    if (level == 0) return box.low.z;
    if (level == horizon_count + 1) return box.high.z;
    double drop = 0;
    for (std::size_t f = 0; f < network.size(); ++f) {
      const std::uint32_t across = network[f].runs_north ? block % (lines + 1) : block / (lines + 1);
      if (across >= network[f].line) drop += throw_m(f, network[f].runs_north ? p.b : p.a);
    }
    double z = 0.5 * box.high.z;
    for (int step = 0; step < 200; ++step) {
      const Vec3 here = at(block, p, z);
      const double next = 330.0 * level + 90 * bump((here.x - 5500) / 7000) * bump((here.y - 4000) / 8000) - 60 - drop;
      if (next == z) break;
      z = next;
    }
    return z;
  }

  ColumnMap map(double edge_m) const override {
    ColumnMap map;
    const std::vector<double> a = divided(box.high.x, edge_m), b = divided(box.high.y, edge_m);
    const auto columns = static_cast<std::uint32_t>(a.size()), rows = static_cast<std::uint32_t>(b.size());
    for (const double north : b)
      for (const double east : a) map.points.push_back({east, north, 0});
    const auto point = [&](std::uint32_t i, std::uint32_t j) { return j * columns + i; };
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
      for (std::uint32_t i = 0; i + 1 < columns; ++i) {
        const std::uint32_t block = interval(b[j]) * (lines + 1) + interval(a[i]);
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
    constexpr double last = stations - 1;
    add_line(top_ + 2, false, last, 0, last);
    add_line(top_ + 3, false, 0, 0, last);
    add_line(top_ + 4, true, last, 0, last);
    add_line(top_ + 5, true, 0, 0, last);
    for (std::uint32_t f = 0; f < network.size(); ++f)
      add_line(horizon_count + f, network[f].runs_north, 2 * network[f].line, network[f].from, network[f].to);
    return map;
  }

  TriangleSoup raw_surfaces(double, double) const override { return {}; }

 private:
  /// The interval between lines that starts at or before a station.
  static std::uint32_t interval(double station) { return std::min(lines, static_cast<std::uint32_t>(station / 2)); }

  static std::vector<double> divided(double length_m, double edge_m) {
    const double parts = std::max(2.0, std::round(length_m / (stations - 1) / edge_m));
    std::vector<double> at;
    for (std::uint32_t s = 0; s + 1 < stations; ++s)
      for (double k = 0; k < parts; ++k) at.push_back(s + k / parts);
    at.push_back(stations - 1);
    return at;
  }

  /// Zero at ends inside the box and beyond, of one sign between.
  static double throw_m(std::size_t f, double station) {
    const NetworkFault& fault = network[f];
    if (station < fault.from || station > fault.to) return 0;
    // No two throws are equal: where faults cross, each of the four blocks has a height of its own.
    const double most = (10 + 9.7 * static_cast<double>(f * 5 % 6) + 0.13 * static_cast<double>(f)) *
                        ((fault.line + f) % 2 == 0 ? 1 : -1);
    const double t = (station - fault.from) / (fault.to - fault.from);
    const double south = fault.from == 0 ? 1 : t * (2 - t), north = fault.to == stations - 1 ? 1 : 1 - t * t;
    return most * south * north;
  }

  std::uint32_t top_ = 0;
};

}  // namespace

std::unique_ptr<ColumnModel> fault_network() { return std::make_unique<FaultNetwork>(); }

}  // namespace strataflow
