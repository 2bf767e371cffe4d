# Shared by the toolchain files: a Debian compiler for TRIPLE and the libraries of the target's own
# release in CARYATID_SYSROOT (cross/board.sh makes it), never those of the host.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${TRIPLE}-gcc)
set(CMAKE_CXX_COMPILER ${TRIPLE}-g++)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CARYATID_SYSROOT)
if(NOT CARYATID_SYSROOT)
  set(CARYATID_SYSROOT $ENV{CARYATID_SYSROOT})
endif()
set(CMAKE_SYSROOT ${CARYATID_SYSROOT})
set(CMAKE_LIBRARY_ARCHITECTURE ${TRIPLE})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# LIBDIR replaces the host's search path; PKG_CONFIG_PATH would only add to it.
set(folders usr/lib/${TRIPLE}/pkgconfig usr/lib/pkgconfig usr/share/pkgconfig)
list(TRANSFORM folders PREPEND ${CARYATID_SYSROOT}/)
list(JOIN folders ":" folders)
set(ENV{PKG_CONFIG_LIBDIR} ${folders})
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CARYATID_SYSROOT})
# The target's own C++ runtime: libraries of a newer release than the compiler's need a newer one.
file(GLOB CMAKE_CXX_STANDARD_LIBRARIES_INIT ${CARYATID_SYSROOT}/usr/lib/${TRIPLE}/libstdc++.so.6)
# Before the compiler's own folder, which has the C library of this PC's release.
set(CMAKE_EXE_LINKER_FLAGS_INIT -L${CARYATID_SYSROOT}/usr/lib/${TRIPLE})
