# A room is a folder. Its .cpp files become one library; adding a file needs no change here.

# lasso_precompile(KIND TARGET...): what the sources of a kind include most is parsed once for all of them; the first target keeps it.
# make lint does without, so that each file still has to include what it uses.
set(LASSO_PRECOMPILED_flight <Eigen/Core> <Eigen/Geometry>)
set(LASSO_PRECOMPILED_flight_test <gtest/gtest.h> <Eigen/Core> <Eigen/Geometry> <cmath> <memory> <string> <vector>)
set(LASSO_PRECOMPILED_ground <Eigen/Core> <Eigen/Geometry> <algorithm> <cmath> <filesystem> <functional> <fstream> <map> <memory> <optional>
                             <sstream> <string> <vector>)
set(LASSO_PRECOMPILED_ground_test <gtest/gtest.h> ${LASSO_PRECOMPILED_ground})
function(lasso_precompile KIND)
  foreach(TARGET ${ARGN})
    get_property(OWNER GLOBAL PROPERTY LASSO_PRECOMPILED_${KIND})
    if(OWNER)
      target_precompile_headers(${TARGET} REUSE_FROM ${OWNER})
    else()
      target_precompile_headers(${TARGET} PRIVATE ${LASSO_PRECOMPILED_${KIND}})
      set_property(GLOBAL PROPERTY LASSO_PRECOMPILED_${KIND} ${TARGET})
    endif()
  endforeach()
endfunction()

# -O3 makes code twice as large, and the flight image has to fit its 512 kB, in fixed point as well. What works once a frame, not once a ray,
# gains nothing from it: whole rooms, and sources of the others. distance_alignment, which works once a ray, stays at -O3: at -O2 a slice of a search
# takes a third more, and does not fit into a frame.
set(LASSO_SMALL_ROOMS mission mode link exec)
set(LASSO_SMALL_SOURCES
    geometry/symmetric6.cpp
    pose/estimator/estimator.cpp
    pose/recognition/pose_search.cpp pose/recognition/scan_subset.cpp
    pose/registration/agreement.cpp pose/registration/coarse_alignment.cpp pose/registration/common_error.cpp
    pose/registration/minima.cpp pose/registration/registration.cpp pose/registration/weak_axis.cpp
    pose/silhouette/information_forecast.cpp pose/silhouette/outline_constraint.cpp pose/silhouette/outline_fit.cpp
    pose/silhouette/ray_placement.cpp pose/silhouette/silhouette.cpp
    pose/tracking/bearing.cpp pose/tracking/pose_filter.cpp)
# These work once a ray, in searches alone. In fixed point -O3 makes them 9 kB larger, for which there is no room; in floating point 2 kB, and
# without it a search exceeds its 200 million instructions (make count WHAT=search).
if(LASSO_NUMBER STREQUAL "fixed")
  list(APPEND LASSO_SMALL_SOURCES pose/recognition/acceptance.cpp pose/recognition/hypothesis_score.cpp pose/recognition/view_matching.cpp)
endif()
set(LASSO_ROOMS_WITHOUT_EIGEN link)

