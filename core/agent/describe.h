#pragma once
// What is shown, in words, for those who do not see it: title, text, picture and menu of the page.
#include "core/agent/guide.h"

namespace caryatid::agent {

// Each part is a line of the captions and follows a pause. O(text).
void describe(const Programme& programme, const Guidance& shown, const Moment& now, Utterable* out);

}  // namespace caryatid::agent
