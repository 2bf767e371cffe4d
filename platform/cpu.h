#pragma once
// What the CPU can do beyond what the program is compiled for.
#if defined(__arm__)
#include <asm/hwcap.h>
#include <sys/auxv.h>
#endif

namespace caryatid::platform {

// NEON: part of ARMv8; ARMv7 tells at run time, as the program is for those without, too.
inline bool has_neon() {
#if defined(__arm__)
  return (getauxval(AT_HWCAP) & HWCAP_NEON) != 0;
#elif defined(__aarch64__)
  return true;
#else
  return false;
#endif
}

}  // namespace caryatid::platform
