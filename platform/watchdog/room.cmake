# The board itself: supervision and temperature. No libraries beyond libc.
add_library(caryatid_board STATIC platform/watchdog/notify.cpp platform/thermal/thermal.cpp)
target_link_libraries(caryatid_board PUBLIC caryatid_base PRIVATE caryatid_board_flags)
