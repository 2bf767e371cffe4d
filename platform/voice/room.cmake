# Voices. Synthesis is a program of its own, because espeak-ng is under the GPL: the kiosk talks to
# it through a socket and links nothing of it.
file(GLOB voice_sources CONFIGURE_DEPENDS platform/voice/*.cpp platform/voice/espeak_process/*.cpp
  platform/voice/recorded/*.cpp)
add_library(caryatid_voice_client STATIC ${voice_sources})
target_link_libraries(caryatid_voice_client PUBLIC caryatid_speech caryatid_audio
  PRIVATE caryatid_board_flags)
pkg_check_modules(ESPEAK_NG IMPORTED_TARGET espeak-ng)
if(ESPEAK_NG_FOUND)
  add_executable(caryatid-voice platform/voice/program/caryatid_voice.cpp platform/voice/wire.cpp)
  target_link_libraries(caryatid-voice PRIVATE PkgConfig::ESPEAK_NG caryatid_flags)
else()
  message(STATUS "voice: no caryatid-voice (libespeak-ng-dev is missing)")
endif()
