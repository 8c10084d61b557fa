# Writes OUTPUT, a header with the commit of the source in SOURCE.
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE fault)
if(fault)
  set(commit unknown)
endif()
file(WRITE ${OUTPUT} "#pragma once\n\nnamespace graspbench {\ninline constexpr char kCommit[] = \"${commit}\";\n}\n")
