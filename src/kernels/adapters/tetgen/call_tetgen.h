#pragma once
#include "kernels/adapters/tetgen/tetgen_exchange.h"

namespace strataflow {

/// Calls TetGen in this process. It may abort on a failed assertion, hang, or print to standard output, and it must
/// never run twice at once: only tools/tet_worker calls this. What TetGen throws becomes `TetgenResponse::error`.
TetgenResponse call_tetgen(const TetgenRequest& request);

}  // namespace strataflow
