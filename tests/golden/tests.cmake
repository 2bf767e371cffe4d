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
  ${CMAKE_CURRENT_LIST_DIR}/display_test.cpp)
target_link_libraries(golden_render PRIVATE caryatid_golden caryatid_flags)
add_test(NAME golden_render COMMAND golden_render)
find_program(XVFB_RUN xvfb-run)
if(X11_FOUND AND XVFB_RUN)
  add_executable(golden_window ${CMAKE_CURRENT_LIST_DIR}/window_test.cpp)
  target_link_libraries(golden_window PRIVATE caryatid_golden PkgConfig::X11 caryatid_flags)
  add_test(NAME golden_window COMMAND ${XVFB_RUN} -a -s "-screen 0 640x480x24"
    $<TARGET_FILE:golden_window>)
else()
  message(STATUS "tests: the window display is not tested (libx11-dev or xvfb is missing)")
endif()
