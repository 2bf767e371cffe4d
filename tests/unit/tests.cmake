# Buttons without a board: the real backends linked with fakes of libgpiod and hidapi. Both APIs of
# libgpiod are tested where CARYATID_GPIOD_V2_INCLUDE names a folder with the other one's gpiod.h.
set(CARYATID_GPIOD_V2_INCLUDE "" CACHE PATH "Folder with the gpiod.h of libgpiod 2, for its tests")
set(buttons_tests ${CMAKE_CURRENT_LIST_DIR}/platform/buttons)
function(caryatid_gpio_unit version)
  set(name unit_platform_buttons_gpiod_${version})
  add_executable(${name} ${buttons_tests}/gpio_test.cpp ${buttons_tests}/fake_gpiod_${version}.cpp
    ${CMAKE_SOURCE_DIR}/platform/buttons/gpio/gpio_buttons.cpp
    ${CMAKE_SOURCE_DIR}/platform/buttons/gpiod_${version}/gpio_lines.cpp)
  target_include_directories(${name} SYSTEM PRIVATE ${ARGN})
  target_link_libraries(${name} PRIVATE caryatid_base caryatid_flags GTest::gtest_main)
  add_test(NAME ${name} COMMAND ${name})
endfunction()
if(GPIOD_FOUND AND NOT CARYATID_HAS_GPIOD_V2)
  caryatid_gpio_unit(v1)
endif()
if(CARYATID_HAS_GPIOD_V2 OR CARYATID_GPIOD_V2_INCLUDE)
  caryatid_gpio_unit(v2 ${CARYATID_GPIOD_V2_INCLUDE})
  target_compile_definitions(unit_platform_buttons_gpiod_v2 PRIVATE CARYATID_TEST_GPIOD_V2=1)
endif()
if(HIDAPI_FOUND)
  add_executable(unit_platform_buttons_hid ${buttons_tests}/hid_test.cpp
    ${buttons_tests}/fake_hidapi.cpp ${CMAKE_SOURCE_DIR}/platform/buttons/hidapi/hid_buttons.cpp
    ${CMAKE_SOURCE_DIR}/platform/buttons/hidapi/hid_report.cpp
    ${CMAKE_SOURCE_DIR}/platform/buttons/hidapi/hid_search.cpp)
  target_link_libraries(unit_platform_buttons_hid PRIVATE caryatid_base caryatid_flags
    GTest::gtest_main Threads::Threads)
  add_test(NAME unit_platform_buttons_hid COMMAND unit_platform_buttons_hid)
endif()
# The screen without a card: the real DRM code linked with a fake of libdrm.
if(DRM_FOUND)
  set(gbm_tests ${CMAKE_CURRENT_LIST_DIR}/platform/gbm)
  set(gbm_room ${CMAKE_SOURCE_DIR}/platform/display/gbm)
  add_executable(unit_platform_gbm ${gbm_tests}/gbm_test.cpp ${gbm_tests}/fake_drm.cpp
    ${gbm_room}/card.cpp ${gbm_room}/mode.cpp ${gbm_room}/output.cpp ${gbm_room}/scanout.cpp
    ${gbm_room}/watch.cpp)
  target_include_directories(unit_platform_gbm SYSTEM PRIVATE ${DRM_INCLUDE_DIRS})
  target_link_libraries(unit_platform_gbm PRIVATE caryatid_base caryatid_flags GTest::gtest_main)
  add_test(NAME unit_platform_gbm COMMAND unit_platform_gbm)
endif()
add_executable(unit_firmware_config ${CMAKE_CURRENT_LIST_DIR}/firmware-app/config_test.cpp
  ${CMAKE_CURRENT_LIST_DIR}/firmware-app/screen_care_test.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/config.cpp ${CMAKE_SOURCE_DIR}/firmware-app/config_devices.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/config_screen.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/screen_care.cpp)
target_link_libraries(unit_firmware_config PRIVATE caryatid_agent caryatid_flags GTest::gtest_main)
add_test(NAME unit_firmware_config COMMAND unit_firmware_config)
add_executable(unit_firmware_panel ${CMAKE_CURRENT_LIST_DIR}/firmware-app/panel_test.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/panel.cpp ${CMAKE_SOURCE_DIR}/firmware-app/config.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/config_devices.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/config_screen.cpp)
target_compile_definitions(unit_firmware_panel PRIVATE CARYATID_HID_BUTTONS=1)
target_link_libraries(unit_firmware_panel PRIVATE caryatid_agent caryatid_board caryatid_flags
  GTest::gtest_main)
