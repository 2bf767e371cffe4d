# platform: the board's senses and muscles. One header per service, one folder per backend.
find_package(PkgConfig REQUIRED)
include(platform/buttons/room.cmake)
include(platform/watchdog/room.cmake)
include(platform/audio/room.cmake)
include(platform/voice/room.cmake)
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(GLES REQUIRED IMPORTED_TARGET glesv2)
pkg_check_modules(X11 IMPORTED_TARGET x11)

# A display backend that is switched off leaves no trace but a line in `open_display`'s answer.
file(GLOB display_sources CONFIGURE_DEPENDS platform/display/*.cpp
  platform/display/surfaceless/*.cpp)
set(display_definitions)
set(display_libraries PkgConfig::EGL)
if(X11_FOUND)
  file(GLOB window_sources CONFIGURE_DEPENDS platform/display/window/*.cpp)
  list(APPEND display_sources ${window_sources})
  list(APPEND display_definitions CARYATID_DISPLAY_WINDOW=1)
  list(APPEND display_libraries PkgConfig::X11)
else()
  message(STATUS "display: no X11 window (libx11-dev is missing)")
endif()
include(platform/display/wayland/backend.cmake)
include(platform/display/gbm/backend.cmake)
add_library(caryatid_display STATIC ${display_sources})
target_compile_definitions(caryatid_display PRIVATE ${display_definitions})
target_link_libraries(caryatid_display PUBLIC caryatid_base caryatid_board
  PRIVATE ${display_libraries} caryatid_board_flags)

file(GLOB render_sources CONFIGURE_DEPENDS platform/render/*.cpp platform/render/null/*.cpp
  platform/render/gles/*.cpp)
add_library(caryatid_render STATIC ${render_sources})
target_link_libraries(caryatid_render PUBLIC caryatid_scene
  PRIVATE PkgConfig::GLES caryatid_board_flags)

file(GLOB button_sources CONFIGURE_DEPENDS platform/buttons/*.cpp platform/buttons/scripted/*.cpp)
add_library(caryatid_buttons STATIC ${button_sources})
target_link_libraries(caryatid_buttons PUBLIC caryatid_base PRIVATE caryatid_board_flags)
