if(CMAKE_CROSSCOMPILING)
  return()  # Simulated days; minutes by emulation.
endif()
# The simulated boards, shared by the tests of this folder and by the benchmark.
add_library(caryatid_board_sim STATIC board_sim/disturbances.cpp board_sim/simulation.cpp)
target_link_libraries(caryatid_board_sim PUBLIC caryatid_lod PRIVATE caryatid_flags)
add_executable(board_sim_test board_sim/board_sim_test.cpp)
target_link_libraries(board_sim_test PRIVATE caryatid_board_sim caryatid_flags GTest::gtest_main)
add_test(NAME board_sim_test COMMAND board_sim_test)
add_executable(board_sim_thermal_event board_sim/thermal_event.cpp)
target_link_libraries(board_sim_thermal_event PRIVATE caryatid_board_sim caryatid_flags)
