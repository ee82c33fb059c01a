# Tables of other apps may name the component's messages; cfe_perfids.h is that of the sample mission.
include_directories(${MISSION_DEFS}/../.. ${MISSION_SOURCE_DIR})
