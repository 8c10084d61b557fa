# clang-tidy, by building the program with the preset that runs it: what it finds are errors.
foreach(step "--preset;tidy" "--build;--preset;tidy;--target;graspbench;--;-k;0")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "clang-tidy found something, see above")
  endif()
endforeach()
