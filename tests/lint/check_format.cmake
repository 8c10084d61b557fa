# The layout is what clang-format-14 makes of .clang-format. It leaves comments alone, so that tables
# and formulas stay as they were drawn; their lines are held to the same width.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

find_cxx_files(files ${ROOMS} tests)
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files}
  WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE status ERROR_VARIABLE findings)
if(status)
  string(REGEX MATCHALL "[^\n]+: error: code should be clang-formatted" lines "${findings}")
  list(TRANSFORM lines REPLACE ":[0-9]+:[0-9]+: error.*" "")
  list(REMOVE_DUPLICATES lines)
  fail_if_any("${lines}" "Run clang-format-14 -i on:")
  message(FATAL_ERROR "${findings}")
endif()

set(offences "")
foreach(file IN LISTS files)
  file(STRINGS ${SOURCE}/${file} long LENGTH_MINIMUM 102)  # bytes: a letter beyond ASCII has two
  foreach(line IN LISTS long)
    list(APPEND offences "${file}: ${line}")
  endforeach()
endforeach()
fail_if_any("${offences}" "Lines of more than 100 columns:")

# A command parses, calls and prints.
set(offences "")
foreach(file IN LISTS files)
  if(file MATCHES "^workbench/commands/")
    file(STRINGS ${SOURCE}/${file} lines REGEX "^")
    list(LENGTH lines num_lines)
    if(num_lines GREATER 150)
      list(APPEND offences "${file}: ${num_lines}")
    endif()
  endif()
endforeach()
fail_if_any("${offences}" "Command files of more than 150 lines:")
