# A mission of cFS with the component, a scanner, and the links of the ground.
set(MISSION_NAME "3DLASSO")
set(SPACECRAFT_ID 0x42)
set(MISSION_CPUNAMES cpu1)
set(cpu1_PROCESSORID 1)
set(cpu1_APPLIST lasso lasso_scanner ci_lab to_lab)
set(cpu1_FILELIST cfe_es_startup.scr)
list(APPEND MISSION_MODULE_SEARCH_PATH ${MISSION_DEFS}/../apps)
