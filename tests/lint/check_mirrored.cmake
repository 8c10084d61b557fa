# Tests mirror the sources: room/file.h with room/file.cc has tests/room/file_test.cc, so that a reader
# of one finds the other. unmirrored.txt lists the pairs that are tested elsewhere or not at all; it
# only shrinks: a line whose test has come, or whose pair has gone, fails, and so does one more line.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

file(STRINGS ${SOURCE}/tests/lint/unmirrored.txt exceptions)
set(num_allowed 93)  # goes down with the list, never up
find_cxx_files(files ${ROOMS})
list(FILTER files INCLUDE REGEX "\\.cc$")
set(unmirrored "")
foreach(file IN LISTS files)
  string(REGEX REPLACE "\\.cc$" "" pair ${file})
  if(EXISTS ${SOURCE}/${pair}.h AND NOT EXISTS ${SOURCE}/tests/${pair}_test.cc)
    list(APPEND unmirrored ${pair})
  endif()
endforeach()

set(offences "")
foreach(pair IN LISTS unmirrored)
  if(NOT pair IN_LIST exceptions)
    list(APPEND offences "tests/${pair}_test.cc is missing")
  endif()
endforeach()
foreach(pair IN LISTS exceptions)
  if(NOT pair IN_LIST unmirrored)
    list(APPEND offences "${pair} in tests/lint/unmirrored.txt is not needed any more: take it out")
  endif()
endforeach()
list(LENGTH exceptions num_exceptions)
if(NOT num_exceptions EQUAL num_allowed)
  list(APPEND offences "unmirrored.txt has ${num_exceptions} lines, ${num_allowed} are allowed: write the \
tests, or set num_allowed in check_mirrored.cmake lower")
endif()
fail_if_any("${offences}" "Tests are to mirror the sources:")
