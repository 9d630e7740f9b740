#include "kernels/simulation_grid/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace strataflow {

namespace {
/// Packs in a box of `width` places; every rectangle brings an empty column on its right and an empty row above.
Packing pack_below_skyline(const std::vector<std::array<std::uint32_t, 2>>& sizes,
                           const std::vector<std::uint32_t>& order, std::uint32_t width) {
  Packing packing{{}, std::vector<std::array<std::uint32_t, 2>>(sizes.size())};
  std::vector<std::uint32_t> skyline(width + 1);
  for (const std::uint32_t r : order) {
    const std::uint32_t w = sizes[r][0] + 1, h = sizes[r][1] + 1;
    std::tuple best{std::numeric_limits<std::uint64_t>::max(), std::uint32_t{0}, std::uint32_t{0}};  // top² + waste, x
    for (std::uint32_t x = 0; x + w <= skyline.size(); ++x) {
      std::uint32_t base = 0;
      std::uint64_t below = 0;
      for (std::uint32_t n = x; n < x + w; ++n) base = std::max(base, skyline[n]), below += skyline[n];
      best = std::min(best, std::tuple{std::uint64_t{base} * w - below, base, x});
    }
    const auto [waste, base, x] = best;
    packing.places[r] = {x, base};
    std::fill(skyline.begin() + x, skyline.begin() + x + w, base + h);
    packing.size = {std::max(packing.size[0], x + w - 1), std::max(packing.size[1], base + h - 1)};
  }
  return packing;
}
}  // namespace

Packing pack_rectangles(const std::vector<std::array<std::uint32_t, 2>>& sizes) {
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(sizes[b][1], sizes[b][0], a) < std::tie(sizes[a][1], sizes[a][0], b);
  });
  double area = 0;
  std::uint32_t widest = 1;
  for (const auto& size : sizes) area += (size[0] + 1.0) * (size[1] + 1.0), widest = std::max(widest, size[0]);
  Packing best;
  std::uint64_t best_area = std::numeric_limits<std::uint64_t>::max();
  for (int step = 0; step < 8; ++step) {
    const auto width = std::max(widest, static_cast<std::uint32_t>(std::ceil(std::sqrt(area) * (0.8 + 0.15 * step))));
    Packing packing = pack_below_skyline(sizes, order, width);
    const std::uint64_t box = std::uint64_t{packing.size[0]} * packing.size[1];
    if (box < best_area) best_area = box, best = std::move(packing);
  }
  return best;
}

Packing line_up_rectangles(const std::vector<std::array<std::uint32_t, 2>>& sizes) {
  Packing packing;
  std::uint32_t x = 0;
  for (const auto& size : sizes) {
    packing.places.push_back({x, 0});
    packing.size = {x + size[0], std::max(packing.size[1], size[1])};
    x += size[0] + 1;
  }
  return packing;
}

}  // namespace strataflow
