#pragma once
#include <complex>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/quantization/flat_mesh.h"

namespace strataflow {

/// What integer vectors should be near to, and what of them must become a given number.
struct VectorTargets {
  std::vector<std::complex<double>> map;     ///< per half-edge: the map's vector, quads, in its chart (ω_sub unscaled)
  std::vector<std::complex<double>> wanted;  ///< per half-edge: the same where no goal says otherwise
  std::vector<std::uint8_t> goals;           ///< per half-edge: fixed_real, fixed_imaginary where `goal` counts
  std::vector<GaussianInteger> goal;         ///< per half-edge
  std::vector<std::uint8_t> least;           ///< per half-edge: shortest length allowed, in quads along its axis
};

/// Targets of a map scaled by `quads_per_unit`: the vectors themselves, 0 where an axis asks for it (S43). A feature
/// that returns to its only point must be three quads long, and of features with the same two ends all but one two, or
/// quads would share edges with themselves.
VectorTargets targets_of(const FlatMesh& mesh, double quads_per_unit);

struct IntegerVectors {
  std::vector<GaussianInteger> vectors;  ///< per half-edge: closed, seamed, every triangle positive
  int doublings = 0;                     ///< n of coudert2024 S40: the map was started 2^n times as large
  std::uint32_t operations = 0;          ///< atomic operations applied
  std::uint64_t searches = 0;            ///< shortest path searches
  double energy_before = 0, energy = 0;  ///< formula (4.7) after the start and in the end
  std::vector<std::uint32_t> unmet;      ///< half-edges whose goal could not be met, ascending
};

struct OptimiseOptions {
  bool only_start = false;  ///< stop at the first valid vectors
};

/// Algorithm 5 (S39–S42): valid Gaussian integer vectors near `targets.wanted`. Descent by closed walks in the dual of
/// the 4-sheet covering, and walks from boundary to boundary. Against its cost of O(H^2.5): steps of 2^n, …, 2, 1
/// instead of 1; searches start only at half-edges that gain, since every walk that lowers the energy has one, and
/// stop where they lose four times that gain; a search for negative cycles by true energies ends each round, in place
/// of a full pass, and finds what the bound cut off; a search that failed waits until something it looked at changes.
/// Fails with geometry_failed if no start is valid.
Result<IntegerVectors> optimise_vectors(const FlatMesh& mesh, const VectorTargets& targets,
                                        const OptimiseOptions& options = {});

/// Formula (4.7), normalised by the lengths in `mesh`; parts with a goal count 16-fold.
double vector_energy(const FlatMesh& mesh, const VectorTargets& targets, const std::vector<GaussianInteger>& vectors);

}  // namespace strataflow
