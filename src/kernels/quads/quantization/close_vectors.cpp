#include "kernels/quads/quantization/close_vectors.h"

#include <algorithm>

namespace strataflow {
namespace {

std::int64_t along(GaussianInteger z, int a) {
  switch (a & 3) {
    case 0:
      return z.re;
    case 1:
      return z.im;
    case 2:
      return -z.re;
    default:
      return -z.im;
  }
}

class Closer {
 public:
  Closer(const FlatMesh& mesh, const std::vector<std::uint8_t>& fixed, std::vector<GaussianInteger>& vectors)
      : mesh_(mesh),
        fixed_(fixed),
        vectors_(vectors),
        sum_(vectors.size() / 3),
        seen_(4 * sum_.size(), 0),
        reached_by_(4 * sum_.size()) {
    for (std::size_t h = 0; h < vectors.size(); ++h) sum_[h / 3] = sum_[h / 3] + vectors[h];
  }

  bool run() {
    for (std::uint32_t node = 0; node < 4 * sum_.size(); ++node)
      while (along(sum_[node / 4], node % 4) < 0)
        if (!fill(node)) return false;
    return true;
  }

 private:
  /// Brings steps to a node that lacks them from the nearest one that has too many.
  bool fill(std::uint32_t start) {
    const std::int64_t lacking = -along(sum_[start / 4], start % 4);
    ++round_;
    queue_.assign(1, start);
    seen_[start] = round_;
    bool meets_itself = false;
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      const std::uint32_t node = queue_[at], t = node / 4;
      const int a = static_cast<int>(node % 4);
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (!may_change(fixed_[h], a)) continue;
        const std::uint32_t opposite = mesh_.opposite[h];
        if (opposite == FlatMesh::outside) {
          vectors_[h] = vectors_[h] + turned(GaussianInteger{lacking, 0}, a);
          carry(start, node, lacking);
          return true;
        }
        const std::uint32_t reached = 4 * (opposite / 3) + ((node - mesh_.turns[h]) & 3u);
        if (seen_[reached] == round_) continue;
        seen_[reached] = round_;
        reached_by_[reached] = h;
        queue_.push_back(reached);
        if (reached == (start ^ 2u)) {
          meets_itself = true;
          continue;
        }
        const std::int64_t spare = along(sum_[reached / 4], static_cast<int>(reached % 4));
        if (spare <= 0) continue;
        const std::int64_t amount = std::min(lacking, spare);
        take(reached, amount);
        carry(start, reached, amount);
        return true;
      }
    }
    if (!meets_itself || lacking < 2) return false;
    take(start ^ 2u, lacking / 2);
    carry(start, start ^ 2u, lacking / 2);
    return true;
  }

  void take(std::uint32_t node, std::int64_t amount) {
    sum_[node / 4] = sum_[node / 4] - turned(GaussianInteger{amount, 0}, static_cast<int>(node % 4));
  }

  /// Adds `amount` along the path found from `start` to `node`.
  void carry(std::uint32_t start, std::uint32_t node, std::int64_t amount) {
    take(start, -amount);
    while (node != start) {
      const std::uint32_t h = reached_by_[node], opposite = mesh_.opposite[h];
      const int arriving = static_cast<int>(node % 4), leaving = (arriving + mesh_.turns[h]) & 3;
      vectors_[h] = vectors_[h] + turned(GaussianInteger{amount, 0}, leaving);
      vectors_[opposite] = vectors_[opposite] - turned(GaussianInteger{amount, 0}, arriving);
      node = 4 * (h / 3) + static_cast<std::uint32_t>(leaving);
    }
  }

  const FlatMesh& mesh_;
  const std::vector<std::uint8_t>& fixed_;
  std::vector<GaussianInteger>& vectors_;
  std::vector<GaussianInteger> sum_;       // per triangle
  std::vector<std::uint32_t> seen_;        // per node 4·t + a: the round that reached it
  std::vector<std::uint32_t> reached_by_;  // per node: half-edge crossed
  std::vector<std::uint32_t> queue_;
  std::uint32_t round_ = 0;
};

}  // namespace

bool close_vectors(const FlatMesh& mesh, const std::vector<std::uint8_t>& fixed,
                   std::vector<GaussianInteger>& vectors) {
  return Closer(mesh, fixed, vectors).run();
}

}  // namespace strataflow
