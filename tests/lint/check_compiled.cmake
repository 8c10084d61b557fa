# Every source file is part of the build: one that nobody compiles is dead. The fuzz targets have a
# preset of their own, and the comparison with MuJoCo is built where MuJoCo is installed.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

file(READ ${BUILD}/compile_commands.json commands)
# A library's sources are compiled two dozen at a time, from files that include them.
string(REGEX MATCHALL "[^\" ]*/Unity/unity_[0-9]+_cxx\\.cxx\"" units "${commands}")
list(REMOVE_DUPLICATES units)
foreach(unit IN LISTS units)
  string(REPLACE "\"" "" unit ${unit})
  file(READ ${unit} includes)
  string(APPEND commands "${includes}")
endforeach()

set(offences "")
find_cxx_files(files ${ROOMS} tests)
list(FILTER files INCLUDE REGEX "\\.cc$")
list(FILTER files EXCLUDE REGEX "^tests/fuzz/|(^tests/bench/(peer_mujoco|mujoco_world)|/mujoco_peer_test)\\.cc$")
foreach(file IN LISTS files)
  string(FIND "${commands}" "${SOURCE}/${file}\"" position)
  if(position EQUAL -1)
    list(APPEND offences ${file})
  endif()
endforeach()
fail_if_any("${offences}" "Not listed in any CMakeLists.txt:")
