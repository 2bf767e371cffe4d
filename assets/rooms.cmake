# assets: host programs that make what the board shows.
# Heap, exceptions and big libraries are welcome.
find_package(Eigen3 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(FLAC REQUIRED IMPORTED_TARGET flac)
pkg_check_modules(FONTS REQUIRED IMPORTED_TARGET freetype2 harfbuzz harfbuzz-subset)
add_library(caryatid_host_libraries INTERFACE)
target_include_directories(caryatid_host_libraries SYSTEM INTERFACE
  $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES> ${CMAKE_SYSROOT}/usr/include/stb)
# Rooms inside bake: human (import of the base human), simplify, face (FAT), body, texture, pack.
file(GLOB_RECURSE bake_sources CONFIGURE_DEPENDS assets/bake/*.cpp)
file(GLOB_RECURSE tool_sources CONFIGURE_DEPENDS assets/tool/*.cpp)
# The inner loops of the simplifier gain a tenth.
set_source_files_properties(assets/bake/simplify/edge_collapse.cpp
  assets/bake/simplify/fast_cost.cpp PROPERTIES COMPILE_OPTIONS -O3)
if(bake_sources)
  add_library(caryatid_bake STATIC ${bake_sources})
  target_link_libraries(caryatid_bake PUBLIC caryatid_agent caryatid_host_libraries
    PRIVATE PkgConfig::FONTS caryatid_flags)
endif()
if(tool_sources)
  add_executable(caryatid-tool ${tool_sources})
  target_link_libraries(caryatid-tool PRIVATE caryatid_bake caryatid_render caryatid_display
    caryatid_voice_client ZLIB::ZLIB PkgConfig::FLAC
    caryatid_flags)
  target_compile_definitions(caryatid-tool PRIVATE CARYATID_VERSION="${PROJECT_VERSION}")
endif()
