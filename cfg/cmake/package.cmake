# make package: Debian packages of what is installed, 3dlasso-mdat (the ground tool) and 3dlasso-dev (the flight component for developers).
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL ${LASSO_PACKAGES})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "3DLASSO maintainers <maintainers@3dlasso.invalid>" CACHE STRING "Maintainer of the packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_MDAT_PACKAGE_NAME 3dlasso-mdat)
set(CPACK_DEBIAN_MDAT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_MDAT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MDAT_PACKAGE_DEPENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_MDAT_PACKAGE_SUGGESTS "python3-numpy")
set(CPACK_DEBIAN_MDAT_DESCRIPTION "pose of a spacecraft from 3D laser scans: ground tool
mdat checks and compiles missions, simulates laser cameras and LIDARs, runs the
flight component of 3DLASSO, registers recorded scans, and decodes telemetry.
.
lasso_mdat is a module of Python that reads what it writes, and registers scans.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME 3dlasso-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_DEV_DESCRIPTION "pose of a spacecraft from 3D laser scans: flight component
Static libraries, headers and the CMake package of the flight component of
3DLASSO: C++17 without heap and exceptions, the same bits on every processor.")
include(CPack)
