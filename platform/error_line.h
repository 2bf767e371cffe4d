#pragma once
#include "core/base/fixed.h"

namespace caryatid::platform {

// One line for a person: what is wrong and what to do. Never empty after a failure.
using ErrorLine = FixedString<255>;

}  // namespace caryatid::platform
