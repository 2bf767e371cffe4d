// Compiles every header of the room on its own, so that each includes what it uses.
#include "core/base/arena.h"
#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/random.h"
#include "core/base/status.h"
#include "core/base/vec.h"
