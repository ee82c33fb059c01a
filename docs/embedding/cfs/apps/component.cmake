# What both apps need: the component (CMAKE_PREFIX_PATH says where it is installed), and the headers of docs/embedding.
get_filename_component(LASSO_EMBEDDING ${CMAKE_CURRENT_LIST_DIR}/../.. REALPATH)
find_package(3dlasso REQUIRED)
set_directory_properties(PROPERTIES COMPILE_OPTIONS "")  # a mission's are those of C

function(lasso_link APP)
  target_include_directories(${APP} PUBLIC ${LASSO_EMBEDDING})
  target_compile_features(${APP} PRIVATE cxx_std_17)
  set_target_properties(${APP} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden)
  target_compile_options(${APP} PRIVATE -Wall -Wextra -fno-exceptions -fno-rtti)
  # Each app keeps its copy of the flight code, and its answer to a bug in it, to itself: cFE finds the entry by its name, and nothing else.
  target_link_libraries(${APP} 3dlasso::flight -Wl,--exclude-libs,ALL)
endfunction()
