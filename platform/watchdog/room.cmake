# The board itself: supervision, temperature, small files, the control socket, what is plugged in.
# No libraries beyond libc.
find_package(Threads REQUIRED)
file(GLOB board_sources CONFIGURE_DEPENDS platform/watchdog/*.cpp platform/thermal/*.cpp
  platform/files/*.cpp platform/control/*.cpp platform/inventory/*.cpp platform/log/*.cpp)
add_library(caryatid_board STATIC ${board_sources})
target_link_libraries(caryatid_board PUBLIC caryatid_base Threads::Threads
  PRIVATE caryatid_board_flags)
