// Compiles every header of the room on its own, so that each includes what it uses.
#include "core/lod/board_model.h"
#include "core/lod/controller.h"
#include "core/lod/frame.h"
#include "core/lod/share.h"
#include "core/lod/stage_model.h"
