# Every #include keeps to the allowed directions of the root CMakeLists, and heavy third-party
# headers stay in the one room that owns them.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

file(READ ${SOURCE}/CMakeLists.txt text)
string(REGEX MATCHALL "set\\(GRASPBENCH_MAY_USE_[a-z_]+[^)]*\\)" rows "${text}")
foreach(row IN LISTS rows)
  cmake_language(EVAL CODE "${row}")
endforeach()

# core/base/error.h -> core_base; objects/catalogue.h -> objects
function(find_library_of path result)
  if(path MATCHES "^(core|datasets|human_study)/([a-z_]+)/" OR path MATCHES "^(workbench)/(experiments)/")
    set(${result} ${CMAKE_MATCH_1}_${CMAKE_MATCH_2} PARENT_SCOPE)
  elseif(path MATCHES "^([a-z_]+)/")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()

set(owned_headers "Simbody.h|SimTK" "assimp/" "sqlite3.h" "GL/" "CLI/" "kainjow/" "libqhull"
  "opencv2/" "boost/")
set(owners core_physics objects datasets_session core_render workbench reports core_quality
  core_vision core_statistics)

set(offences "")
find_cxx_files(files ${ROOMS})
foreach(file IN LISTS files)
  find_library_of(${file} library)
  file(STRINGS ${SOURCE}/${file} includes REGEX "^#include [\"<]")
  foreach(include IN LISTS includes)
    if(include MATCHES "^#include \"(.*)\"")
      set(path ${CMAKE_MATCH_1})
      find_library_of(${path} used)
      if(NOT used STREQUAL library AND NOT used IN_LIST GRASPBENCH_MAY_USE_${library})
        list(APPEND offences "${file}: ${library} must not include ${path}")
      endif()
    elseif(include MATCHES "^#include <(.*)>")
      set(path ${CMAKE_MATCH_1})
      foreach(pattern owner IN ZIP_LISTS owned_headers owners)
        if(path MATCHES "^(${pattern})" AND NOT library STREQUAL owner)
          list(APPEND offences "${file}: <${path}> belongs in ${owner} only")
        endif()
      endforeach()
    endif()
  endforeach()
endforeach()
fail_if_any("${offences}" "Includes against the table GRASPBENCH_MAY_USE_* in CMakeLists.txt:")
