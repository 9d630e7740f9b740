#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/contacts/contact_constraints.h"
#include "kernels/contacts/find_borders.h"

namespace strataflow {

struct FindContactsOptions {
  double distance_m = 0;   ///< a border further from a surface than this does not belong to it
  double sag_ratio = 0.1;  ///< and by this share of its edges more: what different meshes of curved surfaces differ by
  double facing_deg = 5;   ///< a border that goes on at less than this angle to a surface runs beside it
  BorderOptions borders = {};
};

/// How far a border of ContactConstraints is from its controller before the cut.
struct ContactGap {
  double max_gap_m = 0;
  Vec3 where;               ///< where that is, on the border, relative to the soup's local origin
  bool overshoots = false;  ///< it ends behind its controller
};

struct FoundContacts {
  ContactConstraints constraints;
  std::vector<ContactGap> gaps;  ///< per border of `constraints`
};

/// Contacts that surfaces nearly make: every border between stones all of whose edges lie within the distance of other
/// entities and face them, or one of which is on them in part already; divided where it passes from one to the next, so
/// that the area between and a fee of distance_m² for each passage are least. One that runs beside a surface belongs to
/// it where both its ends are in contacts. A border with any edge that nothing is near to is left alone: it is a fault
/// that dies out. The end of a slit, where two borders on one controller meet, slides on that controller's own border
/// if that is within the distance. Parts that conform already are left out. Parallel, independent of the schedule.
FoundContacts find_contacts(const TriangleSoup& soup, const FindContactsOptions& options);

/// Contacts by name. Each text is one of
///   "H2 -> F3"              the border of H2 that is nearest to F3 (all of it: the distance of a border is that of its
///                           furthest point) among those that face it
///   "H2 -> F3 within 25"    every border of H2 that lies within 25 m of F3; several such texts of H2 share a border
///                           that passes from one of their surfaces to the next
///   "H2.border 4 -> F3"     border 4 of H2, counting from 1 in the order of find_borders
///   "H2.stone -> F3.border" the end of every named slit or border of H2 that is nearest to the free border of F3
///                           (with `within`: all ends within it)
/// Fails with invalid_options naming the text: not of this form, a name no entity has, or no border that fits.
Result<FoundContacts> name_contacts(const TriangleSoup& soup, const std::vector<std::string>& texts,
                                    const FindContactsOptions& options);

/// The named contacts, and the found ones of borders that none of them is about.
FoundContacts joined(const FoundContacts& named, const FoundContacts& found);

/// "H2 stops 12.4 m short of F3 at (…)", or "overshoots F3 by".
std::string describe(const TriangleSoup& soup, const BorderOnSurface& contact, const ContactGap& gap);

}  // namespace strataflow
