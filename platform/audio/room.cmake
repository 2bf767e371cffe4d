# Sound. ALSA is left out where its headers are missing; file and null are always there.
pkg_check_modules(ALSA IMPORTED_TARGET alsa)
add_library(caryatid_audio STATIC platform/audio/audio.cpp platform/audio/wav.cpp
  platform/audio/timed/timed.cpp)
target_link_libraries(caryatid_audio PUBLIC caryatid_base PRIVATE caryatid_board_flags)
if(ALSA_FOUND)
  find_package(Threads REQUIRED)
  target_sources(caryatid_audio PRIVATE platform/audio/alsa/alsa_audio.cpp)
  target_compile_definitions(caryatid_audio PRIVATE CARYATID_AUDIO_ALSA=1)
  target_link_libraries(caryatid_audio PRIVATE PkgConfig::ALSA Threads::Threads)
else()
  message(STATUS "audio: no ALSA (libasound2-dev is missing)")
endif()
