#pragma once
#include <cstddef>

#include "kernels/drawing/image.h"

namespace strataflow {

/// The colour of category `index`: sixteen hues that are told apart easily, then the same lighter and darker.
/// Entity 3 or region 3 has one colour in every picture.
Colour categorical_colour(std::size_t index);

}  // namespace strataflow
