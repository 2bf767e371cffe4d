# Boards with a 32-bit system: ARMv7 with VFPv3-D16, Debian's baseline, so without NEON.
set(CMAKE_SYSTEM_PROCESSOR arm)
set(TRIPLE arm-linux-gnueabihf)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-arm-static;-L;${CARYATID_SYSROOT})
