# cmake -DMARKERVP=… -DHELP2MAN=… -DVERSION=… -DFOLDER=… -P manual.cmake
# markervp(1) and markervp-COMMAND(1) of every command that `markervp --help` lists, from what --help prints.
function(run_or_stop OUTPUT)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${result}")
  endif()
  set(${OUTPUT} "${text}" PARENT_SCOPE)
endfunction()

# Of the program called `WORDS`, which does what `SUMMARY` says.
function(write_page NAME WORDS SUMMARY)
  set(page "${FOLDER}/${NAME}.1")
  run_or_stop(ignored "${HELP2MAN}" --no-info --section=1 "--version-string=${VERSION}" "--name=${SUMMARY}"
    "--source=markervp ${VERSION}" "--output=${page}" "${WORDS}")
  run_or_stop(ignored gzip -9 -n -f "${page}")
endfunction()

run_or_stop(help "${MARKERVP}" --help)
string(REGEX MATCH "^[^\n]*" summary "${help}")
string(REGEX MATCH "Subcommands:\n(  [^\n]*\n)+" commands "${help}")
string(REGEX MATCHALL "\n  [a-z-]+ [^\n]*" commands "${commands}")
if(NOT commands)
  message(FATAL_ERROR "markervp --help lists no commands")
endif()
file(GLOB former "${FOLDER}/*.1*")
if(former)
  file(REMOVE ${former})
endif()
# help2man starts what it describes by name.
cmake_path(GET MARKERVP PARENT_PATH program_folder)
set(ENV{PATH} "${program_folder}:$ENV{PATH}")
write_page(markervp markervp "${summary}")
foreach(line IN LISTS commands)
  string(REGEX MATCH "([a-z-]+) +(.*)$" ignored "${line}")
  write_page("markervp-${CMAKE_MATCH_1}" "markervp ${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
endforeach()
