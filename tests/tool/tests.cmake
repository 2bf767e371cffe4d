# The content tool as a user runs it: what it refuses, with which words and exit code.
if(TARGET caryatid-tool AND NOT CMAKE_CROSSCOMPILING)
  file(GLOB tool_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_test.cpp)
  add_executable(tool_messages ${tool_tests})
  target_link_libraries(tool_messages PRIVATE caryatid_flags GTest::gtest_main)
  target_compile_definitions(tool_messages PRIVATE CARYATID_TOOL="$<TARGET_FILE:caryatid-tool>"
    CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  add_dependencies(tool_messages caryatid-tool)
  add_test(NAME tool_messages COMMAND tool_messages)
endif()
