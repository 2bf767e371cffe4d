# core: the agent itself.
# base <- pack <- mesh <- face, body <- stream, emotion, speech <- scene <- lod <- agent
find_package(glm REQUIRED)
add_library(caryatid_glm INTERFACE)
target_include_directories(caryatid_glm SYSTEM INTERFACE
  $<TARGET_PROPERTY:glm::glm,INTERFACE_INCLUDE_DIRECTORIES>)
set(board caryatid_board_flags)
caryatid_room(base core/base ${board} caryatid_glm)
caryatid_room(pack core/pack ${board} caryatid_base)
caryatid_room(mesh core/mesh ${board} caryatid_pack)
caryatid_room(face core/face ${board} caryatid_mesh)
caryatid_room(body core/body ${board} caryatid_mesh)
caryatid_room(stream core/stream ${board} caryatid_face caryatid_body)
caryatid_room(emotion core/emotion ${board} caryatid_face caryatid_body)
caryatid_room(speech core/speech ${board} caryatid_face caryatid_body)
caryatid_room(scene core/scene ${board} caryatid_stream caryatid_emotion caryatid_speech)
caryatid_room(lod core/lod ${board} caryatid_scene)
caryatid_room(agent core/agent ${board} caryatid_lod)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL arm)  # The rest runs on CPUs without NEON.
  set_source_files_properties(core/face/move_sum_neon.cpp PROPERTIES COMPILE_OPTIONS -mfpu=neon)
endif()
