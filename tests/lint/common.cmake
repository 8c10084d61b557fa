cmake_minimum_required(VERSION 3.25)
# Shared by the rules: the files they look at, and how they fail.
set(ROOMS core objects datasets human_study reports workbench)

# All C++ files below the folders, relative to SOURCE.
function(find_cxx_files result)
  set(globs "")
  foreach(folder IN LISTS ARGN)
    list(APPEND globs ${SOURCE}/${folder}/*.h ${SOURCE}/${folder}/*.cc)
  endforeach()
  file(GLOB_RECURSE files RELATIVE ${SOURCE} ${globs})
  set(${result} ${files} PARENT_SCOPE)
endfunction()

function(fail_if_any offences advice)
  if(offences)
    list(JOIN offences "\n  " text)
    message(FATAL_ERROR "${advice}\n  ${text}")
  endif()
endfunction()
