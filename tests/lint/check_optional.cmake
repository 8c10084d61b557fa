# The project configures without any of its optional packages: find_package, find_path, find_library
# and find_program without REQUIRED, in any CMakeLists.txt. What is compiled differently without them
# (GRASPBENCH_HAS_..) compiles. With the packages, the build of the tests compiles it:
# workbench/setup --tests installs them.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(files ${SOURCE}/CMakeLists.txt)
foreach(folder IN LISTS ROOMS ITEMS tests)
  file(GLOB_RECURSE of_folder ${SOURCE}/${folder}/CMakeLists.txt)  # not of builds, which others change
  list(APPEND files ${of_folder})
endforeach()
set(absent "")
foreach(file IN LISTS files)
  file(READ ${file} text)
  string(REGEX MATCHALL "find_(package|path|library|program)\\([^)]*\\)" searches "${text}")
  foreach(search IN LISTS searches)
    if(search MATCHES "REQUIRED")
      continue()
    elseif(search MATCHES "find_package\\(([^ )]*)")
      list(APPEND absent -D CMAKE_DISABLE_FIND_PACKAGE_${CMAKE_MATCH_1}=ON)
    elseif(search MATCHES "\\(([A-Z0-9_]*)")
      list(APPEND absent -D ${CMAKE_MATCH_1}=OFF)
    endif()
  endforeach()
endforeach()
message(STATUS "absent: ${absent}")
if(NOT absent)
  fail_if_any("none was found in CMakeLists.txt" "Optional packages:")
endif()

find_cxx_files(sources ${ROOMS} tests)
set(objects "")
foreach(source IN LISTS sources)
  file(STRINGS ${SOURCE}/${source} lines REGEX "^#if.*GRASPBENCH_HAS_")
  if(lines)
    list(APPEND objects ${SOURCE}/${source}^)  # Ninja's name of what is made from a file
  endif()
endforeach()
message(STATUS "compiled: ${objects}")

set(scratch ${BUILD}/optional)
file(REMOVE_RECURSE ${scratch})
# One file does not repay the precompiled header.
execute_process(
  COMMAND ${CMAKE_COMMAND} --preset release -B ${scratch} -D BUILD_TESTING=ON
    -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON ${absent}
  WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE error)
if(result EQUAL 0 AND objects)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${scratch} -j1 --target ${objects}
    RESULT_VARIABLE result OUTPUT_VARIABLE error ERROR_VARIABLE error)
endif()
file(REMOVE_RECURSE ${scratch})
if(NOT result EQUAL 0)
  fail_if_any("${error}" "Without the optional packages:")
endif()
