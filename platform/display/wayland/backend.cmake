# The Wayland window, where libwayland and its protocols are there; the glue code of xdg-shell is
# generated from the protocol's own text.
pkg_check_modules(WAYLAND IMPORTED_TARGET wayland-client wayland-egl)
pkg_check_modules(WAYLAND_PROTOCOLS wayland-protocols>=1.31)
find_program(WAYLAND_SCANNER wayland-scanner)
if(NOT (WAYLAND_FOUND AND WAYLAND_PROTOCOLS_FOUND AND WAYLAND_SCANNER))
  message(STATUS "display: no Wayland window (libwayland-dev, libwayland-bin or wayland-protocols "
    "1.31 is missing)")
  return()
endif()
pkg_get_variable(protocols wayland-protocols pkgdatadir)
set(xdg_shell ${protocols}/stable/xdg-shell/xdg-shell.xml)
set(CARYATID_XDG_SHELL_DIR ${CMAKE_BINARY_DIR}/xdg-shell)
file(MAKE_DIRECTORY ${CARYATID_XDG_SHELL_DIR})
foreach(kind client-header server-header private-code)
  string(REGEX REPLACE "^(client|server)-header$" "xdg-shell-\\1-protocol.h" name ${kind})
  string(REPLACE "private-code" "xdg-shell-protocol.c" name ${name})
  add_custom_command(OUTPUT ${CARYATID_XDG_SHELL_DIR}/${name} DEPENDS ${xdg_shell} VERBATIM
    COMMAND ${WAYLAND_SCANNER} ${kind} ${xdg_shell} ${CARYATID_XDG_SHELL_DIR}/${name})
  list(APPEND xdg_shell_files ${CARYATID_XDG_SHELL_DIR}/${name})
endforeach()
add_library(caryatid_xdg_shell STATIC ${xdg_shell_files})
target_include_directories(caryatid_xdg_shell SYSTEM PUBLIC ${CARYATID_XDG_SHELL_DIR})

file(GLOB wayland_sources CONFIGURE_DEPENDS platform/display/wayland/*.cpp)
list(APPEND display_sources ${wayland_sources})
list(APPEND display_definitions CARYATID_DISPLAY_WAYLAND=1)
list(APPEND display_libraries PkgConfig::WAYLAND caryatid_xdg_shell)
