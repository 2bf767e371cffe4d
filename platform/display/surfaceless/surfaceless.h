#pragma once
#include <memory>

#include "platform/display/display.h"

namespace caryatid::platform {

// No screen: the renderer draws into its own framebuffer and the caller reads it back.
Status open_surfaceless(const DisplayOptions& options, std::unique_ptr<Display>& out,
                        ErrorLine& out_error);

}  // namespace caryatid::platform
