# Buttons on devices: caryatid_gpio_buttons and caryatid_hid_buttons. The GPIO backend is chosen by
# symbol: libgpiod 2 has gpiod_chip_request_lines, 1.6 has not; the package's number is no guide.
include(CheckSymbolExists)
pkg_check_modules(GPIOD IMPORTED_TARGET libgpiod)
pkg_check_modules(HIDAPI IMPORTED_TARGET hidapi-hidraw)

set(gpiod_backend no_gpiod)
if(GPIOD_FOUND)
  set(CMAKE_REQUIRED_INCLUDES ${GPIOD_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES ${GPIOD_LINK_LIBRARIES})
  check_symbol_exists(gpiod_chip_request_lines gpiod.h CARYATID_HAS_GPIOD_V2)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
  if(CARYATID_HAS_GPIOD_V2)
    set(gpiod_backend gpiod_v2)
  else()
    set(gpiod_backend gpiod_v1)
  endif()
endif()
add_library(caryatid_gpio_buttons STATIC platform/buttons/gpio/gpio_buttons.cpp
  platform/buttons/${gpiod_backend}/gpio_lines.cpp)
target_link_libraries(caryatid_gpio_buttons PUBLIC caryatid_base PRIVATE caryatid_board_flags)
if(GPIOD_FOUND)
  target_link_libraries(caryatid_gpio_buttons PRIVATE PkgConfig::GPIOD)
endif()

message(STATUS "buttons: GPIO by ${gpiod_backend}; hidapi: ${HIDAPI_VERSION}")
if(HIDAPI_FOUND)
  add_library(caryatid_hid_buttons STATIC platform/buttons/hidapi/hid_buttons.cpp
    platform/buttons/hidapi/hid_report.cpp platform/buttons/hidapi/hid_search.cpp)
  target_link_libraries(caryatid_hid_buttons PUBLIC caryatid_base
    PRIVATE PkgConfig::HIDAPI caryatid_board_flags)
endif()
