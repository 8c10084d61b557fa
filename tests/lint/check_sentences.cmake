# A sentence of the manual or of README.md has at most 35 words. Blocks, tables and headings do not count, and a code span
# is one word. A sentence ends before a capital, at a full stop, question mark, exclamation mark or colon;
# an item of a list ends where the next one begins.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(PAGES workbench/manual/pages)
file(GLOB files RELATIVE ${SOURCE} ${SOURCE}/${PAGES}/*.md)
list(APPEND files README.md)

set(offences "")
foreach(file IN LISTS files)
  file(READ ${SOURCE}/${file} text)
  string(REGEX REPLACE "[][;\\]" "," text "${text}")  # they would end or join items of a list
  string(REPLACE "```" ";" parts "${text}")           # every second part is a block
  set(prose "")
  set(is_block FALSE)
  foreach(part IN LISTS parts)
    if(is_block)
      set(is_block FALSE)
    else()
      string(APPEND prose "\n${part}\n")
      set(is_block TRUE)
    endif()
  endforeach()
  string(REGEX REPLACE "`[^`]*`" "X" prose "${prose}")
  string(REGEX REPLACE "\n([|#]|    )[^\n]*" "\n\n" prose "${prose}")
  string(REGEX REPLACE "\n( *\n|- |[0-9]+\\. )" ";" prose "${prose}")
  string(REGEX REPLACE "[ \n]+" " " prose "${prose}")
  string(REGEX REPLACE "[.?!:][*\")]* ([*\"(]*[A-Z])" ";\\1" sentences "${prose}")
  foreach(sentence IN LISTS sentences)
    string(REGEX MATCHALL "[^ ]+" words "${sentence}")
    list(LENGTH words num_words)
    if(num_words GREATER 35)
      string(SUBSTRING "${sentence}" 0 80 start)
      list(APPEND offences "${file}: ${num_words} words: ${start}..")
    endif()
  endforeach()
endforeach()
fail_if_any("${offences}" "Sentences of more than 35 words:")
