# Where foreign files are read, no floating-point number becomes a whole one but by ToWhole
# (core/base/whole_number.h): the cast of a number that the type does not hold has no defined result.
# clang-query (Debian's package clang-tools) finds every such cast, written or not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(GLOB files RELATIVE ${SOURCE} ${SOURCE}/human_study/recording/importers/*.cc
  ${SOURCE}/datasets/grasps/*.cc ${SOURCE}/core/hand/xml_text.cc ${SOURCE}/core/hand/read_urdf.cc
  ${SOURCE}/core/hand/import/mjcf/*.cc ${SOURCE}/core/hand/import/read_foreign_urdf.cc
  ${SOURCE}/core/shape/obj_file.cc ${SOURCE}/core/base/text/message_pack.cc
  ${SOURCE}/core/base/text/json.cc)
list(TRANSFORM files PREPEND ${SOURCE}/)
execute_process(
  COMMAND ${CLANG_QUERY} -c "set output diag"
    -c "match castExpr(hasCastKind(\"CK_FloatingToIntegral\"), isExpansionInMainFile())"
    ${files} -- -std=c++17 -I${SOURCE} -isystem ${EIGEN}
  OUTPUT_VARIABLE found ERROR_VARIABLE error RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR error MATCHES "error:")
  message(FATAL_ERROR "clang-query failed: ${error}")
endif()
string(REGEX MATCHALL "[^\n]*: note: \"root\" binds here\n[^\n]*" offences "${found}")
fail_if_any("${offences}" "Conversions without ToWhole:")
