#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/cutting/cut_surfaces.h"
#include "kernels/sealing/extend_borders.h"
#include "model/cut_result.h"
#include "model/triangle_soup.h"

namespace strataflow {

struct SealSurfacesOptions {
  std::optional<double> distance_m =
      std::nullopt;                        ///< gaps and overshoots up to this are mended; absent: `distance_ratio`
  double distance_ratio = 0.01;            ///< of the diagonal of all surfaces
  std::vector<std::string> contacts = {};  ///< by name, as `name_contacts` reads them: "H2 -> F3 within 25"
  bool trim = true;                        ///< take away what juts out past contacts, up to the distance
  bool trim_outside = true;                ///< and what lies outside the boundary surfaces, whatever its size
  /// Regions smaller than this are merged with a neighbour. Absent: the cube of a tenth of the sealing distance, and
  /// slivers: less than 1e-5 of the whole volume and on average thinner than a twentieth of the sealing distance.
  std::optional<double> micro_region_volume_m3 = std::nullopt;
  int passes = 6;                       ///< of extending and cutting, each reaching further than the last
  double point_tolerance_ratio = 1e-9;  ///< of the diagonal: points of intersection nearer than this are one
};

/// From surfaces that stop short of each other, cross, or jut out, to surfaces that conform. Contacts that are named or
/// found within the distance are made first (euler1999 §2.4), then everything is cut along everything, exactly (§2.4.9:
/// constrained before clean), and what juts out past contacts is trimmed. Borders that still stop short are extended
/// and cut again, while that closes gaps. Regions too small to mean anything are merged with a neighbour. Borders that
/// end further away are left: a fault that dies inside the model stays a dying fault. Everything done is in `changes`.
Result<CutResult> seal_surfaces(const TriangleSoup& soup, const CutSurfacesOptions& cut = {},
                                const SealSurfacesOptions& options = {});

/// The same from surfaces whose contacts are made already and that are cut: trims, extends what still stops short,
/// merges micro-regions. The report goes on from that of the cut.
Result<CutResult> seal_cut_surfaces(const CutResult& cut, const CutSurfacesOptions& cutting = {},
                                    const SealSurfacesOptions& options = {});

/// Which gaps may be larger than others: the contacts of the form "A -> B within d".
std::vector<NamedContact> contacts_with_distance(const std::vector<std::string>& contacts);

/// The sealing distance in metres that the options mean for these surfaces.
double sealing_distance_m(const TriangleSoup& soup, const SealSurfacesOptions& options);

}  // namespace strataflow
