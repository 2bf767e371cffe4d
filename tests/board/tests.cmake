# The hashes that all machines must agree on; here only that a run repeats itself.
add_executable(caryatid-hashes ${CMAKE_CURRENT_LIST_DIR}/hashes.cpp)
target_link_libraries(caryatid-hashes PRIVATE caryatid_agent caryatid_flags)
add_test(NAME hashes_repeat COMMAND caryatid-hashes)

if(NOT CARYATID_SANITIZE AND NOT CMAKE_CROSSCOMPILING)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_test(NAME board_tools COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/tools_test.py)
endif()