# lasso_make_small(ROOM SOURCE...): -O2 where it is said above. Without the precompiled header: its inline functions keep the level at which it
# was compiled, -O3, which costs the fixed-point image 25 kB.
function(lasso_make_small NAME)
  if(NAME IN_LIST LASSO_SMALL_ROOMS)
    set_target_properties(fsw_${NAME} PROPERTIES LASSO_SMALL ON DISABLE_PRECOMPILE_HEADERS ON)
  endif()
  foreach(SOURCE ${ARGN})
    file(RELATIVE_PATH FILE ${PROJECT_SOURCE_DIR}/fsw ${SOURCE})
    if(FILE IN_LIST LASSO_SMALL_SOURCES)
      set_source_files_properties(${SOURCE} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O2> SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()

# lasso_position_independent(TARGET): a program may put the component into a shared library. Boards that load no code have no use for it.
function(lasso_position_independent TARGET)
  if(LASSO_BOARD STREQUAL posix AND NOT CMAKE_CROSSCOMPILING)
    set_target_properties(${TARGET} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    # Nobody replaces a function of it: calls within it stay direct, and the compiler may copy them in.
    target_compile_options(${TARGET} PRIVATE -fno-semantic-interposition)
  endif()
endfunction()

# Flight room fsw/NAME, seeing the rooms in ARGN (and what they see).
function(lasso_flight_room NAME)
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/fsw/${NAME}/*.cpp)
  if(NOT SOURCES)
    add_library(fsw_${NAME} INTERFACE)
    set(VISIBILITY INTERFACE)
  else()
    add_library(fsw_${NAME} STATIC ${SOURCES})
    set(VISIBILITY PUBLIC)
    target_link_libraries(fsw_${NAME} PRIVATE $<BUILD_INTERFACE:lasso_warnings> $<BUILD_INTERFACE:lasso_flight>)
    set_target_properties(fsw_${NAME} PROPERTIES LASSO_ALONE ON)
    lasso_position_independent(fsw_${NAME})
    lasso_make_small(${NAME} ${SOURCES})
    if(NOT NAME IN_LIST LASSO_ROOMS_WITHOUT_EIGEN)
      lasso_precompile(flight fsw_${NAME})
    endif()
  endif()
  target_include_directories(fsw_${NAME} ${VISIBILITY} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${LASSO_HEADERS}>)
  target_link_libraries(fsw_${NAME} ${VISIBILITY} lasso_same_bits)
  foreach(ROOM ${ARGN})
    target_link_libraries(fsw_${NAME} ${VISIBILITY} fsw_${ROOM})
  endforeach()
  set_target_properties(fsw_${NAME} PROPERTIES EXPORT_NAME ${NAME} OUTPUT_NAME 3dlasso_${NAME})
  set_property(GLOBAL APPEND PROPERTY LASSO_ROOMS fsw_${NAME})
endfunction()

# Sensor driver hal_NAME, flight code behind the sensor interface, and ut/hal_NAME as ut_hal_NAME.
function(lasso_sensor_driver NAME)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/hal_${NAME}/*.cpp)
  add_library(hal_${NAME} STATIC ${SOURCES})
  target_link_libraries(hal_${NAME} PRIVATE $<BUILD_INTERFACE:lasso_warnings> $<BUILD_INTERFACE:lasso_flight> PUBLIC fsw_sense)
  lasso_precompile(flight hal_${NAME})
  lasso_position_independent(hal_${NAME})
  set_target_properties(hal_${NAME} PROPERTIES LASSO_ALONE ON EXPORT_NAME ${NAME} OUTPUT_NAME 3dlasso_${NAME})
  set_property(GLOBAL APPEND PROPERTY LASSO_ROOMS hal_${NAME})
endfunction()

# Refuses a NAME that is no folder of bsp/; that of what bare boards share says itself that it is none.
function(lasso_check_board NAME)
  file(GLOB BOARDS RELATIVE ${PROJECT_SOURCE_DIR}/bsp ${PROJECT_SOURCE_DIR}/bsp/*)
  list(FILTER BOARDS EXCLUDE REGEX "[.]")
  if(NOT NAME IN_LIST BOARDS)
    list(REMOVE_ITEM BOARDS bare)
    list(JOIN BOARDS ", " THERE)
    message(FATAL_ERROR "LASSO_BOARD=${NAME} is no board: name one of ${THERE} (docs/porting.md)")
  endif()
endfunction()

# Board support bsp/NAME for the platform that is being built. A board with a CMakeLists.txt of its own says there how its image is made.
function(lasso_board NAME)
  lasso_check_board("${NAME}")
  if(EXISTS ${PROJECT_SOURCE_DIR}/bsp/${NAME}/CMakeLists.txt)
    add_subdirectory(bsp/${NAME})
    return()
  endif()
  file(GLOB SOURCES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bsp/${NAME}/*.cpp)
  if(SOURCES)
    find_package(Threads REQUIRED)
    add_library(bsp_${NAME} STATIC ${SOURCES})
    target_compile_features(bsp_${NAME} PUBLIC cxx_std_17)
    target_link_libraries(bsp_${NAME} PRIVATE $<BUILD_INTERFACE:lasso_warnings> PUBLIC fsw_exec hal_lcs Threads::Threads)
    lasso_position_independent(bsp_${NAME})
    target_compile_options(bsp_${NAME} PRIVATE -fexceptions)  # make coverage counts the flight code's branches without
    # Whose component runs is known thread by thread; a shared library may hold it, and no call is needed to find it.
    set_source_files_properties(${PROJECT_SOURCE_DIR}/fsw/core/invariant.cpp PROPERTIES
                                COMPILE_OPTIONS "-DLASSO_PER_THREAD=thread_local;-ftls-model=initial-exec" SKIP_PRECOMPILE_HEADERS ON)
    # The rooms call the board's answer to a bug, but come after it on the linker's line.
    target_link_options(bsp_${NAME} INTERFACE LINKER:--undefined=_ZN5lasso20on_invariant_failureERKNS_16InvariantFailureE)
    set_target_properties(bsp_${NAME} PROPERTIES LASSO_ALONE ON EXPORT_NAME ${NAME} OUTPUT_NAME 3dlasso_${NAME})
    set_property(GLOBAL APPEND PROPERTY LASSO_BOARDS bsp_${NAME})
  endif()
endfunction()

# hal_sim's sensors, which need nothing but the standard library: the sensors' contract is tested on the target too.
function(lasso_simulated_sensors)
  foreach(STEM common_error detector laser_reflection lcs_device lcs_direct lcs_head random replay_sensor scanner scanner_model scatter_volume sensor_recording trajectory memory_head)
    list(APPEND SOURCES ${PROJECT_SOURCE_DIR}/hal_sim/${STEM}.cpp)
  endforeach()
  add_library(hal_sim_sensors STATIC ${SOURCES})
  target_compile_features(hal_sim_sensors PUBLIC cxx_std_20)
  target_link_libraries(hal_sim_sensors PUBLIC hal_lcs PRIVATE lasso_warnings lasso_test_leave)
  lasso_precompile(ground hal_sim_sensors)
endfunction()

# Ground rooms keep a CMakeLists.txt of their own: they know third-party libraries.
function(lasso_ground_room NAME)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${NAME}/CMakeLists.txt)
    add_subdirectory(${NAME})
  endif()
endfunction()

# lasso_no_test(PROGRAM...): no test runs these: they are built by name, or by make programs.
function(lasso_no_test)
  set_target_properties(${ARGN} PROPERTIES EXCLUDE_FROM_ALL ON)
endfunction()

# lasso_start_early(TEST): with others beside it, a test that takes long begins before those behind it in this list, so that none is left to run alone.
set(LASSO_LONG_TESTS ut_exec ut_pose bare_pose ut_mode bare_geometry ut_posix ut_geometry ut_mission bare_mission)
function(lasso_start_early TEST)
  list(LENGTH LASSO_LONG_TESTS COUNT)
  list(FIND LASSO_LONG_TESTS ${TEST} PLACE)
  if(NOT PLACE EQUAL -1)
    math(EXPR COST "${COUNT} - ${PLACE}")
    set_tests_properties(${TEST} PROPERTIES COST ${COST})
  endif()
endfunction()

# ut/ROOM/*_test.cpp become ut_ROOM for the flight rooms and the sensors' drivers (hal_NAME). A flight source file without its test is a
# configure error.
function(lasso_flight_tests ROOM)
  set(FOLDER fsw/${ROOM})
  set(LIBRARY fsw_${ROOM})
  if(ROOM MATCHES "^hal_")
    set(FOLDER ${ROOM})
    set(LIBRARY ${ROOM})
  endif()
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/${FOLDER} ${PROJECT_SOURCE_DIR}/${FOLDER}/*.cpp)
  file(GLOB_RECURSE TESTS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/ut/${ROOM}/*_test.cpp)
  foreach(SOURCE ${SOURCES})
    string(REGEX REPLACE "[.]cpp$" "_test.cpp" TEST ${SOURCE})
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/ut/${ROOM}/${TEST})
      list(APPEND MISSING ut/${ROOM}/${TEST})
    endif()
  endforeach()
  if(MISSING)
    message(${LASSO_MISSING_TEST_SEVERITY} "${FOLDER}: missing unit tests: ${MISSING}")
  endif()
  if(TESTS)
    add_executable(ut_${ROOM} ${TESTS})
    target_link_libraries(ut_${ROOM} PRIVATE lasso_warnings lasso_test_leave ${LIBRARY} ut_dense ut_main)
    target_compile_features(ut_${ROOM} PRIVATE cxx_std_17)
    lasso_precompile(flight_test ut_${ROOM})
    if(NOT ROOM STREQUAL core AND NOT ROOM STREQUAL geometry)
      target_link_libraries(ut_${ROOM} PRIVATE ut_box_image)
    endif()
    add_test(NAME ut_${ROOM} COMMAND ut_${ROOM})
    lasso_start_early(ut_${ROOM})
    set_tests_properties(ut_${ROOM} PROPERTIES LABELS flight)
    add_dependencies(flight_tests ut_${ROOM})
  endif()
endfunction()

# ut/BOARD/*_test.cpp become ut_BOARD, with the libraries in ARGN.
function(lasso_board_tests BOARD)
  file(GLOB TESTS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/ut/${BOARD}/*_test.cpp)
  if(TESTS)
    add_executable(ut_${BOARD} ${TESTS})
    target_link_libraries(ut_${BOARD} PRIVATE lasso_warnings lasso_test_leave ${ARGN} ut_main)
    target_compile_features(ut_${BOARD} PRIVATE cxx_std_17)
    add_test(NAME ut_${BOARD} COMMAND ut_${BOARD})
    lasso_start_early(ut_${BOARD})
  endif()
endfunction()

# ut/sensors: the contract of the sensor interface, asked of every implementation, on host and target.
function(lasso_sensor_tests)
  file(GLOB TESTS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/ut/sensors/*_test.cpp)
  add_executable(ut_sensors ${TESTS})
  target_link_libraries(ut_sensors PRIVATE lasso_warnings lasso_test_leave hal_sim_sensors ut_main)
  lasso_precompile(ground_test ut_sensors)
  add_test(NAME ut_sensors COMMAND ut_sensors)
endfunction()

# GTest::gtest of the system, or built from Debian's sources where there is none for the processor (cross builds).
function(lasso_find_gtest)
  if(NOT CMAKE_CROSSCOMPILING)
    find_package(GTest REQUIRED)
    return()
  endif()
  set(LASSO_GTEST_SOURCE /usr/src/googletest CACHE PATH "Sources of GoogleTest")
  set(BUILD_GMOCK OFF CACHE INTERNAL "")
  set(INSTALL_GTEST OFF CACHE INTERNAL "")
  add_subdirectory(${LASSO_GTEST_SOURCE} googletest EXCLUDE_FROM_ALL)
  get_target_property(HEADERS gtest INTERFACE_INCLUDE_DIRECTORIES)
  set_property(TARGET gtest PROPERTY INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${HEADERS})
endfunction()

function(lasso_tests)
  lasso_find_gtest()
  add_library(ut_main OBJECT ut/support/main.cpp)  # the tests' entry
  target_link_libraries(ut_main PRIVATE lasso_warnings fsw_core PUBLIC GTest::gtest lasso_quick)
  target_compile_features(ut_main PUBLIC cxx_std_17)
  add_library(ut_dense STATIC ut/support/dense.cpp)  # decompositions as the tests' truth: not what sanitizers are for
  target_link_libraries(ut_dense PRIVATE lasso_warnings lasso_test_leave lasso_quick PUBLIC fsw_geometry)
  if(LASSO_SANITIZE)
    target_compile_options(ut_dense PRIVATE -fno-sanitize=all)
  endif()
  target_compile_features(ut_dense PUBLIC cxx_std_17)
  add_library(ut_box_image STATIC ut/support/box_image.cpp ut/support/box_search_tables.cpp)  # a flight image for the rooms' tests, made without the mission compiler
  target_link_libraries(ut_box_image PRIVATE lasso_warnings lasso_test_leave lasso_quick PUBLIC fsw_mission)
  target_compile_features(ut_box_image PUBLIC cxx_std_17)
  add_library(ut_places STATIC ut/support/places.cpp)
  target_link_libraries(ut_places PRIVATE lasso_warnings lasso_quick)
  target_compile_features(ut_places PUBLIC cxx_std_17)
  target_include_directories(ut_places PUBLIC ${PROJECT_SOURCE_DIR})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/source_folder.txt CONTENT "${PROJECT_SOURCE_DIR}\n" @ONLY)
  add_custom_target(flight_tests)  # what coverage is measured by: ctest -L flight
  foreach(ROOM core geometry mission sense pose mode link exec hal_lcs)
    lasso_flight_tests(${ROOM})
  endforeach()
  if(TARGET bsp_posix)
    lasso_board_tests(posix bsp_posix ut_box_image)
  endif()
  lasso_board_tests(bare fsw_mission)  # what of it any processor can run
  lasso_sensor_tests()
  add_executable(ut_support ut/support/verifies_test.cpp)
  target_link_libraries(ut_support PRIVATE lasso_warnings lasso_test_leave fsw_core ut_main)
  target_compile_features(ut_support PRIVATE cxx_std_17)
  add_test(NAME ut_support COMMAND ut_support)
  if(LASSO_BARE_KERNEL)  # again without an operating system (ft/ppc603e/bare): all but what ends a second process
    foreach(ROOM core geometry mission sense pose link hal_lcs)
      add_test(NAME bare_${ROOM} COMMAND ${PROJECT_SOURCE_DIR}/ft/ppc603e/bare/run ${LASSO_BARE_KERNEL} $<TARGET_FILE:ut_${ROOM}>)
      lasso_start_early(bare_${ROOM})
    endforeach()
  endif()
  foreach(FOLDER ut ft)
    if(LASSO_GROUND AND EXISTS ${PROJECT_SOURCE_DIR}/${FOLDER}/CMakeLists.txt)
      add_subdirectory(${FOLDER})
    endif()
  endforeach()
endfunction()

set(LASSO_MISSING_TEST_SEVERITY FATAL_ERROR)
