#include "core/face/interpolation.h"

#include "core/face/fit.h"

namespace caryatid::face {

void fill_missing(FapFrame& frame) { apply_fit(default_fit(), &frame); }

}  // namespace caryatid::face
