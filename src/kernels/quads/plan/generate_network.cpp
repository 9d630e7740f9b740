#include "kernels/quads/plan/generate_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/seed.h"

namespace strataflow {

namespace {

constexpr double side_m = 1000;

class NetworkMaker {
 public:
  explicit NetworkMaker(std::uint32_t index) : random_(mix64(index) ^ 0x6e6574776f726bULL) {
    network_.edge_length_m = uniform(18, 40);
  }

  GeneratedNetwork take(const std::string& name) {
    network_.name = name;
    return std::move(network_);
  }

  double uniform(double low, double high) { return low + (high - low) * random_.unit(); }
  int count(int low, int high) {
    return low + static_cast<int>(random_.below(static_cast<std::uint64_t>(high - low + 1)));
  }
  Vec3 inside(double margin) { return {uniform(margin, side_m - margin), uniform(margin, side_m - margin), 0}; }
  static Vec3 towards(const Vec3& from, double angle, double away) {
    return from + away * Vec3{std::cos(angle), std::sin(angle), 0};
  }
  void angle_is(double deg) { network_.smallest_angle_deg = std::min(network_.smallest_angle_deg, deg); }

  void add(Role role, std::vector<Vec3> points, bool is_closed = false) {
    const std::string what = role == Role::fault ? "fault " : role == Role::hole ? "hole " : "curve ";
    network_.lines.push_back({what + std::to_string(network_.lines.size() + 1), role, std::move(points), is_closed});
  }
  void fault(std::vector<Vec3> points) { add(Role::fault, std::move(points)); }

  void square() { outline({{0, 0, 0}, {side_m, 0, 0}, {side_m, side_m, 0}, {0, side_m, 0}}); }
  void outline(std::vector<Vec3> points) {
    network_.lines.push_back({"outline", Role::outline, std::move(points), true});
  }
  /// A star-shaped outline with gentle or crooked sides.
  void crooked_outline() {
    std::vector<Vec3> points;
    const int n = count(8, 30);
    for (int i = 0; i < n; ++i)
      points.push_back(towards({500, 500, 0}, 2 * std::numbers::pi * (i + uniform(-0.3, 0.3)) / n, uniform(430, 520)));
    outline(std::move(points));
  }
  /// A fault that bends a little at each step.
  std::vector<Vec3> winding(Vec3 from, double angle, double length_m, double bend) {
    std::vector<Vec3> points{from};
    const int n = count(3, 12);
    for (int i = 0; i < n; ++i) {
      points.push_back(towards(points.back(), angle, length_m / n));
      angle += uniform(-bend, bend);
    }
    std::erase_if(points, [](const Vec3& p) { return p.x < 5 || p.x > side_m - 5 || p.y < 5 || p.y > side_m - 5; });
    return points;
  }
  std::vector<Vec3> ring(const Vec3& centre, double radius, int n, double roughness) {
    std::vector<Vec3> points;
    for (int i = 0; i < n; ++i)
      points.push_back(towards(centre, 2 * std::numbers::pi * i / n, radius * uniform(1 - roughness, 1 + roughness)));
    return points;
  }
  void well(const Vec3& at) {
    network_.point_sets.push_back({"well " + std::to_string(network_.point_sets.size() + 1), Role::well, {at}, {}});
  }

