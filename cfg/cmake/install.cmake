# make install: mdat, and the flight component as a CMake package: find_package(3dlasso), then link 3dlasso::flight (all rooms) or
# 3dlasso::ROOM, and 3dlasso::posix for the Linux board. Headers are included as in the sources ("fsw/core/status.hpp").
include(CMakePackageConfigHelpers)
set(LASSO_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/3dlasso)
get_property(LASSO_ROOMS GLOBAL PROPERTY LASSO_ROOMS)
get_property(LASSO_BOARDS GLOBAL PROPERTY LASSO_BOARDS)

add_library(lasso_component INTERFACE)
target_link_libraries(lasso_component INTERFACE ${LASSO_ROOMS})
set_target_properties(lasso_component PROPERTIES EXPORT_NAME flight)
add_library(3dlasso::flight ALIAS lasso_component)

set_target_properties(lasso_same_bits PROPERTIES EXPORT_NAME same_bits)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
install(TARGETS lasso_component lasso_same_bits ${LASSO_ROOMS} ${LASSO_BOARDS} EXPORT 3dlasso)
install(EXPORT 3dlasso NAMESPACE 3dlasso:: DESTINATION ${LASSO_PACKAGE} FILE 3dlassoTargets.cmake)
configure_package_config_file(cfg/cmake/3dlassoConfig.cmake.in ${PROJECT_BINARY_DIR}/3dlassoConfig.cmake INSTALL_DESTINATION ${LASSO_PACKAGE})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/3dlassoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/3dlassoConfig.cmake ${PROJECT_BINARY_DIR}/3dlassoConfigVersion.cmake DESTINATION ${LASSO_PACKAGE})

install(DIRECTORY fsw bsp hal_lcs DESTINATION ${LASSO_HEADERS} FILES_MATCHING PATTERN *.hpp)
install(FILES cfg/capacities.hpp DESTINATION ${LASSO_HEADERS}/cfg)
add_custom_target(installed DEPENDS ${LASSO_ROOMS} ${LASSO_BOARDS})
set(LASSO_PACKAGES dev)

# The program, and the missions and models that it ships.
if(TARGET mdat)
  list(APPEND LASSO_PACKAGES mdat)
  install(TARGETS mdat COMPONENT mdat)
  install(FILES cfg/mission.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/3dlasso COMPONENT mdat)
  install(DIRECTORY cfg/missions cfg/models DESTINATION ${CMAKE_INSTALL_DATADIR}/3dlasso COMPONENT mdat)
  # Registration for Python and C, side by side (docs/python.md).
  install(TARGETS lasso_mdat LIBRARY DESTINATION lib COMPONENT mdat OPTIONAL)
  install(FILES mdat/library/lasso_mdat.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT mdat)
  install(DIRECTORY python/lasso_mdat DESTINATION lib/python3/dist-packages COMPONENT mdat PATTERN __pycache__ EXCLUDE)
  add_dependencies(installed mdat lasso_mdat)
  if(TARGET mdat-match)  # not in the Debian package, which would bring OpenCV
    install(TARGETS mdat-match COMPONENT match)
  endif()
endif()
foreach(PACKAGE ${LASSO_PACKAGES})
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/3dlasso-${PACKAGE} RENAME copyright COMPONENT ${PACKAGE})
  install(FILES CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/3dlasso-${PACKAGE} COMPONENT ${PACKAGE})
endforeach()
if(PROJECT_IS_TOP_LEVEL)
  include(cfg/cmake/package.cmake)
endif()
