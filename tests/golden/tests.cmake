# The exact hashes of poses and draw lists, for boards too; they have no software GPU when emulated.
if(CMAKE_CROSSCOMPILING)
  add_executable(golden_hashes ${CMAKE_CURRENT_LIST_DIR}/program/hash_test.cpp)
  target_link_libraries(golden_hashes PRIVATE caryatid_agent caryatid_flags GTest::gtest_main)
  target_compile_definitions(golden_hashes PRIVATE CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    CARYATID_PROGRAM="$<TARGET_FILE:caryatid>")
  add_test(NAME golden_hashes COMMAND golden_hashes)
  return()
endif()
# Pictures by tolerance on the host's software GPU; see image.h for how to look and renew.
add_library(caryatid_golden STATIC ${CMAKE_CURRENT_LIST_DIR}/image.cpp
  ${CMAKE_CURRENT_LIST_DIR}/sample_pack.cpp)
target_include_directories(caryatid_golden SYSTEM PRIVATE /usr/include/stb)
target_compile_definitions(caryatid_golden PRIVATE
  CARYATID_GOLDEN_DIR="${CMAKE_CURRENT_LIST_DIR}/images"
  CARYATID_GOLDEN_OUT="${CMAKE_BINARY_DIR}/out/golden")
target_link_libraries(caryatid_golden PUBLIC caryatid_render caryatid_display GTest::gtest_main
  PRIVATE caryatid_flags)
add_executable(golden_render ${CMAKE_CURRENT_LIST_DIR}/render_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/display_test.cpp ${CMAKE_CURRENT_LIST_DIR}/overlay_test.cpp)
target_compile_definitions(golden_render PRIVATE CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
target_link_libraries(golden_render PRIVATE caryatid_golden caryatid_flags)
add_test(NAME golden_render COMMAND golden_render)
set_tests_properties(golden_render PROPERTIES ENVIRONMENT_MODIFICATION WAYLAND_DISPLAY=unset:)
find_program(XVFB_RUN xvfb-run)
if(X11_FOUND AND XVFB_RUN)
  add_executable(golden_window ${CMAKE_CURRENT_LIST_DIR}/window_test.cpp)
  target_link_libraries(golden_window PRIVATE caryatid_golden PkgConfig::X11 caryatid_flags)
  add_test(NAME golden_window COMMAND ${XVFB_RUN} -a -s "-screen 0 640x480x24"
    $<TARGET_FILE:golden_window>)
  set_tests_properties(golden_window PROPERTIES ENVIRONMENT_MODIFICATION WAYLAND_DISPLAY=unset:)
else()
  message(STATUS "tests: the window display is not tested (libx11-dev or xvfb is missing)")
endif()
find_program(WESTON weston)
if(TARGET caryatid_xdg_shell AND NOT CMAKE_CROSSCOMPILING)
  pkg_check_modules(WAYLAND_SERVER REQUIRED IMPORTED_TARGET wayland-server)
  set(weston ${WESTON})
  if(NOT WESTON)
    set(weston)  # The tests that need it skip.
  endif()
  add_executable(golden_wayland ${CMAKE_CURRENT_LIST_DIR}/wayland_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/toy_compositor.cpp)
  target_link_libraries(golden_wayland PRIVATE caryatid_golden caryatid_xdg_shell
    PkgConfig::WAYLAND_SERVER caryatid_flags)
  target_compile_definitions(golden_wayland PRIVATE CARYATID_WESTON="${weston}"
    CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CARYATID_PROGRAM="$<TARGET_FILE:caryatid>")
  add_dependencies(golden_wayland caryatid)
  add_test(NAME golden_wayland COMMAND golden_wayland)
endif()

# The whole program, as a user runs it, on the built-in face: replay bit for bit, pictures by
# tolerance, exact hashes of poses and draw lists, messages and exit codes.
file(GLOB program_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/program/*_test.cpp)
add_executable(golden_program ${program_sources})
target_include_directories(golden_program SYSTEM PRIVATE /usr/include/stb)
target_link_libraries(golden_program PRIVATE caryatid_agent caryatid_flags GTest::gmock
  GTest::gtest_main)
target_compile_definitions(golden_program PRIVATE CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
  CARYATID_PROGRAM="$<TARGET_FILE:caryatid>"
  CARYATID_PACKS="${CMAKE_SOURCE_DIR}/build/host-release/packs")
add_dependencies(golden_program caryatid)
set(fake_clock)
if(NOT CARYATID_SANITIZE)  # Its run-time library wants to be the first that is loaded.
  add_library(fake_clock MODULE ${CMAKE_CURRENT_LIST_DIR}/program/fake_clock.cpp)
  set(fake_clock $<TARGET_FILE:fake_clock>)
  add_dependencies(golden_program fake_clock)
endif()
target_compile_definitions(golden_program PRIVATE CARYATID_FAKE_CLOCK="${fake_clock}")
add_test(NAME golden_program COMMAND golden_program)
set_tests_properties(golden_program PROPERTIES TIMEOUT 900)
if(CARYATID_SANITIZE)
  # Mesa and X11 keep some hundred bytes until the process ends; our leaks show in the other tests.
  foreach(name golden_render golden_window golden_wayland golden_program)
    if(TEST ${name})
      set_tests_properties(${name} PROPERTIES ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
    endif()
  endforeach()
endif()