 private:
  RandomStream random_;
  GeneratedNetwork network_;
};

void random_faults(NetworkMaker& make) {
  make.square();
  for (int i = make.count(1, 10); i > 0; --i) make.fault({make.inside(60), make.inside(60)});
}

/// Faults through one point, or nearly, at small angles.
void acute_fan(NetworkMaker& make) {
  make.square();
  const Vec3 centre = make.inside(350);
  double angle = make.uniform(0, std::numbers::pi);
  const int faults = make.count(2, 4);
  for (int i = 0; i < faults; ++i) {
    make.fault({NetworkMaker::towards(centre, angle, -make.uniform(150, 300)),
                NetworkMaker::towards(centre, angle, make.uniform(150, 300))});
    const double deg = make.uniform(2, 35);
    make.angle_is(deg);
    angle += deg * std::numbers::pi / 180;
  }
}

/// Ends that stop just short of, or just past, another fault; faults side by side.
void near_misses(NetworkMaker& make) {
  make.square();
  const double y = make.uniform(350, 650);
  make.fault({{80, y, 0}, {920, y + make.uniform(-60, 60), 0}});
  for (int i = make.count(2, 9); i > 0; --i) {
    const double x = 100.0 + 85 * i, miss = make.uniform(-6, 12), lean = make.uniform(-120, 120);
    const bool is_above = make.count(0, 1) == 1;
    make.fault({{x, is_above ? y + 30 + miss : y - 30 - miss, 0},
                {x + lean, is_above ? make.uniform(y + 150, 950) : make.uniform(50, y - 150), 0}});
  }
  const double gap = make.uniform(4, 30);
  make.fault({{120, y - 40 - gap, 0}, {500, y - 45 - gap, 0}, {880, y - 42 - gap, 0}});
}

void ladder(NetworkMaker& make) {
  make.square();
  const double left = make.uniform(200, 350), right = make.uniform(650, 800), lean = make.uniform(-80, 80);
  make.fault({{left, 0, 0}, {left + lean, side_m, 0}});
  make.fault({{right, 0, 0}, {right + lean, side_m, 0}});
  const int rungs = make.count(2, 12);
  for (int i = 0; i < rungs; ++i) {
    const double y = side_m * (i + 1) / (rungs + 1), tilt = make.uniform(-30, 30), part = y / side_m,
                 part2 = (y + tilt) / side_m;
    make.fault({{left + lean * part, y, 0}, {right + lean * part2, y + tilt, 0}});
  }
}

void crossings(NetworkMaker& make) {
  make.square();
  const int n = make.count(1, 6), m = make.count(1, 6);
  for (int i = 0; i < n; ++i) {
    const double x = side_m * (i + 1) / (n + 1);
    make.fault({{x + make.uniform(-40, 40), make.uniform(20, 120), 0},
                {x + make.uniform(-40, 40), make.uniform(880, 980), 0}});
  }
  for (int i = 0; i < m; ++i) {
    const double y = side_m * (i + 1) / (m + 1);
    make.fault({{make.uniform(20, 120), y + make.uniform(-40, 40), 0},
                {make.uniform(880, 980), y + make.uniform(-40, 40), 0}});
  }
}

/// Many faults that die inside, some close to the outline.
void dying_tips(NetworkMaker& make) {
  make.square();
  const int faults = make.count(3, 30);
  const double strike = make.uniform(0, std::numbers::pi);
  for (int i = 0; i < faults; ++i)
    make.fault({make.winding(make.inside(20), strike + make.uniform(-0.5, 0.5), make.uniform(60, 350), 0.25)});
}

void loops(NetworkMaker& make) {
  make.square();
  for (int i = make.count(1, 4); i > 0; --i)
    make.add(Role::curve, make.ring(make.inside(250), make.uniform(60, 200), make.count(6, 24), 0.1), true);
  for (int i = make.count(0, 4); i > 0; --i) make.fault({make.inside(60), make.inside(60)});
}

void holes(NetworkMaker& make) {
  make.square();
  const std::array<Vec3, 4> centres{Vec3{250, 250, 0}, {750, 250, 0}, {750, 750, 0}, {250, 750, 0}};
  const int n = make.count(1, 4);
  for (int i = 0; i < n; ++i)
    make.add(Role::hole,
             make.ring(centres[static_cast<std::size_t>(i)], make.uniform(50, 170), make.count(4, 20), 0.15), true);
  for (int i = make.count(0, 5); i > 0; --i) make.fault({make.inside(40), make.inside(40)});
}

void wells(NetworkMaker& make) {
  make.square();
  for (int i = make.count(1, 6); i > 0; --i) make.well(make.inside(100));
  for (int i = make.count(0, 5); i > 0; --i) make.fault({make.inside(60), make.inside(60)});
}

void crooked(NetworkMaker& make) {
  make.crooked_outline();
  for (int i = make.count(1, 8); i > 0; --i)
    make.fault(make.winding(make.inside(200), make.uniform(0, 2 * std::numbers::pi), make.uniform(150, 600), 0.35));
}

}  // namespace

GeneratedNetwork generate_network(std::uint32_t index) {
  struct Family {
    const char* name;
    void (*make)(NetworkMaker&);
  };
  constexpr std::array<Family, network_family_count> families{Family{"random faults", random_faults},
                                                              {"acute fan", acute_fan},
                                                              {"near misses", near_misses},
                                                              {"ladder", ladder},
                                                              {"crossings", crossings},
                                                              {"dying tips", dying_tips},
                                                              {"loops", loops},
                                                              {"holes", holes},
                                                              {"wells", wells},
                                                              {"crooked outline", crooked}};
  const Family& family = families[index % network_family_count];
  NetworkMaker make(index);
  family.make(make);
  return make.take(std::string(family.name) + " " + std::to_string(index / network_family_count + 1));
}

}  // namespace strataflow