add_test(NAME unit_firmware_panel COMMAND unit_firmware_panel)
caryatid_unit(firmware-app/texts caryatid_texts)
add_executable(unit_firmware_pictures ${CMAKE_CURRENT_LIST_DIR}/firmware-app/pictures_test.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/pictures.cpp)
target_include_directories(unit_firmware_pictures SYSTEM PRIVATE /usr/include/stb)
target_compile_definitions(unit_firmware_pictures PRIVATE CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
target_link_libraries(unit_firmware_pictures PRIVATE caryatid_agent caryatid_board_flags
  GTest::gtest_main)
add_test(NAME unit_firmware_pictures COMMAND unit_firmware_pictures)
caryatid_unit(platform/render caryatid_render)
foreach(room watchdog thermal control files inventory log)
  caryatid_unit(platform/${room} caryatid_board)
endforeach()
# The service's hardening must not decay: systemd rates its exposure from 0 (safe) to 10.
find_program(SYSTEMD_ANALYZE systemd-analyze)
if(SYSTEMD_ANALYZE)
  add_test(NAME deploy_hardening COMMAND ${SYSTEMD_ANALYZE} security --offline=true --threshold=15
    --no-pager ${CMAKE_SOURCE_DIR}/firmware-app/deploy/caryatid.service)
endif()
file(GLOB service_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/firmware-app/service/*.cpp)
add_executable(unit_firmware_service ${service_tests} ${CMAKE_SOURCE_DIR}/firmware-app/command.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/status.cpp ${CMAKE_SOURCE_DIR}/firmware-app/start_times.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/last_state.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/last_good.cpp)
target_link_libraries(unit_firmware_service PRIVATE caryatid_agent caryatid_flags Threads::Threads
  GTest::gtest_main)
add_test(NAME unit_firmware_service COMMAND unit_firmware_service)
add_executable(unit_firmware_stream_file
  ${CMAKE_CURRENT_LIST_DIR}/firmware-app/stream_file_test.cpp
  ${CMAKE_SOURCE_DIR}/firmware-app/stream_file.cpp)
target_link_libraries(unit_firmware_stream_file PRIVATE caryatid_agent caryatid_flags
  GTest::gtest_main)
add_test(NAME unit_firmware_stream_file COMMAND unit_firmware_stream_file)
# Sound with a fake of ALSA; voices with a program that crashes, hangs and lies.
if(ALSA_FOUND)
  set(audio_tests ${CMAKE_CURRENT_LIST_DIR}/platform/audio)
  add_executable(unit_platform_audio ${audio_tests}/audio_test.cpp ${audio_tests}/fake_alsa.cpp
    ${CMAKE_SOURCE_DIR}/platform/audio/audio.cpp ${CMAKE_SOURCE_DIR}/platform/audio/wav.cpp
    ${CMAKE_SOURCE_DIR}/platform/audio/timed/timed.cpp
    ${CMAKE_SOURCE_DIR}/platform/audio/alsa/alsa_audio.cpp)
  target_compile_definitions(unit_platform_audio PRIVATE CARYATID_AUDIO_ALSA=1)
  target_link_libraries(unit_platform_audio PRIVATE caryatid_base caryatid_flags GTest::gtest_main
    Threads::Threads)
  add_test(NAME unit_platform_audio COMMAND unit_platform_audio)
  # The real libasound with a card of ours that it loads as a plugin.
  add_library(caryatid_clocked_pcm MODULE ${audio_tests}/clocked_pcm.c)
  target_link_libraries(caryatid_clocked_pcm PRIVATE PkgConfig::ALSA)
  add_executable(unit_platform_alsa ${audio_tests}/real_alsa_test.cpp)
  target_compile_definitions(unit_platform_alsa PRIVATE
    CARYATID_CLOCKED_PCM="$<TARGET_FILE:caryatid_clocked_pcm>")
  target_link_libraries(unit_platform_alsa PRIVATE caryatid_audio caryatid_flags
    GTest::gtest_main)
  add_dependencies(unit_platform_alsa caryatid_clocked_pcm)
  add_test(NAME unit_platform_alsa COMMAND unit_platform_alsa)
endif()
set(voice_tests ${CMAKE_CURRENT_LIST_DIR}/platform/voice)
add_executable(fake-voice ${voice_tests}/fake_voice.cpp)
target_link_libraries(fake-voice PRIVATE caryatid_voice_client caryatid_flags)
file(GLOB voice_test_sources CONFIGURE_DEPENDS ${voice_tests}/*_test.cpp)
add_executable(unit_platform_voice ${voice_test_sources})
target_link_libraries(unit_platform_voice PRIVATE caryatid_voice_client caryatid_flags
  GTest::gtest_main)
set(real_voice)
if(TARGET caryatid-voice)
  set(real_voice $<TARGET_FILE:caryatid-voice>)
endif()
if(real_voice AND CMAKE_CROSSCOMPILING)  # An emulated program starts others as the PC does.
  list(JOIN CMAKE_CROSSCOMPILING_EMULATOR " " emulator)
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/real_voice.sh
    CONTENT "#!/bin/sh\nexec ${emulator} ${real_voice} \"$@\"\n"
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  set(real_voice ${CMAKE_BINARY_DIR}/real_voice.sh)
endif()
target_compile_definitions(unit_platform_voice PRIVATE
  CARYATID_FAKE_VOICE="$<TARGET_FILE:fake-voice>" CARYATID_REAL_VOICE="${real_voice}")
add_dependencies(unit_platform_voice fake-voice)
add_test(NAME unit_platform_voice COMMAND unit_platform_voice)
if(CMAKE_CROSSCOMPILING)  # How a process dies, how fast and how large it is, is the emulator's.
  set_tests_properties(unit_platform_voice PROPERTIES
    ENVIRONMENT GTEST_FILTER=-EspeakProcess.*:RealVoice.FitsIntoTwelveMegabytes)
endif()
# What caryatid-tool reads and writes by itself.
if(CARYATID_HOST_TOOLS AND TARGET caryatid-tool)
  file(GLOB tool_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/tool/*.cpp)
  set(tool_room ${CMAKE_SOURCE_DIR}/assets/tool)
  add_executable(unit_tool ${tool_tests} ${tool_room}/animated_png.cpp ${tool_room}/flac.cpp
    ${tool_room}/spoken.cpp)
  target_link_libraries(unit_tool PRIVATE caryatid_bake caryatid_voice_client ZLIB::ZLIB
    PkgConfig::FLAC caryatid_flags GTest::gtest_main)
  add_test(NAME unit_tool COMMAND unit_tool)
endif()
