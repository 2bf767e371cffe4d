# caryatid-bench [--filter NAME] [--json FILE]: every tests/bench/*.cpp in one program.
if(NOT TARGET caryatid_bake)
  return()  # Some benchmarks make their input with the content tools.
endif()
find_package(benchmark REQUIRED)
file(GLOB bench_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
add_executable(caryatid-bench ${bench_sources})
target_link_libraries(caryatid-bench PRIVATE caryatid_bake caryatid_agent caryatid_board_sim
  caryatid_flags benchmark::benchmark)
# Peers of the simplifier, where they are installed (libcgal-dev, libmeshoptimizer-dev).
foreach(library gmp mpfr meshoptimizer)
  find_library(CARYATID_BENCH_${library} ${library})
  if(CARYATID_BENCH_${library})
    target_link_libraries(caryatid-bench PRIVATE ${CARYATID_BENCH_${library}})
  endif()
endforeach()
# So that benchmarks never rot; the long ones are run by hand.
add_test(NAME bench_lod_step COMMAND caryatid-bench --filter lod/step)
add_test(NAME bench_scene COMMAND caryatid-bench --filter scene/)
add_test(NAME bench_stream COMMAND caryatid-bench --filter stream/decode/talking)
add_test(NAME bench_face COMMAND caryatid-bench --filter face/)
add_test(NAME bench_mesh COMMAND caryatid-bench --filter mesh/rebuild)
add_test(NAME bench_simplify COMMAND caryatid-bench --filter simplify/ball_20k/ours/3)
add_test(NAME bench_body COMMAND caryatid-bench --filter body/)
target_compile_definitions(caryatid-bench PRIVATE
  CARYATID_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
  CARYATID_BUILTIN_PACK="${CMAKE_SOURCE_DIR}/firmware-app/builtin_face.pack")
add_test(NAME bench_frame COMMAND caryatid-bench --filter frame/)
add_test(NAME bench_speech COMMAND caryatid-bench --filter speech/)
