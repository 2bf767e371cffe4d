# Boards with a 64-bit system: Raspberry Pi Zero 2 W, 3, 4, 5 and the like.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(TRIPLE aarch64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static;-L;${CARYATID_SYSROOT})
