# A class of one full name is defined in one file. Two of them in different libraries would be linked
# into one program, and a function of the one would be called on the other.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(offences "")
find_cxx_files(sources ${ROOMS})
foreach(file IN LISTS sources)
  file(STRINGS ${SOURCE}/${file} lines
    REGEX "^(namespace.*{|}  // namespace.*|(class|struct|union|enum|enum class) [A-Za-z0-9_]+( [^;]*)?)$")
  set(scopes "")
  foreach(line IN LISTS lines)
    if(line MATCHES "^namespace ?([A-Za-z0-9_:]*) ?{")
      list(APPEND scopes "::${CMAKE_MATCH_1}")
    elseif(line MATCHES "^}")
      list(POP_BACK scopes)
    elseif(NOT "::" IN_LIST scopes)  # without a name: the file's own
      string(REGEX REPLACE "^(enum class|[a-z]+) ([A-Za-z0-9_]+).*" "\\2" name "${line}")
      list(JOIN scopes "" scope)
      set(key "file_of_${scope}::${name}")
      if(DEFINED ${key} AND NOT "${${key}}" STREQUAL file)
        list(APPEND offences "${scope}::${name}: ${${key}} and ${file}")
      endif()
      set(${key} ${file})
    endif()
  endforeach()
endforeach()
fail_if_any("${offences}" "These classes are defined twice; rename one, or keep it in the file's unnamed namespace:")
