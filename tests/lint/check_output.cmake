# Every word of the program passes one escape on its way to a terminal: only these files write to
# stdout and stderr.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(allowed
  workbench/terminal/terminal.cc
  workbench/terminal/terminal.h
  workbench/terminal/status_region.cc                  # moves the cursor; takes what is escaped
  workbench/shell/look_commands.cc            # a picture's own colours
  workbench/terminal/terminal_observer.cc     # moves the cursor, names escaped; a constant, from a handler
  core/base/error.cc                          # ends the program; escapes what it shows
  core/hand/generate/generate_hand_visuals.cc # tools of the build, not of the program
  core/hand/generate/generate_tactile.cc
  objects/generate/main.cc)

set(offences "")
find_cxx_files(files ${ROOMS})
foreach(file IN LISTS files)
  if(file IN_LIST allowed)
    continue()
  endif()
  file(STRINGS ${SOURCE}/${file} lines
    REGEX "std::(cout|cerr|clog)|[^n]printf\\(|[^a-zA-Z_]f?puts\\(|putchar\\(|perror\\(|fmt::print|fwrite\\(|write\\(STD(OUT|ERR)_FILENO|PrintControlled\\(")
  foreach(line IN LISTS lines)
    list(APPEND offences "${file}: ${line}")
  endforeach()
endforeach()
fail_if_any("${offences}" "Only workbench/terminal/terminal.cc writes to stdout and stderr; use its functions:")
