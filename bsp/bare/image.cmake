# What is the same for the bare boards: this room's sources with the board's own, and images of them.
enable_language(ASM)

set(LASSO_MISSION_IMAGE ${CMAKE_BINARY_DIR}/mission.3dli CACHE FILEPATH "Mission image that linked_*.elf has in itself (mdat mission compile)")

# lasso_bare_board(NAME SUFFIX SOURCE...): the board bsp/NAME, whose images are flight_SUFFIX, to which a loader adds a mission's image, linked_SUFFIX, which
# has it in itself, planted_SUFFIX, and in_sensor_SUFFIX, which has its head beside it (docs/in-sensor.md). Needs its tool chain file.
function(lasso_bare_board NAME SUFFIX)
  if(NOT CMAKE_SYSTEM_NAME STREQUAL Generic)
    message(FATAL_ERROR "bsp/${NAME}: configure with -DCMAKE_TOOLCHAIN_FILE=cfg/toolchains/${NAME}-bare.cmake -DLASSO_GROUND=OFF -DLASSO_TESTS=OFF")
  endif()
  set(BARE ${PROJECT_SOURCE_DIR}/bsp/bare)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${BARE}/*.cpp)
  list(REMOVE_ITEM SOURCES ${BARE}/line_head.cpp ${BARE}/own_head.cpp)
  # The image's parts are objects: what the vectors and the linker script name is there, whoever calls it.
  add_library(bsp_${NAME} OBJECT ${SOURCES} ${ARGN})
  target_link_libraries(bsp_${NAME} PRIVATE lasso_warnings lasso_flight PUBLIC fsw_exec hal_lcs)
  target_compile_options(bsp_${NAME} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-O2>)
  if(NOT LASSO_LINT)  # its loops must not become calls of itself
    set_source_files_properties(${PROJECT_SOURCE_DIR}/bsp/bare/runtime.cpp PROPERTIES COMPILE_OPTIONS "-fno-tree-loop-distribute-patterns")
  endif()
  lasso_board_image(${NAME} flight_${SUFFIX} ${BARE}/line_head.cpp)
  lasso_board_image(${NAME} in_sensor_${SUFFIX} ${BARE}/own_head.cpp)
  lasso_board_image(${NAME} planted_${SUFFIX} ${BARE}/line_head.cpp ${PROJECT_SOURCE_DIR}/ft/pil/planted.cpp ${PROJECT_SOURCE_DIR}/ft/${NAME}/planted_ops.cpp)
  set(MISSION ${PROJECT_SOURCE_DIR}/bsp/bare/linked_mission.S)
  set_source_files_properties(${MISSION} PROPERTIES COMPILE_DEFINITIONS "LASSO_MISSION_IMAGE=\"${LASSO_MISSION_IMAGE}\"" OBJECT_DEPENDS "${LASSO_MISSION_IMAGE}")
  lasso_board_image(${NAME} linked_${SUFFIX} ${BARE}/line_head.cpp ${MISSION})
  set_target_properties(linked_${SUFFIX} PROPERTIES EXCLUDE_FROM_ALL ON)
endfunction()

# lasso_board_image(NAME IMAGE SOURCE...): an image for the board, with more sources.
function(lasso_board_image NAME IMAGE)
  set(SCRIPT ${PROJECT_SOURCE_DIR}/bsp/${NAME}/link.ld)
  set(SECTIONS ${PROJECT_SOURCE_DIR}/bsp/bare/sections.ld)
  add_executable(${IMAGE} ${ARGN} $<TARGET_OBJECTS:bsp_${NAME}>)
  target_link_libraries(${IMAGE} PRIVATE lasso_warnings lasso_flight fsw_exec hal_lcs gcc)
  target_link_options(${IMAGE} PRIVATE -T ${SCRIPT} LINKER:-L,${PROJECT_SOURCE_DIR}/bsp/bare LINKER:--build-id=none LINKER:-Map=${IMAGE}.map LINKER:--no-warn-rwx-segments)
  set_target_properties(${IMAGE} PROPERTIES SUFFIX .elf LINK_DEPENDS "${SCRIPT};${SECTIONS}" RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
endfunction()
